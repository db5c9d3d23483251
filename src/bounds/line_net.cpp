#include "line_net.hpp"

#include <algorithm>

namespace linewright::bounds {
namespace {

constexpr int kMostColumns = 128;

/// As often as any event can matter: as many as tokens of one place are there or ordered.
int columns_of(const LineModel& line, const RunSetup& setup) {
  std::int64_t most = setup.order;
  for (const Place& place : line.places) most = std::max(most, place.initial.value(setup.order));
  return static_cast<int>(std::clamp<std::int64_t>(most + 1, 2, kMostColumns));
}

/// Lower bounds of places in `done_when`; what else it asks for is left out.
std::vector<std::pair<int, int>> needs_of(const LineNet& net) {
  std::vector<std::pair<int, int>> needs;
  const Condition& done = net.line.order.done_when;
  if (done.always()) return {{net.stores.of(net.line.order.finished_in), net.setup.order}};
  if (done.any_of.size() != 1) return needs;
  for (const Comparison& comparison : done.any_of[0]) {
    std::int64_t constant = comparison.constant;
    std::optional<std::int32_t> place;
    bool simple = true;
    for (const Term& term : comparison.terms) {
      if (term.variable.kind == VariableKind::kOrder) {
        constant += std::int64_t{term.coefficient} * net.setup.order;
      } else if (!place && term.coefficient == 1 &&
                 (term.variable.kind == VariableKind::kPlaceCount ||
                  term.variable.kind == VariableKind::kPlaceAvailable)) {
        place = term.variable.index;
      } else {
        simple = false;
      }
    }
    const bool lower = comparison.relation == Relation::kGreaterEqual ||
                       comparison.relation == Relation::kEqual ||
                       comparison.relation == Relation::kGreater;
    if (!simple || !place || !lower) continue;
    const std::int64_t tokens = -constant + (comparison.relation == Relation::kGreater ? 1 : 0);
    if (tokens > 0 && tokens <= 1'000'000)
      needs.emplace_back(net.stores.of(PlaceId(*place)), static_cast<int>(tokens));
  }
  return needs;
}

}  // namespace

Stores::Stores(const LineModel& line) : names(materials_of(line)) {
  materials = static_cast<int>(names.names.size());
  first_pool = static_cast<int>(line.places.size());
  count = first_pool + static_cast<int>(line.carrier_kinds.size()) * materials;
  for (std::size_t p = 0; p < line.places.size(); ++p) {
    by_place.push_back(line.places[p].berth ? pool(line.places[p].berth->carrier, names.by_place[p])
                                            : static_cast<int>(p));
  }
}

LineNet::LineNet(const LineModel& model, const RunSetup& run)
    : line(model), setup(run), stores(model), ways(model, run), columns(columns_of(model, run)) {
  for (int s = 0; s < stores.count; ++s) {
    const std::string name =
        s < stores.first_pool ? line.places[static_cast<std::size_t>(s)].name : "items in carriers";
    arrivals.push_back(net.add({.name = name, .counts = true, .initial = initial(s)}));
    departures.push_back(net.add({.name = name + " leaves", .counts = true}));
  }
  for (const Place& place : line.places)
    parked.push_back(net.add({.name = "carrier in " + place.name, .counts = true}));
  for (const Machine& machine : line.machines) {
    machine_freed.push_back(net.add({.name = machine.name + " let go", .counts = true}));
    machine_claimed.push_back(net.add({.name = machine.name + " claimed", .counts = true}));
  }
  add_operations(*this);
  add_tasks(*this);
  add_couplings(*this);
  done = needs_of(*this);
  add_requirements(*this);
  net.index_readers();
}

int LineNet::initial(int store) const {
  if (store >= stores.first_pool) return 0;
  const Place& place = line.places[static_cast<std::size_t>(store)];
  return place.berth ? 0 : static_cast<int>(place.initial.value(setup.order));
}

Tick LineNet::end_of(const Times& times) const {
  Tick end = 1;
  for (const auto& [store, tokens] : done)
    end = std::max(end, times.at(arrivals[static_cast<std::size_t>(store)], tokens));
  return end;
}

}  // namespace linewright::bounds
