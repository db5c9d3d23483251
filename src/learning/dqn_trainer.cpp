#include "dqn_trainer.hpp"

#include <algorithm>
#include <deque>
#include <map>
#include <memory>
#include <set>
#include <stdexcept>
#include <utility>

#include "linewright/base/diagnostic.hpp"
#include "linewright/learning/q_learner.hpp"
#include "linewright/training/episode_end.hpp"
#include "linewright/training/replay_buffer.hpp"
#include "session.hpp"

namespace linewright::learning {
namespace {

ReplayOptions replay_options(const TrainingOptions& options) {
  return {.capacity = static_cast<std::size_t>(options.buffer.capacity),
          .prioritized = options.buffer.prioritized,
          .alpha = options.buffer.alpha,
          .n_step = static_cast<std::size_t>(options.buffer.n_step),
          .gamma = options.optimizer.gamma};
}

class DqnTrainer {
 public:
  DqnTrainer(const TrainingRun& run, const TrainingHooks& hooks)
      : session_(run, hooks),
        options_(session_.options()),
        replay_(size_of(session_.spec()), replay_options(options_)),
        learner_(session_.spec(), session_.network(),
                 initial_tensors(session_.spec(), session_.network(), run.seed),
                 {.adam_epsilon = options_.optimizer.adam_epsilon,
                  .average = options_.optimizer.average,
                  .gradient_clip = options_.optimizer.gradient_clip,
                  .double_q = options_.optimizer.double_q,
                  .return_bound = options_.buffer.return_bound,
                  .threads = session_.threads()},
                 run.seed),
        sampling_(RandomStream::derive(run.seed, "replay")) {}

  TrainingResult train() {
    begin();
    // Algorithm 1; `session_` counts, logs and evaluates.
    std::vector<FinishedEpisode> finished;
    while (!done() && !session_.cancelled()) {
      session_.collector().collect(behaviour(), finished);  // observe, choose, act
      session_.status().decisions += options_.run.environments;
      if (warm() && !options_.optimizer.count_copies) credit_ += options_.run.environments;
      for (FinishedEpisode& episode : finished) store(episode);
      finished.clear();
      bool learned = false;
      while (warm() && credit_ >= options_.optimizer.decisions_per_update && !done()) {
        credit_ -= options_.optimizer.decisions_per_update;
        update();
        learned = true;
      }
      if (learned) network_ = acting_network();
      if (checkpoint_due_) write_checkpoint();
      session_.show();
    }
    if (session_.cancelled()) write_checkpoint();
    return session_.finish(learner_.averaged_tensors());
  }

 private:
  [[nodiscard]] bool done() const { return updates() >= options_.optimizer.updates; }
  [[nodiscard]] bool warm() const { return warm_; }
  [[nodiscard]] std::int64_t updates() const { return session_.status().updates; }

  /// Random until the buffer is warm; then by the network, with the
  /// algorithm's exploration.
  Behaviour behaviour() {
    const ExplorationSettings& exploration = options_.exploration;
    if (!warm()) return {};
    Behaviour behaviour{
        .network = network_.get(),
        .noisy = options_.network.noisy,
        .noise_per_episode = exploration.noise == ExplorationSettings::Noise::kPerEpisode,
        .noise_factor = exploration.noise_factor};
    if (exploration.epsilon_greedy) {
      const double share =
          static_cast<double>(session_.status().decisions) /
          static_cast<double>(std::max<std::int64_t>(1, exploration.epsilon_decisions));
      behaviour.epsilon = between(exploration.epsilon_start, exploration.epsilon_end, share);
    }
    session_.status().epsilon = behaviour.epsilon;
    return behaviour;
  }

  /// Episode-end processing: the temporary buffer goes into the replay buffer.
  void store(FinishedEpisode& finished) {
    session_.count(finished);
    Episode& episode = finished.episode;
    records_.push_back({finished.number, finished.actions});
    const int copies = process_episode_end(episode, episode_end_options(options_.buffer));
    replay_.insert(episode, static_cast<std::size_t>(copies), finished.number);
    const auto stored = static_cast<std::int64_t>(episode.size()) * copies;
    session_.status().stored += stored;
    if (warm() && options_.optimizer.count_copies) credit_ += stored;
    if (!warm_ && session_.status().stored >= options_.optimizer.warmup) {
      warm_ = true;
      network_ = acting_network();
    }
  }

