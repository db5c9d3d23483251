#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "linewright/base/worker_pool.hpp"
#include "linewright/environment/environment.hpp"

namespace linewright {

/// Which runs are played, one after the other, in each of the environments.
struct EpisodePlan {
  enum class Order : std::uint8_t {
    kInTurn,   ///< every crew as often as the others
    kSampled,  ///< drawn uniformly for each episode
  };

  std::vector<RunOptions> crews;  ///< with order and horizon, one or more
  Order order = Order::kInTurn;
  std::uint64_t seed = 1;  ///< start positions, crews and allocators follow from it
};

/// One episode of the plan.
struct PlannedEpisode {
  std::size_t crew = 0;    ///< index into EpisodePlan::crews
  std::uint64_t seed = 0;  ///< of its start positions and its allocator
};

/// Episode `number` of a plan: the same whoever plays it, in whatever order.
[[nodiscard]] PlannedEpisode episode_of(const EpisodePlan& plan, std::uint64_t number);

/// The observations of all runs, one row each, in memory of the caller.
struct ObservationRows {
  float* features = nullptr;           ///< [runs, feature_count]
  std::uint8_t* present = nullptr;     ///< [runs, token_count]
  std::uint8_t* selectable = nullptr;  ///< [runs, actions]
};

/// Many environments that play a plan side by side on several threads. A run that has ended is
/// followed at once by its next episode. Results depend on the plan and the number of runs, never
/// on the number of threads.
class VectorEnvironment {
 public:
  /// What a step of one run brought. After `ended`, the observation is that of the next episode.
  struct Step {
    StepResult result;
    Tick makespan = 0;           ///< when ended
    Tick horizon = 0;            ///< when ended
    double progress = 0.0;       ///< when ended: share of the order
    std::int32_t decisions = 0;  ///< when ended
    std::uint64_t episode = 0;   ///< number of the episode that this step belongs to
  };

  /// Decides for a run: called from several threads at once, for different runs.
  using Choose = std::function<std::size_t(std::size_t run, std::size_t thread, ObservationView)>;

  /// The simulator and the pool must outlive it. Throws ScenarioError for a crew or an allocator
  /// that does not exist, and for a plan in which a run ends before its first decision.
  VectorEnvironment(const Simulator& simulator, EpisodePlan plan, const std::string& allocator,
                    const RewardOptions& rewards, std::size_t runs, WorkerPool& pool,
                    const PauseOptions& pauses = {});

  [[nodiscard]] std::size_t size() const { return runs_.size(); }
  [[nodiscard]] const ObservationSpec& spec() const { return encoder_.spec(); }

  /// Starts run i with episode i, and writes the observations.
  void reset(ObservationRows out);

  /// Starts run i anew with an episode of the plan, as it stands after the given actions.
  void restore(std::size_t run, std::uint64_t episode, const std::vector<std::uint16_t>& actions,
               ObservationRows out);

  /// One decision of every run: `actions` by run. Writes the new observations and steps()[run].
  void step(const std::vector<std::uint16_t>& actions, ObservationRows in_out);

  /// The same with the decisions made where the runs are: `choose` sees the old observation.
  void step(const Choose& choose, ObservationRows in_out);

  [[nodiscard]] const std::vector<Step>& steps() const { return steps_; }
  /// The episode that run i plays now.
  [[nodiscard]] std::uint64_t episode(std::size_t run) const { return runs_[run].episode; }

 private:
  struct Run {
    std::unique_ptr<Environment> environment;
    std::uint64_t episode = 0;
  };

  void start(std::size_t run, std::uint64_t episode);
  void step_one(std::size_t run, std::size_t action, ObservationRows rows);
  [[nodiscard]] ObservationView row(ObservationRows rows, std::size_t run) const;

  const Simulator& simulator_;
  ObservationEncoder encoder_;
  EpisodePlan plan_;
  WorkerPool& pool_;
  std::vector<Run> runs_;
  std::vector<Step> steps_;
};

}  // namespace linewright
