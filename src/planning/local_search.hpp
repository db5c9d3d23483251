#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "future.hpp"
#include "linewright/base/random.hpp"
#include "linewright/planning/planner.hpp"

namespace linewright::planning {

/// Improves a future by changing one decision at a time: another task at one decision, somebody
/// else who does it, or waiting for a later one. What follows stays in its order as far as it is
/// possible. One per thread.
class LocalSearch {
 public:
  /// Both must outlive it. `base` decides where a future goes on longer than the one it came from.
  /// `free_agents`: who does a task is changed, too.
  LocalSearch(FuturePlayer& player, Planner& base, bool free_agents);

  /// Starts from this future. `first` (null: everything) limits its first decision, and must live
  /// until the last step.
  void begin(const Future& from, const Choices* first);

  /// Plays one future that differs from the one it stands at. False: there was nothing to change.
  bool step(RandomStream& random);

  /// A future that is worse by up to about this many ticks may be gone on from; 0: never.
  void set_temperature(double ticks) { temperature_ = ticks; }

  /// The best one since `begin`.
  [[nodiscard]] const Future& best() const { return best_; }

 private:
  [[nodiscard]] Choices choices_at(std::size_t position) const;
  bool change(std::size_t position, RandomStream& random);
  bool change_task(std::size_t position, RandomStream& random);
  bool change_agent(std::size_t position, RandomStream& random);
  bool insist_on_later(std::size_t position, RandomStream& random);
  void copy_rest(std::size_t position);
  [[nodiscard]] std::optional<std::int16_t> other_member(const SimulationState& state,
                                                         const Wish& wish, std::size_t slot,
                                                         bool busy, RandomStream& random);
  void accept(std::size_t position);

  FuturePlayer& player_;
  Planner& base_;
  bool free_agents_;
  double temperature_ = 0.0;
  const Choices* first_ = nullptr;
  Future current_;
  Future candidate_;
  Future best_;
  std::vector<Wish> wishes_;
  std::vector<std::int16_t> members_;
};

}  // namespace linewright::planning
