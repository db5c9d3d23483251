#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "linewright/base/tick.hpp"
#include "linewright/environment/environment.hpp"
#include "linewright/network/network_options.hpp"

namespace linewright {

/// Which agent learns. The same trainer runs all of them.
struct AlgorithmSettings {
  enum class Kind : std::uint8_t { kDqn, kPpo };

  std::string name = "ebq-n";  ///< for logs and reports: letters, digits, '-', '_' and '.'
  Kind kind = Kind::kDqn;      ///< `dqn`: Q-learning from the buffer; `ppo`: actor and critic
};

/// What is stored, and how it is drawn again.
struct BufferSettings {
  bool modify_reward = true;        ///< episode-end processing changes the rewards
  double eta4 = 0.1;                ///< weight of a success's bonus, 0 to 1000
  double eta5 = 0.001;              ///< what each decision of a failure loses, 0 to 1000
  std::int32_t copies = 5;          ///< how often a success is stored (eta6), 1 to 1000
  std::int64_t capacity = 500'000;  ///< transitions, copies counted, 1 to 1e8; about 2 kB each
                                    ///< (a copy costs nothing)
  bool prioritized = true;          ///< draw by |TD error|^alpha; else uniformly
  double alpha = 0.5;               ///< 0 (uniform) to 1
  double beta_start = 0.4;          ///< how far importance weights undo the bias, 0 to 1 ...
  double beta_end = 1.0;            ///< ... rising linearly to this with the last update
  /// Targets are at least what was reached in the episode (He et al., Learning to Play in a Day,
  /// 2017): right where the same decisions lead to the same end, as they do with `sap`.
  bool return_bound = true;
  std::int32_t n_step = 5;  ///< rewards added up before the bootstrap, 1 to 1000
};

/// How actions are tried out while learning.
struct ExplorationSettings {
  enum class Noise : std::uint8_t { kPerDecision, kPerEpisode };

  bool epsilon_greedy = false;  ///< a random choice with probability epsilon; else the best one
  /// How long noisy layers keep their noise. A whole episode with one noise tries out a policy, as
  /// a person would try out a habit; fresh noise for every decision mixes many.
  Noise noise = Noise::kPerEpisode;
  /// The noise of an episode is multiplied by a number between 0 and this, 0 to 100: some episodes
  /// still try out something new when learning has made the noise small.
  double noise_factor = 4.0;
  double epsilon_start = 1.0;                ///< 0 to 1
  double epsilon_end = 0.02;                 ///< 0 to `epsilon_start`
  std::int64_t epsilon_decisions = 100'000;  ///< over which epsilon falls linearly, 0 to 1e12
};

/// What one update is, and how many there are.
struct OptimizerSettings {
  double learning_rate = 1e-3;      ///< of Adam, 1e-9 to 1 ...
  double learning_rate_end = 1e-5;  ///< ... changing linearly to this with the last update
  double adam_epsilon = 1.5e-4;     ///< 1e-12 to 1
  /// The policy is a running mean of the weights, of which every update keeps this share; 0: the
  /// weights themselves. 0 to 0.99999.
  double average = 0.998;
  std::int32_t batch = 128;         ///< transitions per update, 1 to 65536; time grows with it
  double gamma = 0.997;             ///< discount per decision, 0 to 1
  double gradient_clip = 10.0;      ///< largest norm of the gradient, 1e-6 to 1e6
  bool double_q = true;             ///< the online network chooses the action of the target
  std::int64_t target_every = 100;  ///< updates between copies to the target network, 1 to 1e9
  std::int64_t updates = 6'000;     ///< in all, 1 to 1e9; the time of a run grows with it
  std::int64_t decisions_per_update = 128;  ///< decisions made for each update, 1 to 1e9
  bool count_copies = false;  ///< `decisions_per_update` counts a decision as often as it is stored
  std::int64_t warmup = 20'000;  ///< transitions, copies counted, stored from random decisions
                                 ///< before the first update, `batch` to `capacity`
};

/// Only for `kind: ppo`; what it shares with Q-learning stands in the other groups. Successes count
/// `buffer.copies` times in its loss.
struct PpoSettings {
  std::int32_t episodes_per_update = 32;  ///< collected before each round of learning, 1 to 10000
  std::int32_t epochs = 4;                ///< passes over them, 1 to 100; time grows with it
  std::int32_t minibatch = 256;           ///< decisions per step of the optimizer, 1 to 65536
  double clip = 0.2;                      ///< of the ratio of probabilities, 0.001 to 1
  double gae_lambda = 0.95;               ///< of generalised advantage estimation, 0 to 1
  double entropy = 0.01;                  ///< weight of the entropy bonus, 0 to 10
  double value_coefficient = 0.5;         ///< weight of the critic's loss, 0 to 100
  bool normalize_advantages = true;       ///< to mean 0 and deviation 1, in each round
};

/// Ticks allowed for the crews that have these many workers.
struct HorizonRule {
  std::vector<std::pair<std::string, std::int32_t>> crew;  ///< {kind, count}; empty: any crew
  Tick ticks = 1000;                                       ///< 1 to kMaxTicks
};

/// The runs that are learned from, and when the result is looked at.
struct RunSettings {
  enum class Crews : std::uint8_t { kInTurn, kSampled };

