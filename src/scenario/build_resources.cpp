#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "areas.hpp"
#include "build_state.hpp"
#include "limits.hpp"
#include "linewright/scenario/values.hpp"
#include "positions.hpp"

namespace linewright::loading {
namespace {

std::string without_spaces(std::string_view text) {
  std::string result;
  std::copy_if(text.begin(), text.end(), std::back_inserter(result),
               [](char c) { return c != ' '; });
  return result;
}

/// A number, `order`, or `N*order`.
std::optional<Amount> parse_amount(std::string_view text) {
  if (const auto number = parse_integer(text)) return Amount{static_cast<std::int32_t>(*number), 0};
  const std::string packed = without_spaces(text);
  if (packed == "order") return Amount{0, 1};
  constexpr std::string_view kPerOrder = "*order";
  if (!packed.ends_with(kPerOrder)) return std::nullopt;
  const auto factor =
      parse_integer(std::string_view(packed).substr(0, packed.size() - kPerOrder.size()));
  if (!factor || *factor < 0 || *factor > kMostPerOrder) return std::nullopt;
  return Amount{0, static_cast<std::int32_t>(*factor)};
}

Amount initial_of(BuildState& state, const SourceNode& node, const std::string& title) {
  const SourceNode* initial = node.find("initial");
  if (initial == nullptr) return {};
  const auto amount = parse_amount(initial->text);
  if (!amount) {
    state.problems.error(
        initial->mark, fmt::format("{}: 'initial' cannot be {}", title, in_quotes(initial->text)),
        fmt::format("write a number, order, or N*order with N up to {}", kMostPerOrder));
  }
  return amount.value_or(Amount{});
}

/// A berth's tokens are the items in its carrier, so it has no amounts of its own.
void refuse_amounts(BuildState& state, const SourceNode& node, const std::string& title) {
  for (const char* key : {"capacity", "initial"}) {
    if (const SourceNode* value = node.find(key)) {
      state.problems.error(value->mark,
                           fmt::format("{}: a berth has no '{}' of its own", title, key),
                           "its tokens are the items in the carrier that stands there");
    }
  }
}

std::string material_of(BuildState& state, const SourceNode& node, const std::string& title) {
  const SourceNode* of = node.find("of");
  if (of == nullptr) return {};
  if (const auto fault = name_fault(of->text)) {
    state.problems.error(of->mark, fmt::format("{}: {} cannot be the name of a material: {}", title,
                                               in_quotes(of->text), *fault));
  }
  return of->text;
}

void build_place(BuildState& state, std::int32_t id, const SourceNode& node) {
  const std::string title = state.names.title(Section::kPlaces, id);
  Place place;
  place.name = state.names.names(Section::kPlaces)[static_cast<std::size_t>(id)];
  place.of = material_of(state, node, title);
  place.initial = initial_of(state, node, title);
  if (node.find("capacity") != nullptr) place.capacity = integer_or(node, "capacity", 1);
  place.at = reference_at<StationId>(state, Section::kStations, node, "at", title);
  if (node.find("carrier") != nullptr) {
    refuse_amounts(state, node, title);
    const auto kind =
        reference_at<CarrierKindId>(state, Section::kCarriers, node, "carrier", title);
    const bool early = text_or(node, "occupied", "on_arrival") == "on_assignment";
    place.berth = Berth{kind.value_or(CarrierKindId{}),
                        early ? BerthOccupied::kOnAssignment : BerthOccupied::kOnArrival};
  } else if (const SourceNode* occupied = node.find("occupied")) {
    state.problems.error(occupied->mark, fmt::format("{}: 'occupied' without 'carrier'", title),
                         "only a berth can be occupied: write carrier: KIND");
  }
  state.line().places.push_back(std::move(place));
}

void read_positions(BuildState& state, const SourceNode& node, const std::string& title,
                    Machine& machine) {
  const SourceNode* positions = node.find("positions");
  if (positions == nullptr) return;
  for (const SourceNode& item : positions->items) {
    if (item.is_broken()) continue;
    const bool twice = std::find(machine.positions.begin(), machine.positions.end(), item.text) !=
                       machine.positions.end();
    const auto fault =
        twice ? std::optional<std::string>("it is listed twice") : name_fault(item.text);
    if (fault) {
      state.problems.error(item.mark,
                           fmt::format("{}: position {}: {}", title, in_quotes(item.text), *fault),
                           "choose another name");
    }
    machine.positions.push_back(item.text);
  }
}

void read_machine_travel(BuildState& state, const SourceNode& node, const std::string& title,
                         Machine& machine) {
  const std::size_t count = machine.positions.size();
  machine.travel.assign(count, std::vector<Tick>(count, -1));
  for (std::size_t i = 0; i < count; ++i) machine.travel[i][i] = 0;
  const SourceNode* travel = node.find("travel");
  if (travel == nullptr) return;
  for (const SourceEntry& row : travel->entries) {
    const auto to = position(state, machine, row.key, row.mark, title);
    for (const SourceEntry& cell : row.value.entries) {
      const auto from = position(state, machine, cell.key, cell.mark, title);
      if (!to || !from || cell.value.is_broken()) continue;
      if (*to == *from) {
        state.problems.error(cell.mark,
                             fmt::format("{}: a way from {} to itself", title, in_quotes(cell.key)),
                             "remove it; staying takes no time");
        continue;
      }
      machine.travel[static_cast<std::size_t>(*to)][static_cast<std::size_t>(*from)] =
          integer_or(row.value, cell.key, 0);
    }
  }
}

void read_homing(BuildState& state, const SourceNode& node, const std::string& title,
                 Machine& machine) {
  const SourceNode* source = node.find("homing");
  if (source == nullptr) return;
  Homing homing;
  homing.takes.assign(machine.positions.size(), -1);
  homing.holds = integer_or(*source, "holds", 0);
  if (const SourceNode* takes = source->find("takes")) {
    for (const SourceEntry& entry : takes->entries) {
      const auto from = position(state, machine, entry.key, entry.mark, title);
      if (from) homing.takes[static_cast<std::size_t>(*from)] = integer_or(*takes, entry.key, 0);
    }
  }
  const SourceNode* to = source->find("to");
  const auto home =
      to != nullptr ? position(state, machine, to->text, to->mark, title) : std::nullopt;
  if (!home) return;
  homing.home = *home;
  homing.takes[static_cast<std::size_t>(*home)] = 0;
  machine.homing = std::move(homing);
}

void build_machine(BuildState& state, std::int32_t id, const SourceNode& node) {
  const std::string title = state.names.title(Section::kMachines, id);
  Machine machine;
  machine.name = state.names.names(Section::kMachines)[static_cast<std::size_t>(id)];
  machine.at = reference_at<StationId>(state, Section::kStations, node, "at", title);
  if (const SourceNode* area = node.find("area_m"); area != nullptr && area->sound) {
    machine.area_m = read_area(state, *area, title).value_or(Polygon{});
  }
  read_positions(state, node, title, machine);
  if (const SourceNode* start = node.find("start")) {
    machine.start = position(state, machine, start->text, start->mark, title).value_or(0);
  }
  read_machine_travel(state, node, title, machine);
  read_homing(state, node, title, machine);
  state.line().machines.push_back(std::move(machine));
}

}  // namespace

std::optional<std::int32_t> position(BuildState& state, const Machine& machine,
                                     const std::string& name, SourceMark mark,
                                     const std::string& title) {
  const auto found = std::find(machine.positions.begin(), machine.positions.end(), name);
  if (found != machine.positions.end()) {
    return static_cast<std::int32_t>(found - machine.positions.begin());
  }
  std::string hint = state.problems.hint(name, machine.positions);
  if (hint.empty()) hint = "give the machine 'positions'";
  const bool is_own = title == "machine " + in_quotes(machine.name);
  const std::string of = is_own ? "" : fmt::format(" of machine {}", in_quotes(machine.name));
  state.problems.error(
      mark, fmt::format("{}: there is no position {}{}", title, in_quotes(name), of), hint);
  return std::nullopt;
}

void build_places(BuildState& state) {
  state.each(Section::kPlaces,
             [&](std::int32_t id, const SourceNode& node) { build_place(state, id, node); });
}

void build_machines(BuildState& state) {
  state.each(Section::kMachines,
             [&](std::int32_t id, const SourceNode& node) { build_machine(state, id, node); });
}

}  // namespace linewright::loading