  void update() {
    const double share =
        static_cast<double>(updates()) / static_cast<double>(options_.optimizer.updates);
    const double beta = between(options_.buffer.beta_start, options_.buffer.beta_end, share);
    session_.status().learning_rate =
        between(options_.optimizer.learning_rate, options_.optimizer.learning_rate_end, share);
    replay_.sample(static_cast<std::size_t>(options_.optimizer.batch), beta, sampling_, batch_);
    const UpdateReport report =
        learner_.update(batch_, session_.status().learning_rate, td_errors_);
    if (!report.finite()) session_.refuse_not_finite(report);
    replay_.update_priorities(batch_.index, td_errors_);
    session_.count(report);
    if (updates() % options_.optimizer.target_every == 0) learner_.copy_target();
    if (session_.due(std::max<std::int64_t>(1, options_.run.evaluate_every / 5))) {
      session_.report();
    }
    if (session_.due(options_.run.evaluate_every)) session_.evaluate(learner_.averaged_tensors());
    if (session_.due(options_.run.checkpoint_every)) checkpoint_due_ = true;
  }

  std::unique_ptr<const Network> acting_network() {
    return std::make_unique<const Network>(session_.spec(), session_.network(), learner_.tensors());
  }

  void begin() {
    const std::optional<Checkpoint> checkpoint = session_.resumed();
    session_.open_logs(checkpoint ? &*checkpoint : nullptr);
    if (!checkpoint) {
      session_.collector().start();
      return;
    }
    records_.assign(checkpoint->records.begin(), checkpoint->records.end());
    EpisodeReplayer replayer = session_.replayer();
    std::map<std::uint64_t, const EpisodeRecord*> by_number;
    for (const EpisodeRecord& record : records_) by_number[record.number] = &record;
    replay_.restore(checkpoint->replay, [&](std::uint64_t number) {
      const auto found = by_number.find(number);
      if (found == by_number.end()) throw std::invalid_argument("an episode is missing");
      Episode episode = replayer.play(number, found->second->actions);
      static_cast<void>(process_episode_end(episode, episode_end_options(options_.buffer)));
      return episode;
    });
    session_.restore_runs(*checkpoint);
    learner_.restore(checkpoint->learner);
    sampling_.restore(checkpoint->sampling);
    credit_ = checkpoint->credit;
    warm_ = session_.status().stored >= options_.optimizer.warmup;
    if (warm_) network_ = acting_network();
  }

  void write_checkpoint() {
    checkpoint_due_ = false;
    Checkpoint checkpoint;
    checkpoint.credit = credit_;
    checkpoint.learner = learner_.state();
    checkpoint.sampling = sampling_.state();
    checkpoint.replay = replay_.snapshot();
    std::set<std::uint64_t> kept;
    for (const ReplayEpisode& episode : checkpoint.replay.episodes) kept.insert(episode.tag);
    std::erase_if(records_, [&](const EpisodeRecord& r) { return !kept.contains(r.number); });
    checkpoint.records.assign(records_.begin(), records_.end());
    session_.write_checkpoint(std::move(checkpoint));
  }

  Session session_;
  const TrainingOptions& options_;
  PrioritizedReplayBuffer replay_;
  QLearner learner_;
  RandomStream sampling_;
  std::unique_ptr<const Network> network_;  ///< the online network as it acts
  std::deque<EpisodeRecord> records_;
  ReplayBatch batch_;
  std::vector<float> td_errors_;
  std::int64_t credit_ = 0;  ///< decisions that no update has answered yet
  bool warm_ = false;
  bool checkpoint_due_ = false;
};

}  // namespace

TrainingResult train_dqn(const TrainingRun& run, const TrainingHooks& hooks) {
  return DqnTrainer(run, hooks).train();
}

}  // namespace linewright::learning
