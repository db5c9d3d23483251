#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "linewright/base/random.hpp"
#include "linewright/base/worker_pool.hpp"
#include "linewright/environment/vector_environment.hpp"
#include "linewright/network/network.hpp"
#include "linewright/training/episode.hpp"

namespace linewright::learning {

/// How decisions are made while experience is collected.
struct Behaviour {
  enum class Choice : std::uint8_t {
    kBest,     ///< the largest Q value
    kSampled,  ///< by the probabilities of the logits
  };

  const Network* network = nullptr;  ///< none: uniformly at random
  Choice choice = Choice::kBest;
  double epsilon = 0.0;            ///< share of decisions that are uniformly random instead
  bool noisy = false;              ///< in networks that have it, a run's own noise ...
  bool noise_per_episode = false;  ///< ... fresh for every episode; else for every decision
  double noise_factor = 1.0;       ///< an episode's is multiplied by a number up to this
  const Noise* noise = nullptr;    ///< instead: this noise for every decision
};

/// An episode that has ended.
struct FinishedEpisode {
  std::uint64_t number = 0;  ///< in the plan
  /// With the environment's rewards. Without the decisions up to the last pause: what followed on
  /// them did not come of them.
  Episode episode;
  std::vector<std::uint16_t> actions;  ///< all of them
  double total_reward = 0.0;
  double progress = 0.0;  ///< share of the order, 0 ... 1
  // By decision, with Behaviour::kSampled:
  std::vector<float> log_probability;
  std::vector<float> value;
};

/// Plays episodes and writes down what happened. Deterministic for a seed and a number of runs.
class Collector {
 public:
  /// The environments and the pool must outlive it.
  Collector(VectorEnvironment& environments, WorkerPool& pool, std::uint64_t seed);

  /// Starts the plan from its first episode.
  void start();

  /// One decision of every run. Episodes that end are appended to `finished`, in order of the runs.
  void collect(const Behaviour& behaviour, std::vector<FinishedEpisode>& finished);

  /// What is needed to go on later.
  struct RunState {
    std::uint64_t episode = 0;
    std::vector<std::uint16_t> actions;  ///< of the episode so far, all of them
    RandomStream::State random{};
    double total_reward = 0.0;           ///< of the episode so far
    std::vector<float> log_probability;  ///< with Behaviour::kSampled, of the episode so far
    std::vector<float> value;
  };
  [[nodiscard]] std::vector<RunState> state() const;

  /// Goes on from there: the episodes are played again up to where they were. `begun` gives run i's
  /// episode so far, with observations and rewards.
  void restore(const std::vector<RunState>& state, std::vector<Episode> begun);

 private:
  struct Run {
    explicit Run(std::uint64_t seed, std::size_t number)
        : random(RandomStream::derive(seed, "behaviour", number)) {}
    RandomStream random;
    FinishedEpisode current;
    Noise noise;
    std::optional<std::uint64_t> noise_of;  ///< the episode that it was drawn for
  };
  struct Thread {
    Workspace workspace;
    NetworkOutput output;
    std::vector<float> probability;
  };

  std::size_t choose(const Behaviour& behaviour, Run& run, Thread& thread, ObservationView view);
  void draw_noise(const Behaviour& behaviour, Run& run) const;
  std::size_t sample(Run& run, Thread& thread, ObservationView view) const;
  static void forget_decisions(FinishedEpisode& current);
  void write_down(std::size_t run, std::vector<FinishedEpisode>& finished);
  void begin(Run& run);
  [[nodiscard]] ObservationRows rows();

  VectorEnvironment& environments_;
  std::uint64_t seed_;
  ObservationSize size_;
  std::vector<Run> runs_;
  std::vector<Thread> threads_;
  std::vector<float> features_;
  std::vector<std::uint8_t> present_;
  std::vector<std::uint8_t> selectable_;
};

/// Sizes of a spec's observations.
[[nodiscard]] ObservationSize size_of(const ObservationSpec& spec);

/// The selectable action with the largest value; ties: the first. There must be one.
[[nodiscard]] std::size_t best_action(const std::vector<float>& values,
                                      const std::uint8_t* selectable);

}  // namespace linewright::learning
