#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "linewright/allocation/allocator.hpp"
#include "linewright/base/random.hpp"
#include "linewright/planning/planner.hpp"
#include "linewright/simulation/simulator.hpp"

// Futures of a run: what follows from a state when a list of wishes says what is decided.
namespace linewright::planning {

/// A wish for a decision.
struct Wish {
  TaskId task;
  bool insist = false;  ///< wait until it is possible, rather than take another task meanwhile
  bool named = false;   ///< `members` do it; else whom the allocator chooses
  std::array<std::int16_t, kMaxCrew> members{};  ///< of a decision that was played: who did it
};

/// What a future is worth; the lower the better: the makespan, or, of one that does not finish,
/// kUnfinished and more the less of the order it makes.
using Cost = std::int64_t;
inline constexpr Cost kUnfinished = Cost{1} << 40;
inline constexpr Cost kWorst = Cost{1} << 50;

/// A future that was played: what was decided, and the state before each decision.
struct Future {
  std::vector<Wish> decisions;
  std::vector<SimulationState> before;  ///< at least as many as decisions
  Cost cost = kWorst;
};

/// Who plays futures, and what it may do in them.
struct PlayerOptions {
  std::string allocator = "sap";
  bool wait = false;  ///< besides LineModel::allow_wait
  /// Futures played to rate one list of wishes, where the allocator draws at random.
  std::size_t samples = 8;
  /// Asked now and then in a future: whether to give it up. None: never.
  std::function<bool()> give_up;
};

/// Plays futures. One per thread. Where the allocator draws at random the cost is the mean of
/// several futures, always with the same random numbers until `reseed`; they are not those of the
/// run.
class FuturePlayer {
 public:
  /// Everything must outlive it.
  FuturePlayer(const Simulator& simulator, PlayerOptions options);

  [[nodiscard]] bool may_wait() const { return may_wait_; }
  /// Whether equal wishes can have different futures.
  [[nodiscard]] bool is_random() const { return allocator_->draws(); }
  [[nodiscard]] const Simulator& simulator() const { return simulator_; }
  [[nodiscard]] Allocator& allocator() { return *allocator_; }

  /// Plays from `start` to the end of the run, or until it is clear that the cost is above `bound`
  /// (then kWorst). At each decision the first wish that is possible is granted, and `base` decides
  /// when none is. `first`: what may be chosen at the first decision; null: everything.
  /// `result.decisions` and `result.before` are what happened, from `start` on.
  void play(const SimulationState& start, const Choices* first, std::vector<Wish>& wishes,
            Planner& base, Cost bound, Future& result);

  void reseed(std::uint64_t seed) { seed_ = seed; }

 private:
  enum class Step : std::uint8_t { kTaken, kWaited, kStuck };

  void play_one(const SimulationState& start, const Choices* first, std::vector<Wish>& wishes,
                Planner& base, Cost bound, Future& result);
  Step decide(const Choices& choices, std::vector<Wish>& wishes, Planner& base, Future& result);
  Step take(Wish wish, Future& result);
  [[nodiscard]] bool possible(const Wish& wish, Assignment& assignment) const;
  [[nodiscard]] Cost cost_of_end() const;

  const Simulator& simulator_;
  PlayerOptions options_;
  bool may_wait_;
  std::unique_ptr<Allocator> allocator_;
  std::uint64_t seed_ = 0;
  SimulationState state_;
  Tick horizon_ = 0;
  bool waited_ = false;  ///< for the decision that is due
  Future sample_;
  std::vector<Wish> sample_wishes_;
};

}  // namespace linewright::planning
