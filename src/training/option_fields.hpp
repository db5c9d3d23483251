#pragma once

#include <cstdint>

#include "linewright/base/tick.hpp"
#include "linewright/training/training_options.hpp"

namespace linewright::training_files {

/// The one table of all groups and keys with their limits. What checks, reads and writes options
/// visits it, so that no key can be forgotten by one of them. `Options` is TrainingOptions, const
/// or not. Names of enumerators stand in their order.
template <class Options, class Visitor>
void visit_options(Options& o, Visitor& visitor) {
  constexpr std::int64_t kBillion = 1'000'000'000;

  visitor.group("algorithm");
  visitor.text("name", o.algorithm.name);
  visitor.choice("kind", o.algorithm.kind, {"dqn", "ppo"});

  visitor.group("network");
  visitor.whole("width", o.network.width, 8, 4096);
  visitor.whole("heads", o.network.heads, 1, 64);
  visitor.whole("encoder_layers", o.network.encoder_layers, 0, 16);
  visitor.whole("feedforward", o.network.feedforward, 8, 16384);
  visitor.whole("head_hidden", o.network.head_hidden, 8, 4096);
  visitor.choice("query", o.network.query, {"per_task", "single"});
  visitor.flag("dueling", o.network.dueling);
  visitor.flag("noisy", o.network.noisy);
  visitor.real("sigma0", o.network.sigma0, 0.0, 10.0);

  visitor.group("reward");
  visitor.real("eta1", o.reward.eta1, 0.0, 10.0);
  visitor.real("eta2", o.reward.eta2, 0.0, 1000.0);
  visitor.real("eta3", o.reward.eta3, 0.0, 1000.0);
  visitor.real("decision_bonus", o.reward.decision_bonus, 0.0, 10.0);

  visitor.group("buffer");
  visitor.flag("modify_reward", o.buffer.modify_reward);
  visitor.real("eta4", o.buffer.eta4, 0.0, 1000.0);
  visitor.real("eta5", o.buffer.eta5, 0.0, 1000.0);
  visitor.whole("copies", o.buffer.copies, 1, 1000);
  visitor.whole("capacity", o.buffer.capacity, 1, kBillion / 10);
  visitor.flag("prioritized", o.buffer.prioritized);
  visitor.real("alpha", o.buffer.alpha, 0.0, 1.0);
  visitor.real("beta_start", o.buffer.beta_start, 0.0, 1.0);
  visitor.real("beta_end", o.buffer.beta_end, 0.0, 1.0);
  visitor.flag("return_bound", o.buffer.return_bound);
  visitor.whole("n_step", o.buffer.n_step, 1, 1000);

  visitor.group("exploration");
  visitor.flag("epsilon_greedy", o.exploration.epsilon_greedy);
  visitor.real("epsilon_start", o.exploration.epsilon_start, 0.0, 1.0);
  visitor.real("epsilon_end", o.exploration.epsilon_end, 0.0, 1.0);
  visitor.choice("noise", o.exploration.noise, {"per_decision", "per_episode"});
  visitor.real("noise_factor", o.exploration.noise_factor, 0.0, 100.0);
  visitor.whole("epsilon_decisions", o.exploration.epsilon_decisions, 0, 1000 * kBillion);

  visitor.group("optimizer");
  visitor.real("learning_rate", o.optimizer.learning_rate, 1e-9, 1.0);
  visitor.real("learning_rate_end", o.optimizer.learning_rate_end, 1e-9, 1.0);
  visitor.real("adam_epsilon", o.optimizer.adam_epsilon, 1e-12, 1.0);
  visitor.real("average", o.optimizer.average, 0.0, 0.99999);
  visitor.whole("batch", o.optimizer.batch, 1, 65536);
  visitor.real("gamma", o.optimizer.gamma, 0.0, 1.0);
  visitor.real("gradient_clip", o.optimizer.gradient_clip, 1e-6, 1e6);
  visitor.flag("double_q", o.optimizer.double_q);
  visitor.whole("target_every", o.optimizer.target_every, 1, kBillion);
  visitor.whole("updates", o.optimizer.updates, 1, kBillion);
  visitor.whole("decisions_per_update", o.optimizer.decisions_per_update, 1, kBillion);
  visitor.flag("count_copies", o.optimizer.count_copies);
  visitor.whole("warmup", o.optimizer.warmup, 1, kBillion / 10);

  visitor.group("ppo");
  visitor.whole("episodes_per_update", o.ppo.episodes_per_update, 1, 10'000);
  visitor.whole("epochs", o.ppo.epochs, 1, 100);
  visitor.whole("minibatch", o.ppo.minibatch, 1, 65536);
  visitor.real("clip", o.ppo.clip, 0.001, 1.0);
  visitor.real("gae_lambda", o.ppo.gae_lambda, 0.0, 1.0);
  visitor.real("entropy", o.ppo.entropy, 0.0, 10.0);
  visitor.real("value_coefficient", o.ppo.value_coefficient, 0.0, 100.0);
  visitor.flag("normalize_advantages", o.ppo.normalize_advantages);

  visitor.group("run");
  visitor.whole("environments", o.run.environments, 1, 4096);
  visitor.whole("threads", o.run.threads, 0, 1024);
  visitor.text("allocator", o.run.allocator);
  visitor.order("order", o.run.order, 1, 1'000'000);
  visitor.horizon("horizon", o.run.horizon, kMaxTicks);
  visitor.real("horizon_factor", o.run.horizon_factor, 0.0, 100.0);
  visitor.real("pause_episodes", o.run.pauses.episodes, 0.0, 1.0);
  visitor.real("pause_decisions", o.run.pauses.decisions, 0.0, 1.0);
  visitor.whole("pause_ticks", o.run.pauses.most, 1, 1'000'000);
  visitor.choice("crews", o.run.crews, {"in_turn", "sampled"});
  visitor.whole("evaluate_every", o.run.evaluate_every, 1, kBillion);
  visitor.whole("evaluation_trials", o.run.evaluation_trials, 1, 10'000);
  visitor.whole("checkpoint_every", o.run.checkpoint_every, 1, kBillion);
}

}  // namespace linewright::training_files
