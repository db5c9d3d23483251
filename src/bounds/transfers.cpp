#include "transfers.hpp"

#include <algorithm>

namespace linewright::bounds {
namespace {

/// The comparison says: count of the place <= this.
std::optional<int> most_of(const Comparison& comparison, PlaceId place) {
  if (comparison.terms.size() != 1) return std::nullopt;
  const Term& term = comparison.terms[0];
  if (term.variable.kind != VariableKind::kPlaceCount || term.coefficient != 1 ||
      term.variable.index != place.value) {
    return std::nullopt;
  }
  switch (comparison.relation) {
    case Relation::kEqual:
    case Relation::kLessEqual:
      return -comparison.constant;
    case Relation::kLess:
      return -comparison.constant - 1;
    default:
      return std::nullopt;
  }
}

}  // namespace

std::optional<int> supply_loaded(const LineNet& net, const Task& task,
                                 const TransferAction& transfer, int item) {
  if (!transfer.source.place || transfer.destination.place) return std::nullopt;
  if (task.crew[transfer.destination.slot].wanted != CarrierWanted::kEmpty) return std::nullopt;
  const PlaceId place = *transfer.source.place;
  const auto store = static_cast<std::size_t>(net.stores.of(place));
  const bool reserved =
      std::any_of(net.line.tasks.begin(), net.line.tasks.end(), [&](const Task& other) {
        return std::any_of(other.reserves.begin(), other.reserves.end(),
                           [&](const Reservation& r) { return r.place == place; });
      });
  const auto& taken_by = net.net[net.departures[store]].sources;
  const bool all_from_start = net.net[net.arrivals[store]].sources.empty();
  if (reserved || !all_from_start || taken_by.size() != 1 || taken_by[0].event != item)
    return std::nullopt;
  return net.initial(static_cast<int>(store));
}

std::optional<int> most_when_chosen(const LineNet& net, const Task& task, PlaceId place, int item) {
  if (net.line.places[place.index()].berth || task.when.any_of.size() != 1) return std::nullopt;
  const auto& brought_by = net.net[net.arrivals[place.index()]].sources;
  if (brought_by.size() != 1 || brought_by[0].event != item) return std::nullopt;
  std::optional<int> most;
  for (const Comparison& comparison : task.when.any_of[0]) {
    const auto one = most_of(comparison, place);
    if (one) most = std::min(most.value_or(*one), *one);
  }
  return most;
}

}  // namespace linewright::bounds
