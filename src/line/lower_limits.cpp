#include "linewright/line/lower_limits.hpp"

#include <limits>
#include <optional>

namespace linewright {
namespace {

std::optional<LowerLimit> limit_of(const Comparison& comparison, std::int32_t order) {
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
  if (value < 1 || value > std::numeric_limits<std::int32_t>::max() / 2) return std::nullopt;
  return LowerLimit{*variable, static_cast<std::int32_t>(value)};
}

}  // namespace

std::vector<LowerLimit> lower_limits(const Condition& condition, std::int32_t order) {
  std::vector<LowerLimit> limits;
  if (condition.any_of.size() != 1) return limits;
  for (const Comparison& comparison : condition.any_of[0]) {
    if (const auto limit = limit_of(comparison, order)) limits.push_back(*limit);
  }
  return limits;
}

}  // namespace linewright