  std::int32_t environments = 64;  ///< runs side by side, 1 to 4096; the result depends on it
  std::int32_t threads = 0;        ///< 0: one per core, to 1024; the result does not depend on it
  std::string allocator = "sap";   ///< who does the chosen task
  std::optional<std::int32_t> order;  ///< quantity ordered, 1 to 1e6; none: the scenario's
  /// The first rule that fits the crew counts.
  std::vector<HorizonRule> horizon;
  /// Where no rule fits: this many times the mean makespan of the planner `first` with the same
  /// crew, but never more than the scenario's horizon; 0: the scenario's horizon. 0 to 100.
  double horizon_factor = 1.25;
  PauseOptions pauses{.episodes = 0.1};
  Crews crews = Crews::kInTurn;           ///< all of the scenario's one after the other, or drawn
  std::int64_t evaluate_every = 200;      ///< updates between greedy evaluations, 1 to 1e9
  std::int32_t evaluation_trials = 10;    ///< runs per crew in each, 1 to 10000; time grows with it
  std::int64_t checkpoint_every = 1'000;  ///< updates, 1 to 1e9
};

/// Everything that a training run depends on besides the scenario and the seed.
struct TrainingOptions {
  AlgorithmSettings algorithm;
  NetworkOptions network;  ///< its `actor_critic` follows from `algorithm.kind`
  RewardOptions reward;
  BufferSettings buffer;
  ExplorationSettings exploration;
  OptimizerSettings optimizer;
  PpoSettings ppo;
  RunSettings run;
};

/// Ticks that the rules allow a crew of {kind, count}; none: no rule fits.
[[nodiscard]] std::optional<Tick> horizon_for(
    const RunSettings& run, const std::vector<std::pair<std::string, std::int32_t>>& crew);

/// Reads options from `file` (docs/formats/training.md), lays the file `preset` on them (empty:
/// none), and then each override, `group.key=value`. Keys that nobody gives keep the defaults
/// above. Throws ScenarioError with everything that is wrong, where it stands and the nearest known
/// key.
[[nodiscard]] TrainingOptions load_training_options(const std::string& file,
                                                    const std::string& preset = {},
                                                    const std::vector<std::string>& overrides = {});

/// The same from a text, which cannot extend a file; `file_name` is only used in diagnostics.
[[nodiscard]] TrainingOptions training_options_from_text(
    std::string_view text, const std::string& file_name,
    const std::vector<std::string>& overrides = {});

/// All options as YAML, group by group; reading it gives the same options, to the last bit.
[[nodiscard]] std::string to_yaml(const TrainingOptions& options);

/// Throws ScenarioError when options that were put together in code are out of range.
void check_training_options(const TrainingOptions& options);

}  // namespace linewright
