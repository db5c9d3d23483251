#include "linewright/environment/vector_environment.hpp"

#include <fmt/format.h>

#include <utility>

#include "linewright/base/diagnostic.hpp"
#include "linewright/base/random.hpp"

namespace linewright {

PlannedEpisode episode_of(const EpisodePlan& plan, std::uint64_t number) {
  RandomStream stream = RandomStream::derive(plan.seed, "episode", number);
  PlannedEpisode episode{.seed = stream.next()};
  episode.crew = plan.order == EpisodePlan::Order::kInTurn
                     ? static_cast<std::size_t>(number % plan.crews.size())
                     : stream.below(plan.crews.size());
  return episode;
}

VectorEnvironment::VectorEnvironment(const Simulator& simulator, EpisodePlan plan,
                                     const std::string& allocator, const RewardOptions& rewards,
                                     std::size_t runs, WorkerPool& pool, const PauseOptions& pauses)
    : simulator_(simulator), encoder_(simulator), plan_(std::move(plan)), pool_(pool) {
  if (plan_.crews.empty()) throw ScenarioError({}, "the plan of episodes has no crew", "");
  for (const RunOptions& crew : plan_.crews) {
    static_cast<void>(sample_setup(simulator_.line(), crew, plan_.seed));
  }
  for (std::size_t i = 0; i < runs; ++i) {
    runs_.push_back({std::make_unique<Environment>(simulator_, allocator, rewards, pauses), 0});
  }
  steps_.resize(runs);
}

ObservationView VectorEnvironment::row(ObservationRows rows, std::size_t run) const {
  const ObservationSpec& spec = encoder_.spec();
  return {.features = rows.features + run * encoder_.feature_count(),
          .present = rows.present + run * encoder_.token_count(),
          .selectable = rows.selectable + run * spec.actions.size()};
}

void VectorEnvironment::start(std::size_t run, std::uint64_t episode) {
  const PlannedEpisode planned = episode_of(plan_, episode);
  const RunSetup setup = sample_setup(simulator_.line(), plan_.crews[planned.crew], planned.seed);
  runs_[run].episode = episode;
  if (runs_[run].environment->reset(setup, planned.seed)) return;
  throw ScenarioError(
      {}, fmt::format("a run of line '{}' ends before its first decision", simulator_.line().name),
      "there is nothing to learn: look at the scenario with `linewright check`");
}

void VectorEnvironment::reset(ObservationRows out) {
  pool_.run(size(), [&](std::size_t begin, std::size_t end, std::size_t /*thread*/) {
    for (std::size_t run = begin; run < end; ++run) {
      start(run, run);
      encoder_.encode(runs_[run].environment->state(), row(out, run));
    }
  });
}

void VectorEnvironment::restore(std::size_t run, std::uint64_t episode,
                                const std::vector<std::uint16_t>& actions, ObservationRows out) {
  start(run, episode);
  for (const std::uint16_t action : actions) runs_[run].environment->step(action);
  encoder_.encode(runs_[run].environment->state(), row(out, run));
}

void VectorEnvironment::step_one(std::size_t run, std::size_t action, ObservationRows rows) {
  Environment& environment = *runs_[run].environment;
  Step& step = steps_[run];
  step.episode = runs_[run].episode;
  step.result = environment.step(action);
  if (step.result.ended) {
    step.makespan = environment.makespan();
    step.horizon = environment.horizon();
    step.progress = simulator_.progress(environment.state());
    step.decisions = environment.state().decisions;
    start(run, step.episode + size());
  }
  encoder_.encode(environment.state(), row(rows, run));
}

void VectorEnvironment::step(const std::vector<std::uint16_t>& actions, ObservationRows in_out) {
  step([&](std::size_t run, std::size_t, ObservationView) -> std::size_t { return actions[run]; },
       in_out);
}

void VectorEnvironment::step(const Choose& choose, ObservationRows in_out) {
  pool_.run(size(), [&](std::size_t begin, std::size_t end, std::size_t thread) {
    for (std::size_t run = begin; run < end; ++run) {
      step_one(run, choose(run, thread, row(in_out, run)), in_out);
    }
  });
}

}  // namespace linewright
