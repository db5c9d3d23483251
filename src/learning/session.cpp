#include "session.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "linewright/base/diagnostic.hpp"
#include "linewright/base/files.hpp"
#include "linewright/evaluation/crews.hpp"
#include "linewright/evaluation/trials.hpp"
#include "linewright/planning/policy_planner.hpp"

namespace linewright::learning {
namespace {

constexpr std::size_t kMeanOver = 100;  // episodes
constexpr const char* kCheckpointFile = "checkpoint.bin";
constexpr const char* kBestFile = "best.safetensors";

EpisodePlan plan_of(const TrainingRun& run) {
  return {.crews = training_crews(*run.scenario, run.options.run),
          .order = run.options.run.crews == RunSettings::Crews::kInTurn
                       ? EpisodePlan::Order::kInTurn
                       : EpisodePlan::Order::kSampled,
          .seed = RandomStream::derive(run.seed, "training").next()};
}

}  // namespace

Session::Session(const TrainingRun& run, const TrainingHooks& hooks)
    : run_(run),
      hooks_(hooks),
      simulator_(std::make_shared<const LineModel>(run.scenario->line)),
      plan_(plan_of(run)),
      pool_(static_cast<std::size_t>(run.options.run.threads)),
      environments_(simulator_, plan_, run.options.run.allocator, run.options.reward,
                    static_cast<std::size_t>(run.options.run.environments), pool_,
                    run.options.run.pauses),
      collector_(environments_, pool_, run.seed),
      interval_(4, 0.0) {
  status_.most_updates = run.options.optimizer.updates;
  run_.options.network.actor_critic = run.options.algorithm.kind == AlgorithmSettings::Kind::kPpo;
}

EpisodeReplayer Session::replayer() const {
  return {simulator_, plan_, run_.options.run.allocator, run_.options.reward,
          run_.options.run.pauses};
}

void Session::restore_runs(const Checkpoint& checkpoint) {
  EpisodeReplayer player = replayer();
  std::vector<Episode> begun;
  for (const Collector::RunState& run : checkpoint.runs) {
    begun.push_back(player.play(run.episode, run.actions));
  }
  collector_.restore(checkpoint.runs, std::move(begun));
}

/// Without the number of threads, which no result depends on.
std::string Session::options_text() const {
  TrainingOptions options = run_.options;
  options.run.threads = RunSettings{}.threads;
  return to_yaml(options);
}

std::string Session::scenario_text() const {
  return fmt::format("{} {:016x}", run_.scenario->line.name, run_.scenario->content_hash);
}

std::optional<Checkpoint> Session::resumed() {
  if (!run_.resume) return std::nullopt;
  const std::string file = path(kCheckpointFile);
  std::string reason;
  constexpr std::size_t kMost = std::size_t{4} << 30;
  const std::optional<std::string> bytes = read_file(file, kMost, reason);
  if (!bytes) {
    throw ScenarioError(file, reason, "there is nothing to resume: train without --resume first");
  }
  Checkpoint checkpoint = checkpoint_from_bytes(*bytes, file);
  const auto refuse = [&](const std::string& what) {
    throw ScenarioError(file, what,
                        "resume with what the run was started with, or name another "
                        "folder; its options.yaml says what that was");
  };
  if (checkpoint.seed != run_.seed) {
    refuse(fmt::format("is of a run with seed {}, not {}", checkpoint.seed, run_.seed));
  }
  if (checkpoint.scenario != scenario_text()) {
    refuse(fmt::format("is of a run on '{}', not '{}'", checkpoint.scenario, scenario_text()));
  }
  if (checkpoint.options != options_text()) refuse("is of a run with other options");
  if (checkpoint.runs.size() != environments_.size() || checkpoint.log_sizes.size() != 3) {
    refuse("is damaged: its parts do not fit together");
  }
  return checkpoint;
}

void Session::open_logs(const Checkpoint* checkpoint) {
  std::vector<std::string> crews;
  for (const RunOptions& crew : plan_.crews) crews.push_back(crew_name(simulator_.line(), crew));
  if (checkpoint == nullptr) write_file(path("options.yaml"), options_text());
  logs_.emplace(run_.folder, crews,
                checkpoint == nullptr ? std::vector<std::uint64_t>{} : checkpoint->log_sizes,
                hooks_.wall_time_s());
  if (checkpoint == nullptr) return;
  status_.updates = checkpoint->updates;
  status_.decisions = checkpoint->decisions;
  status_.episodes = checkpoint->episodes;
  status_.stored = checkpoint->stored;
  if (checkpoint->best.update >= 0) status_.best = checkpoint->best;
  if (checkpoint->latest.update >= 0) status_.latest = checkpoint->latest;
  recent_.assign(checkpoint->recent.begin(), checkpoint->recent.end());
  interval_ = checkpoint->interval;
  refresh_means();
}

void Session::count(const FinishedEpisode& finished) {
  const EpisodeOutcome& outcome = finished.episode.outcome;
  recent_.push_back({.reward = finished.total_reward,
                     .length = static_cast<double>(finished.actions.size()),
                     .makespan = static_cast<double>(outcome.makespan),
                     .progress = finished.progress,
                     .success = outcome.success ? 1.0 : 0.0});
  if (recent_.size() > kMeanOver) recent_.pop_front();
  ++status_.episodes;
  refresh_means();
}

void Session::refresh_means() {
  if (recent_.empty()) return;
  EpisodeFigures sum;
  for (const EpisodeFigures& figures : recent_) {
    sum.reward += figures.reward;
    sum.length += figures.length;
    sum.makespan += figures.makespan;
    sum.progress += figures.progress;
    sum.success += figures.success;
  }
  const auto episodes = static_cast<double>(recent_.size());
  status_.reward = sum.reward / episodes;
  status_.length = sum.length / episodes;
  status_.makespan = sum.makespan / episodes;
  status_.progress = sum.progress / episodes;
  status_.success = sum.success / episodes;
}

void Session::count(const UpdateReport& report) {
  ++status_.updates;
  interval_[0] += report.loss;
  interval_[1] += report.mean_q;
  interval_[2] += report.gradient_norm;
  interval_[3] += 1.0;
  status_.loss = interval_[0] / interval_[3];
  status_.mean_q = interval_[1] / interval_[3];
  status_.gradient_norm = interval_[2] / interval_[3];
}

bool Session::due(std::int64_t every) const {
  return status_.updates % every == 0 || status_.updates == status_.most_updates;
}

void Session::report() {
  logs_->progress(status_, hooks_.wall_time_s());
  interval_.assign(4, 0.0);
}

void Session::show() const {
  if (hooks_.progress) hooks_.progress(status_);
}

void Session::evaluate(const TensorMap& tensors) {
  const auto network =
      std::make_shared<const Network>(Network(spec(), run_.options.network, tensors));
  Configuration configuration{.planner = "the agent", .allocator = run_.options.run.allocator};
  configuration.make_planner = [&](const Simulator& simulator) {
    return std::make_unique<PolicyPlanner>(simulator, network);
  };
  TrialPlan plan{.trials = static_cast<std::size_t>(run_.options.run.evaluation_trials),
                 .seed = RandomStream::derive(run_.seed, "evaluation").next(),
                 .threads = pool_.size()};
  for (RunOptions crew : plan_.crews) {
    crew.horizon.reset();  // as in a test: the scenario's
    plan.crews.push_back(std::move(crew));
  }
  const auto trials = run_trials(*run_.scenario, configuration, plan);
  EvaluationReport report{.update = status_.updates, .all_succeeded = true};
  for (std::size_t c = 0; c < trials.size(); ++c) {
    const TrialSummary summary = summarize(trials[c], plan.crews[c]);
    const double share = 1.0 / static_cast<double>(trials.size());
    report.crew_makespan.push_back(summary.makespan.mean);
    report.makespan += summary.makespan.mean * share;
    report.success += summary.success_rate * share;
    report.progress += summary.progress * share;
    report.all_succeeded = report.all_succeeded && summary.success_rate == 1.0;
  }
  if (report.all_succeeded && (!status_.best || report.makespan < status_.best->makespan)) {
    status_.best = report;
    write_policy(kBestFile, tensors);
  }
  status_.latest = report;
  logs_->evaluation(report, hooks_.wall_time_s());
  logs_->flush();
}

Policy Session::policy_of(const TensorMap& tensors) const {
  Policy policy{.spec = spec(), .options = run_.options.network, .tensors = tensors};
  policy.metadata = run_.metadata;
  policy.metadata["scenario"] = run_.scenario->line.name;
  policy.metadata["scenario_hash"] = fmt::format("{:016x}", run_.scenario->content_hash);
  policy.metadata["algorithm"] = run_.options.algorithm.name;
  policy.metadata["allocator"] = run_.options.run.allocator;
  policy.metadata["seed"] = std::to_string(run_.seed);
  policy.metadata["options"] = options_text();
  policy.metadata["updates"] = std::to_string(status_.updates);
  policy.metadata["decisions"] = std::to_string(status_.decisions);
  policy.metadata["episodes"] = std::to_string(status_.episodes);
  if (status_.best) {
    policy.metadata["evaluation_makespan"] = fmt::format("{:.2f}", status_.best->makespan);
  }
  return policy;
}

void Session::write_policy(const std::string& name, const TensorMap& tensors) const {
  save_policy(path(name), policy_of(tensors));
}

void Session::write_checkpoint(Checkpoint checkpoint) {
  logs_->flush();
  checkpoint.options = options_text();
  checkpoint.scenario = scenario_text();
  checkpoint.seed = run_.seed;
  checkpoint.updates = status_.updates;
  checkpoint.decisions = status_.decisions;
  checkpoint.episodes = status_.episodes;
  checkpoint.stored = status_.stored;
  checkpoint.recent.assign(recent_.begin(), recent_.end());
  checkpoint.interval = interval_;
  checkpoint.best = status_.best.value_or(EvaluationReport{.update = -1});
  checkpoint.latest = status_.latest.value_or(EvaluationReport{.update = -1});
  checkpoint.runs = collector_.state();
  checkpoint.log_sizes = logs_->sizes();
  write_file(path(kCheckpointFile), to_bytes(checkpoint));
}

TrainingResult Session::finish(const TensorMap& tensors) {
  logs_->flush();
  TrainingResult result{.finished = !cancelled(), .status = status_};
  if (result.finished) write_policy("final.safetensors", tensors);
  if (status_.best) result.best_policy = path(kBestFile);
  return result;
}

void Session::refuse_not_finite(const UpdateReport& report) const {
  throw ScenarioError(
      path(kCheckpointFile),
      fmt::format("update {} of {} gave a loss of {} and a gradient of norm {}: training stopped",
                  status_.updates + 1, status_.most_updates, report.loss, report.gradient_norm),
      "the last checkpoint and the best policy so far are kept; lower optimizer.learning_rate or "
      "the weights of the reward");
}

EpisodeEndOptions episode_end_options(const BufferSettings& buffer) {
  return {.modify = buffer.modify_reward,
          .eta4 = buffer.eta4,
          .eta5 = buffer.eta5,
          .eta6 = buffer.copies};
}

double between(double start, double end, double share) {
  return start + (end - start) * std::clamp(share, 0.0, 1.0);
}

}  // namespace linewright::learning
