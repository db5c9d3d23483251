#include "ppo_trainer.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numeric>
#include <utility>

#include "linewright/learning/ppo_learner.hpp"
#include "session.hpp"

namespace linewright::learning {
namespace {

/// The decisions of one round of learning.
struct Rollout {
  std::vector<FinishedEpisode> episodes;
  PpoBatch rows;

  void clear() {
    episodes.clear();
    rows = {};
  }
};

template <class Number>
void append(std::vector<Number>& to, const std::vector<Number>& from) {
  to.insert(to.end(), from.begin(), from.end());
}

/// Row `from` of a column with `width` numbers per row becomes the next row of `to`.
template <class Number>
void append_row(std::vector<Number>& to, const std::vector<Number>& from, std::size_t row,
                std::size_t width) {
  const auto first = from.begin() + static_cast<std::ptrdiff_t>(row * width);
  to.insert(to.end(), first, first + static_cast<std::ptrdiff_t>(width));
}

class PpoTrainer {
 public:
  PpoTrainer(const TrainingRun& run, const TrainingHooks& hooks)
      : session_(run, hooks),
        options_(session_.options()),
        learner_(session_.spec(), session_.network(),
                 initial_tensors(session_.spec(), session_.network(), run.seed),
                 {.adam_epsilon = options_.optimizer.adam_epsilon,
                  .average = options_.optimizer.average,
                  .gradient_clip = options_.optimizer.gradient_clip,
                  .clip = options_.ppo.clip,
                  .entropy = options_.ppo.entropy,
                  .value_coefficient = options_.ppo.value_coefficient,
                  .threads = session_.threads()}),
        random_(RandomStream::derive(run.seed, "ppo")) {}

  TrainingResult train() {
    begin();
    while (!done() && !session_.cancelled()) {
      collect();
      if (session_.cancelled()) break;
      process();
      learn();
      if (checkpoint_due_) write_checkpoint();
    }
    return session_.finish(learner_.averaged_tensors());
  }

 private:
  [[nodiscard]] bool done() const {
    return session_.status().updates >= options_.optimizer.updates;
  }

  /// Plays with one noise for the whole round until enough episodes have ended.
  void collect() {
    network_ =
        std::make_unique<const Network>(session_.spec(), session_.network(), learner_.tensors());
    noise_ = network_->make_noise();
    if (session_.network().noisy) sample_noise(random_, noise_);
    const Behaviour behaviour{.network = network_.get(),
                              .choice = Behaviour::Choice::kSampled,
                              .noise = session_.network().noisy ? &noise_ : nullptr};
    rollout_.clear();
    const auto wanted = static_cast<std::size_t>(options_.ppo.episodes_per_update);
    while (rollout_.episodes.size() < wanted && !session_.cancelled()) {
      session_.collector().collect(behaviour, rollout_.episodes);
      session_.status().decisions += options_.run.environments;
      session_.show();
    }
  }

  /// Episode-end processing and advantages, episode by episode. A success counts as often as its
  /// decisions would be stored.
  void process() {
    PpoBatch& rows = rollout_.rows;
    for (FinishedEpisode& finished : rollout_.episodes) {
      session_.count(finished);
      Episode& episode = finished.episode;
      const int copies = process_episode_end(episode, episode_end_options(options_.buffer));
      session_.status().stored += static_cast<std::int64_t>(episode.size()) * copies;
      const std::vector<float> advantages = advantages_of(
          episode.reward, finished.value, options_.optimizer.gamma, options_.ppo.gae_lambda);
      append(rows.features, episode.features);
      append(rows.present, episode.present);
      append(rows.selectable, episode.selectable);
      rows.action.insert(rows.action.end(), episode.action.begin(), episode.action.end());
      append(rows.log_probability, finished.log_probability);
      append(rows.advantage, advantages);
      for (std::size_t t = 0; t < episode.size(); ++t) {
        rows.returns.push_back(advantages[t] + finished.value[t]);
        rows.weight.push_back(static_cast<float>(copies));
      }
    }
    rows.size = rows.action.size();
    scale(rows);
  }

