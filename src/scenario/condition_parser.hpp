#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

#include "linewright/line/condition.hpp"

namespace linewright::loading {

/// What is wrong with a condition, and what to write instead.
struct ConditionFault {
  std::string message;
  std::string hint;
};

/// Gives the variable that a dotted name stands for, or says why there is none.
using VariableLookup = std::function<std::variant<Variable, ConditionFault>(std::string_view name)>;

/// Parses one condition into disjunctive normal form. `not` goes into the relations, so that no
/// negation is left. Bounded: conditions of more than 1000 comparisons are refused.
[[nodiscard]] std::variant<Condition, ConditionFault> parse_condition(std::string_view text,
                                                                      const VariableLookup& lookup);

/// Both must hold. Nothing when the result would be too large.
[[nodiscard]] std::optional<Condition> both(Condition a, const Condition& b);

}  // namespace linewright::loading
