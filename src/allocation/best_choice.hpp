#pragma once

#include <cstdint>
#include <optional>

#include "linewright/base/tick.hpp"
#include "linewright/simulation/assignment.hpp"

namespace linewright::allocation {

/// Who is chosen for an errand; carrier kNobody: it has none.
struct Choice {
  std::int16_t worker = Assignment::kNobody;
  std::int16_t carrier = Assignment::kNobody;
};

/// What a rule keeps small: first the ticks, then the metres.
struct Cost {
  Tick ticks = 0;
  double metres = 0.0;
};

/// The choice of least cost so far; of equal ones the first carrier by number, then the first
/// worker, in whatever order they are considered.
class Best {
 public:
  void consider(Cost cost, Choice choice) {
    if (found_ && !before(cost, choice)) return;
    found_ = true;
    cost_ = cost;
    choice_ = choice;
  }

  /// Whether nothing that costs `ticks` or more can be chosen any more.
  [[nodiscard]] bool is_below(Tick ticks) const { return found_ && cost_.ticks < ticks; }

  [[nodiscard]] std::optional<Choice> choice() const {
    return found_ ? std::optional<Choice>(choice_) : std::nullopt;
  }

 private:
  [[nodiscard]] bool before(Cost cost, Choice choice) const {
    if (cost.ticks != cost_.ticks) return cost.ticks < cost_.ticks;
    if (cost.metres != cost_.metres) return cost.metres < cost_.metres;
    if (choice.carrier != choice_.carrier) return choice.carrier < choice_.carrier;
    return choice.worker < choice_.worker;
  }

  bool found_ = false;
  Cost cost_;
  Choice choice_;
};

}  // namespace linewright::allocation
