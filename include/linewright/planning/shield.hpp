#pragma once

#include <cstdint>
#include <memory>
#include <unordered_map>
#include <vector>

#include "linewright/allocation/allocator.hpp"
#include "linewright/base/random.hpp"
#include "linewright/planning/state_key.hpp"
#include "linewright/simulation/simulator.hpp"

namespace linewright {

class Reach;

/// How hard a Shield looks.
struct ShieldOptions {
  /// Continuations by simple rules that try to show that the order can still be finished (about
  /// 50 us each on the duct line); more: fewer searches.
  std::size_t rollouts = 24;
  /// States searched where none of them does (about 3 us and 50 bytes each); more: fewer unknown.
  std::size_t max_states = 50'000;
};

/// Keeps a run out of dead states: says of a decision whether the order can be finished after it,
/// the horizon aside. Exact within its limits: `kSafe` has been seen to finish, `kFatal` cannot
/// finish whatever is decided and however long one waits (agents chosen as by `sap`). Remembers
/// what it has found until the next reset. Serves one run at a time; deterministic.
class Shield {
 public:
  enum class Verdict : std::uint8_t {
    kSafe,     ///< there is a future in which the order is finished
    kFatal,    ///< there is none
    kUnknown,  ///< not found out within the limits
  };

  /// What it has done since the last reset.
  struct Statistics {
    std::size_t judged = 0;
    std::size_t fatal = 0;
    std::size_t unknown = 0;
    std::size_t remembered = 0;  ///< judged from memory
    std::size_t rollouts = 0;
    std::size_t searches = 0;
    std::size_t states = 0;  ///< looked at by the searches
  };

  /// The simulator must outlive it.
  explicit Shield(const Simulator& simulator, const ShieldOptions& options = {});
  ~Shield();
  Shield(const Shield&) = delete;
  Shield& operator=(const Shield&) = delete;

  /// Forgets everything: the next run gets the same verdicts whatever was before.
  void reset();

  /// Of the state after a decision (Simulator::assign) or after waiting.
  [[nodiscard]] Verdict judge(const SimulationState& after);

  [[nodiscard]] const Statistics& statistics() const { return statistics_; }

 private:
  /// A simple rule: the first selectable task of an order; lazy ones only when nothing is under
  /// way.
  struct Rule {
    std::vector<TaskId> order;
    std::vector<bool> lazy;  ///< by task
  };

  [[nodiscard]] Verdict look(SimulationState& state);
  [[nodiscard]] Verdict find_out(const SimulationState& state);
  [[nodiscard]] bool some_rule_finishes(const SimulationState& from, std::size_t first,
                                        std::size_t end);
  [[nodiscard]] bool finishes(SimulationState& state, const Rule& rule);
  [[nodiscard]] Verdict search(const SimulationState& start, std::size_t most);
  [[nodiscard]] Rule next_rule();

  const Simulator& simulator_;
  ShieldOptions options_;
  std::unique_ptr<Allocator> allocator_;
  std::unique_ptr<Reach> reach_;
  RandomStream random_;
  std::vector<Rule> rules_;  ///< those that finished lately first
  std::unordered_map<StateKey, Verdict, StateKeyHash> known_;
  std::vector<StateKey> trail_;
  std::vector<std::int32_t> scratch_;
  SimulationState judged_;
  SimulationState state_;
  Statistics statistics_;
};

}  // namespace linewright
