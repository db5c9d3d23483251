#include "collector.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace linewright::learning {
namespace {

std::size_t random_action(const std::uint8_t* selectable, std::size_t actions,
                          RandomStream& random) {
  std::size_t count = 0;
  for (std::size_t a = 0; a < actions; ++a) count += selectable[a];
  std::size_t skip = random.below(count);
  std::size_t action = 0;
  while (selectable[action] == 0 || skip-- > 0) ++action;
  return action;
}

/// Multiplies the deviations of all weights and biases.
void multiply(Noise& noise, float factor) {
  for (LayerNoise* layer :
       {&noise.advantage_hidden, &noise.advantage_out, &noise.value_hidden, &noise.value_out}) {
    for (float& number : layer->out) number *= factor;
  }
}

}  // namespace

ObservationSize size_of(const ObservationSpec& spec) {
  return {.features = spec.feature_count(),
          .tokens = spec.token_count(),
          .actions = spec.actions.size()};
}

std::size_t best_action(const std::vector<float>& values, const std::uint8_t* selectable) {
  std::size_t best = 0;
  while (selectable[best] == 0) ++best;
  for (std::size_t a = best + 1; a < values.size(); ++a) {
    if (selectable[a] != 0 && values[a] > values[best]) best = a;
  }
  return best;
}

Collector::Collector(VectorEnvironment& environments, WorkerPool& pool, std::uint64_t seed)
    : environments_(environments),
      seed_(seed),
      size_(size_of(environments.spec())),
      threads_(pool.size()) {
  const std::size_t runs = environments.size();
  for (std::size_t i = 0; i < runs; ++i) runs_.emplace_back(seed, i);
  features_.resize(runs * size_.features);
  present_.resize(runs * size_.tokens);
  selectable_.resize(runs * size_.actions);
}

ObservationRows Collector::rows() {
  return {features_.data(), present_.data(), selectable_.data()};
}

void Collector::start() {
  environments_.reset(rows());
  for (std::size_t i = 0; i < runs_.size(); ++i) {
    runs_[i].current.number = environments_.episode(i);
    begin(runs_[i]);
  }
}

void Collector::begin(Run& run) {
  run.current.episode.clear();
  run.current.episode.observation = size_;
  run.current.actions.clear();
  run.current.total_reward = run.current.progress = 0.0;
  run.current.log_probability.clear();
  run.current.value.clear();
}

void Collector::collect(const Behaviour& behaviour, std::vector<FinishedEpisode>& finished) {
  if (behaviour.noisy) {
    for (Run& run : runs_) {
      if (run.noise.advantage_hidden.in.empty()) run.noise = behaviour.network->make_noise();
    }
  }
  environments_.step(
      [&](std::size_t i, std::size_t thread, ObservationView view) {
        const std::size_t action = choose(behaviour, runs_[i], threads_[thread], view);
        runs_[i].current.episode.add({view.features, size_.features}, {view.present, size_.tokens},
                                     {view.selectable, size_.actions}, action);
        runs_[i].current.actions.push_back(static_cast<std::uint16_t>(action));
        return action;
      },
      rows());
  for (std::size_t i = 0; i < runs_.size(); ++i) write_down(i, finished);
}

std::size_t Collector::choose(const Behaviour& behaviour, Run& run, Thread& thread,
                              ObservationView view) {
  const bool random = behaviour.network == nullptr ||
                      (behaviour.epsilon > 0.0 && run.random.uniform() < behaviour.epsilon);
  if (random) return random_action(view.selectable, size_.actions, run.random);
  if (behaviour.noisy) draw_noise(behaviour, run);
  behaviour.network->forward(view.features, view.present, thread.workspace,
                             behaviour.noisy ? &run.noise : behaviour.noise, thread.output);
  return behaviour.choice == Behaviour::Choice::kSampled
             ? sample(run, thread, view)
             : best_action(thread.output.actions, view.selectable);
}

/// The noise of an episode follows from its number, so that nobody has to remember it.
void Collector::draw_noise(const Behaviour& behaviour, Run& run) const {
  if (!behaviour.noise_per_episode) return sample_noise(run.random, run.noise);
  if (run.noise_of == run.current.number) return;
  RandomStream random = RandomStream::derive(seed_, "noise", run.current.number);
  sample_noise(random, run.noise);
  multiply(run.noise, static_cast<float>(behaviour.noise_factor * random.uniform()));
  run.noise_of = run.current.number;
}

std::size_t Collector::sample(Run& run, Thread& thread, ObservationView view) const {
  const std::vector<float>& logits = thread.output.actions;
  const std::size_t best = best_action(logits, view.selectable);
  thread.probability.assign(logits.size(), 0.0F);
  float total = 0.0F;
  for (std::size_t a = 0; a < logits.size(); ++a) {
    if (view.selectable[a] != 0) thread.probability[a] = std::exp(logits[a] - logits[best]);
    total += thread.probability[a];
  }
  auto left = static_cast<float>(run.random.uniform()) * total;
  std::size_t action = best;  // where rounding leaves something over
  for (std::size_t a = 0; a < logits.size(); ++a) {
    if (view.selectable[a] == 0) continue;
    action = a;
    left -= thread.probability[a];
    if (left < 0.0F) break;
  }
  run.current.log_probability.push_back(std::log(thread.probability[action] / total));
  run.current.value.push_back(thread.output.value);
  return action;
}

void Collector::forget_decisions(FinishedEpisode& current) {
  current.episode.clear();
  current.log_probability.clear();
  current.value.clear();
}

void Collector::write_down(std::size_t i, std::vector<FinishedEpisode>& finished) {
  Run& run = runs_[i];
  const VectorEnvironment::Step& step = environments_.steps()[i];
  run.current.episode.reward.back() = step.result.reward;
  run.current.total_reward += static_cast<double>(step.result.reward);
  if (step.result.paused) forget_decisions(run.current);
  if (!step.result.ended) return;
  run.current.episode.outcome = {step.result.success, step.makespan, step.horizon};
  run.current.progress = step.progress;
  finished.push_back(std::move(run.current));
  run.current = {};
  run.current.number = environments_.episode(i);
  begin(run);
}

std::vector<Collector::RunState> Collector::state() const {
  std::vector<RunState> states;
  for (const Run& run : runs_) {
    states.push_back({run.current.number, run.current.actions, run.random.state(),
                      run.current.total_reward, run.current.log_probability, run.current.value});
  }
  return states;
}

void Collector::restore(const std::vector<RunState>& state, std::vector<Episode> begun) {
  for (std::size_t i = 0; i < runs_.size(); ++i) {
    Run& run = runs_[i];
    environments_.restore(i, state[i].episode, state[i].actions, rows());
    run.random.restore(state[i].random);
    begin(run);
    run.current.number = state[i].episode;
    run.current.episode = std::move(begun[i]);
    run.current.actions = state[i].actions;
    run.current.log_probability = state[i].log_probability;
    run.current.value = state[i].value;
    run.current.total_reward = state[i].total_reward;
  }
}

}  // namespace linewright::learning
