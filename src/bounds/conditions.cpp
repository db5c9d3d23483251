#include "conditions.hpp"

#include <limits>

namespace linewright::bounds {
namespace {

std::optional<LowerLimit> limit_of(const Comparison& comparison, int order) {
  std::int64_t constant = comparison.constant;
  std::optional<Variable> variable;
  for (const Term& term : comparison.terms) {
    if (term.variable.kind == VariableKind::kOrder) {
      constant += std::int64_t{term.coefficient} * order;
    } else if (variable || term.coefficient != 1) {
      return std::nullopt;
    } else {
      variable = term.variable;
    }
  }
  const bool lower = comparison.relation == Relation::kGreater ||
                     comparison.relation == Relation::kGreaterEqual ||
                     comparison.relation == Relation::kEqual;
  if (!variable || !lower) return std::nullopt;
  const std::int64_t value = -constant + (comparison.relation == Relation::kGreater ? 1 : 0);
  if (value < 1 || value > std::numeric_limits<int>::max() / 2) return std::nullopt;
  return LowerLimit{*variable, static_cast<int>(value)};
}

}  // namespace

std::vector<LowerLimit> lower_limits(const Condition& condition, int order) {
  std::vector<LowerLimit> limits;
  if (condition.any_of.size() != 1) return limits;
  for (const Comparison& comparison : condition.any_of[0]) {
    if (const auto limit = limit_of(comparison, order)) limits.push_back(*limit);
  }
  return limits;
}

std::optional<Arc> arc_for(const LineNet& net, const LowerLimit& limit) {
  const auto id = static_cast<std::size_t>(limit.variable.index);
  const Arc arc{.times = 0, .plus = limit.value};
  const auto with = [&](int event) {
    Arc made = arc;
    made.from = event;
    return made;
  };
  switch (limit.variable.kind) {
    case VariableKind::kPlaceCount:
    case VariableKind::kPlaceAvailable:
      if (!net.line.places[id].berth) return with(net.arrivals[id]);
      break;
    case VariableKind::kOperationDone:
      return with(net.ends[id]);
    case VariableKind::kTaskDone:
      if (id < net.tasks.size()) return with(net.tasks[id].end);
      break;
    default:
      break;
  }
  const bool berth = (limit.variable.kind == VariableKind::kPlaceCount ||
                      limit.variable.kind == VariableKind::kPlaceAvailable ||
                      limit.variable.kind == VariableKind::kPlaceRoom ||
                      limit.variable.kind == VariableKind::kPlaceOccupied) &&
                     net.line.places[id].berth;
  if (!berth) return std::nullopt;
  Arc made = with(net.parked[id]);  // something is in it only while a carrier stands there
  made.plus = 1;
  return made;
}

}  // namespace linewright::bounds
