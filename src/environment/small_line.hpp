#pragma once

#include <memory>
#include <utility>

#include "linewright/line/line_model.hpp"
#include "linewright/simulation/simulator.hpp"

namespace linewright {

/// For tests: one or two people and robots; `fetch` brings up to four blanks from the rack to the
/// press, `press` makes one of them a bracket on the shelf. Ways take four ticks.
inline Simulator small_line() {
  LineModel line;
  line.name = "small";
  const WorkerKindId human(std::size_t{0});
  const WorkerKindId robot(std::size_t{1});
  const StationId at_rack(std::size_t{0});
  const StationId at_press(std::size_t{1});
  line.worker_kinds.push_back({.name = "human", .count = {1, 2}, .min_leg_ticks = 1});
  line.worker_kinds.push_back({.name = "robot", .count = {1, 2}});
  line.worker_kinds[0].start = {at_press, at_press};
  line.worker_kinds[1].start = {at_rack, at_rack};
  line.carrier_kinds.push_back(
      {.name = "trolley", .count_as = robot, .capacity = 4, .moved_by = robot});
  line.carrier_kinds[0].start = {at_rack, at_rack};
  line.stations.push_back({"rack", {Pose2{0, 0, 0}, Pose2{0, 1, 0}}, {1, 1}});
  line.stations.push_back({"press", {Pose2{6, 0, 0}, Pose2{6, 1, 0}}, {1, 1}});
  for (std::size_t kind = 0; kind < 2; ++kind) {
    TravelTable table(2);
    table.set(at_rack, at_press, {4, 6.0});
    table.set(at_press, at_rack, {4, 6.0});
    line.travel.push_back(std::move(table));
  }
  const PlaceId rack(std::size_t{0});
  const PlaceId blanks(std::size_t{1});
  const PlaceId shelf(std::size_t{2});
  line.places.push_back({.name = "rack", .of = "blank", .initial = {0, 1}, .at = at_rack});
  line.places.push_back({.name = "blanks", .of = "blank", .capacity = 4, .at = at_press});
  line.places.push_back({.name = "shelf", .of = "bracket"});
  line.machines.push_back({.name = "press"});
  line.operations.push_back({.name = "stamp",
                             .takes = 20,
                             .uses = {{MachineId(std::size_t{0}), {}, {}}},
                             .consumes = {{blanks, 1}},
                             .produces = {{shelf, 1}},
                             .operated_by = human});

  const auto above_zero = [](VariableKind kind, std::int32_t index) {
    return Comparison{{{{kind, index}, 1}}, 0, Relation::kGreater};
  };
  Task fetch{.name = "fetch", .number = 1};
  fetch.crew = {{.role = "human", .worker = human},
                {.role = "robot", .worker = robot},
                {.role = "trolley", .carrier = CarrierKindId(std::size_t{0})}};
  fetch.when.any_of = {{above_zero(VariableKind::kPlaceCount, 0),
                        {{{{VariableKind::kPlaceCount, 1}, 1}}, 0, Relation::kEqual}}};
  const Action to_rack{GoAction{at_rack}};
  const Action to_press{GoAction{at_press}};
  const Endpoint in_trolley{{}, 2};
  fetch.steps.push_back({{{0, {to_rack}}, {1, {Action{FetchAction{2}}, to_rack}}}});
  fetch.steps.push_back(
      {{{0, {Action{TransferAction{{rack, 0}, in_trolley, 2, TransferAction::kUntilBlocked}}}}}});
  fetch.steps.push_back({{{0, {to_press}}, {1, {to_press}}}});
  fetch.steps.push_back(
      {{{0, {Action{TransferAction{in_trolley, {blanks, 0}, 2, TransferAction::kUntilBlocked}}}}}});
  Task press{.name = "press", .number = 2};
  press.crew = {{.role = "human", .worker = human}};
  press.when.any_of = {
      {above_zero(VariableKind::kPlaceAvailable, 1), above_zero(VariableKind::kMachineFree, 0)}};
  press.steps.push_back({{{0, {to_press, Action{OperateAction{OperationId(std::size_t{0})}}}}}});
  line.tasks = {fetch, press};
  line.order = {.product = "bracket", .quantity = 4, .finished_in = shelf};
  line.order.done_when.any_of = {
      {{{{{VariableKind::kPlaceCount, 2}, 1}, {{VariableKind::kOrder, 0}, -1}},
        0,
        Relation::kGreaterEqual}}};
  line.horizon.by_order = {{1, 1000}};
  return Simulator(std::make_shared<const LineModel>(std::move(line)));
}

}  // namespace linewright
