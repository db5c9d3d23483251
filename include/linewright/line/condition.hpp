#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "linewright/base/tick.hpp"

namespace linewright {

/// What an integer condition may read from the running line. `index` of a Variable is the id of the
/// entity named in the comment (unused for kOrder).
enum class VariableKind : std::uint8_t {
  kPlaceCount,      ///< `flange_buffer`: tokens that lie there, also those reserved; for a berth:
                    ///< items in the carrier standing there, 0 when none stands there
  kPlaceAvailable,  ///< `flange_buffer.available`: tokens there that nobody has reserved
  kPlaceRoom,      ///< `flange_buffer.room`: free capacity less reserved room; for a berth: room in
                   ///< the carrier standing there, 0 when none stands there
  kPlaceOccupied,  ///< `outfeed.occupied`: 1 when a carrier stands in the berth, else 0
  kMachineFree,    ///< `press.free`: 1 when an operation could take it now, else 0
  kMachineWorking,    ///< `press.working`: 1 while an operation runs on it or holds it between two
                      ///< operations (claims); 0 while free and while recovering
  kOperationRunning,  ///< `weld.running`: firings of the operation in progress
  kOperationDone,     ///< `weld.done`: firings completed since the start
  kTaskRunning,       ///< `load.running`: executions of the task in progress
  kTaskDone,          ///< `load.done`: executions of the task completed
  kWorkersFree,       ///< `human.free`: workers of the kind with no task
  kCarriersFree,  ///< `cage.free`: carriers of the kind bound to no task and standing in no berth
  kOrder,         ///< `order`: quantity ordered
};

struct Variable {
  VariableKind kind = VariableKind::kPlaceCount;
  std::int32_t index = 0;
  friend bool operator==(const Variable&, const Variable&) = default;
};

/// coefficient * variable.
struct Term {
  Variable variable;
  std::int32_t coefficient = 1;
};

enum class Relation : std::uint8_t {
  kEqual,
  kNotEqual,
  kLess,
  kLessEqual,
  kGreater,
  kGreaterEqual
};

/// sum  RELATION  0.
[[nodiscard]] inline bool relation_holds(std::int64_t sum, Relation relation) {
  switch (relation) {
    case Relation::kEqual:
      return sum == 0;
    case Relation::kNotEqual:
      return sum != 0;
    case Relation::kLess:
      return sum < 0;
    case Relation::kLessEqual:
      return sum <= 0;
    case Relation::kGreater:
      return sum > 0;
    case Relation::kGreaterEqual:
      return sum >= 0;
  }
  return false;
}

/// sum(terms) + constant  RELATION  0.
struct Comparison {
  std::vector<Term> terms;
  std::int32_t constant = 0;
  Relation relation = Relation::kGreater;
};

/// An integer condition in disjunctive normal form: true when every comparison of at least one
/// clause holds. No clause at all means "always true"; `text` is what the user wrote.
struct Condition {
  std::vector<std::vector<Comparison>> any_of;
  std::string text;

  [[nodiscard]] bool always() const { return any_of.empty(); }
};

}  // namespace linewright