  /// Weights to mean 1; advantages to weighted mean 0 and deviation 1.
  void scale(PpoBatch& rows) const {
    const double total = std::accumulate(rows.weight.begin(), rows.weight.end(), 0.0);
    double mean = 0.0;
    double square = 0.0;
    for (std::size_t i = 0; i < rows.size; ++i) {
      const double weight = static_cast<double>(rows.weight[i]) / total;
      const auto advantage = static_cast<double>(rows.advantage[i]);
      mean += weight * advantage;
      square += weight * advantage * advantage;
      rows.weight[i] = static_cast<float>(weight * static_cast<double>(rows.size));
    }
    if (!options_.ppo.normalize_advantages) return;
    const double deviation = std::sqrt(std::max(0.0, square - mean * mean)) + 1e-8;
    for (float& advantage : rows.advantage) {
      advantage = static_cast<float>((static_cast<double>(advantage) - mean) / deviation);
    }
  }

  void learn() {
    std::vector<std::size_t> order(rollout_.rows.size);
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto most = static_cast<std::size_t>(options_.ppo.minibatch);
    for (int epoch = 0; epoch < options_.ppo.epochs; ++epoch) {
      for (std::size_t i = order.size(); i > 1; --i)
        std::swap(order[i - 1], order[random_.below(i)]);
      for (std::size_t from = 0; from < order.size() && !done(); from += most) {
        update(order, from, std::min(order.size(), from + most));
      }
    }
  }

  void update(const std::vector<std::size_t>& order, std::size_t from, std::size_t to) {
    gather(order, from, to);
    const double share = static_cast<double>(session_.status().updates) /
                         static_cast<double>(options_.optimizer.updates);
    session_.status().learning_rate =
        between(options_.optimizer.learning_rate, options_.optimizer.learning_rate_end, share);
    const UpdateReport report = learner_.update(
        batch_, session_.network().noisy ? &noise_ : nullptr, session_.status().learning_rate);
    if (!report.finite()) session_.refuse_not_finite(report);
    session_.count(report);
    if (session_.due(std::max<std::int64_t>(1, options_.run.evaluate_every / 5))) {
      session_.report();
    }
    if (session_.due(options_.run.evaluate_every)) session_.evaluate(learner_.averaged_tensors());
    if (session_.due(options_.run.checkpoint_every)) checkpoint_due_ = true;
  }

  void gather(const std::vector<std::size_t>& order, std::size_t from, std::size_t to) {
    const PpoBatch& rows = rollout_.rows;
    const ObservationSize size = size_of(session_.spec());
    batch_ = {};
    batch_.size = to - from;
    for (std::size_t i = from; i < to; ++i) {
      append_row(batch_.features, rows.features, order[i], size.features);
      append_row(batch_.present, rows.present, order[i], size.tokens);
      append_row(batch_.selectable, rows.selectable, order[i], size.actions);
      batch_.action.push_back(rows.action[order[i]]);
      batch_.log_probability.push_back(rows.log_probability[order[i]]);
      batch_.advantage.push_back(rows.advantage[order[i]]);
      batch_.returns.push_back(rows.returns[order[i]]);
      batch_.weight.push_back(rows.weight[order[i]]);
    }
  }

  void begin() {
    const std::optional<Checkpoint> checkpoint = session_.resumed();
    session_.open_logs(checkpoint ? &*checkpoint : nullptr);
    if (!checkpoint) {
      session_.collector().start();
      return;
    }
    session_.restore_runs(*checkpoint);
    learner_.restore(checkpoint->learner);
    random_.restore(checkpoint->sampling);
  }

  /// Between two rounds, when nothing but the runs has begun.
  void write_checkpoint() {
    checkpoint_due_ = false;
    Checkpoint checkpoint;
    checkpoint.learner = learner_.state();
    checkpoint.sampling = random_.state();
    session_.write_checkpoint(std::move(checkpoint));
  }

  Session session_;
  const TrainingOptions& options_;
  PpoLearner learner_;
  RandomStream random_;
  std::unique_ptr<const Network> network_;
  Noise noise_;
  Rollout rollout_;
  PpoBatch batch_;
  bool checkpoint_due_ = false;
};

}  // namespace

std::vector<float> advantages_of(const std::vector<float>& rewards,
                                 const std::vector<float>& values, double gamma, double lambda) {
  std::vector<float> advantages(rewards.size());
  double next_advantage = 0.0;
  double next_value = 0.0;
  for (std::size_t t = rewards.size(); t-- > 0;) {
    const double value = static_cast<double>(values[t]);
    const double delta = static_cast<double>(rewards[t]) + gamma * next_value - value;
    next_advantage = delta + gamma * lambda * next_advantage;
    next_value = value;
    advantages[t] = static_cast<float>(next_advantage);
  }
  return advantages;
}

TrainingResult train_ppo(const TrainingRun& run, const TrainingHooks& hooks) {
  return PpoTrainer(run, hooks).train();
}

}  // namespace linewright::learning
