#include "linewright/evaluation/trials.hpp"

#include <algorithm>
#include <atomic>
#include <exception>
#include <memory>
#include <mutex>
#include <thread>

#include "linewright/allocation/allocator.hpp"
#include "linewright/base/random.hpp"
#include "linewright/planning/episode.hpp"
#include "linewright/planning/planner.hpp"

namespace linewright {
namespace {

/// What one thread needs to make runs, made once.
class Bench {
 public:
  Bench(const Scenario& scenario, const Simulator& simulator, const Configuration& configuration,
        const TrialPlan& plan, const CancelToken* cancel)
      : simulator_(simulator),
        allocator_(make_allocator(configuration.allocator, simulator)),
        plan_(plan),
        cancel_(cancel) {
    const PlannerContext context{.allocator = configuration.allocator,
                                 .now_ns = plan.now_ns,
                                 .scenario_file = scenario.file,
                                 .scenario_hash = scenario.content_hash,
                                 .cancel = cancel};
    planner_ = configuration.make_planner
                   ? configuration.make_planner(simulator)
                   : PlannerRegistry::make(configuration.planner, simulator, context);
    if (configuration.shield) shield_ = std::make_unique<Shield>(simulator);
  }

  TrialResult run(const RunOptions& crew, std::size_t trial) {
    const RunSetup setup =
        sample_setup(simulator_.line(), crew, trial_setup_seed(plan_.seed, trial));
    const std::uint64_t seed = RandomStream::derive(plan_.seed, "run", trial).next();
    std::vector<std::int64_t> decision_ns;
    std::int64_t shield_ns = 0;
    run_episode(simulator_, state_, setup, seed, *planner_, *allocator_,
                {.cancel = cancel_,
                 .now_ns = plan_.now_ns,
                 .decision_ns = &decision_ns,
                 .shield = shield_.get(),
                 .shield_ns = &shield_ns});
    TrialResult result = measure(state_, simulator_.progress(state_));
    result.decision_ns = std::move(decision_ns);
    result.shield_ns = shield_ns;
    if (shield_) result.masked = shield_->statistics().fatal + shield_->statistics().unknown;
    return result;
  }

 private:
  const Simulator& simulator_;
  std::unique_ptr<Planner> planner_;
  std::unique_ptr<Allocator> allocator_;
  std::unique_ptr<Shield> shield_;
  const TrialPlan& plan_;
  const CancelToken* cancel_;
  SimulationState state_;
};

WorkerShares shares_of(const WorkerState& worker, Tick now) {
  // A horizon may cut off what is under way: count only up to now.
  const Tick assigned = worker.assigned_ticks + (worker.free() ? 0 : now - worker.since);
  // Going to where one stands already is no travel, and going to rest is part of being idle.
  const bool moves = worker.way_ticks > 0 && !worker.free();
  const Tick under_way = moves ? std::max(0, worker.arrive - std::max(now, worker.depart)) : 0;
  const Tick travel = std::clamp(worker.travel_ticks - worker.rest_ticks - under_way, 0, assigned);
  const Tick work = std::min(worker.work_ticks, assigned - travel);
  const double length = std::max(1, now);
  return {work / length, travel / length, (assigned - travel - work) / length,
          (length - assigned) / length};
}

struct UnwalkedRest {
  Tick ticks = 0;
  std::int64_t mm = 0;
};

/// What a worker on its way to rest has not gone of it when the run ends. (Ways of tasks count
/// whole from their beginning, as they always have.)
UnwalkedRest unwalked_rest(const WorkerState& worker, Tick now) {
  if (!worker.free() || worker.no_way || worker.arrive <= now || worker.way_ticks == 0) return {};
  const Tick left = worker.arrive - std::max(now, worker.depart);
  return {left, worker.way_mm * left / std::max(1, worker.arrive - worker.depart)};
}

double mean_of(const std::vector<TrialResult>& trials, double (*value)(const TrialResult&)) {
  double sum = 0.0;
  for (const TrialResult& trial : trials) sum += value(trial);
  return trials.empty() ? 0.0 : sum / static_cast<double>(trials.size());
}

Spread spread_over(const std::vector<TrialResult>& trials, double (*value)(const TrialResult&)) {
  std::vector<double> values;
  values.reserve(trials.size());
  for (const TrialResult& trial : trials) values.push_back(value(trial));
  return spread_of(values);
}

/// Means of the shares; workers that only some of the trials had count where they were.
void average_shares(const std::vector<TrialResult>& trials, TrialSummary& summary) {
  std::vector<double> present;
  for (const TrialResult& trial : trials) {
    summary.workers.resize(std::max(summary.workers.size(), trial.workers.size()));
    present.resize(summary.workers.size(), 0.0);
    summary.machines.resize(trial.machines.size(), 0.0);
    for (std::size_t w = 0; w < trial.workers.size(); ++w) {
      present[w] += 1.0;
      summary.workers[w].work += trial.workers[w].work;
      summary.workers[w].travel += trial.workers[w].travel;
      summary.workers[w].wait += trial.workers[w].wait;
      summary.workers[w].idle += trial.workers[w].idle;
    }
    for (std::size_t m = 0; m < trial.machines.size(); ++m)
      summary.machines[m] += trial.machines[m];
  }
  for (std::size_t w = 0; w < summary.workers.size(); ++w) {
    for (double* share : {&summary.workers[w].work, &summary.workers[w].travel,
                          &summary.workers[w].wait, &summary.workers[w].idle}) {
      *share /= present[w];
    }
  }
  for (double& busy : summary.machines) busy /= static_cast<double>(trials.size());
}

}  // namespace

std::uint64_t trial_setup_seed(std::uint64_t plan_seed, std::size_t trial) {
  return RandomStream::derive(plan_seed, "setup", trial).next();
}

TrialResult measure(const SimulationState& state, double progress) {
  TrialResult result;
  result.status = state.status;
  result.makespan = state.status == RunStatus::kFinished ? state.now : state.horizon;
  result.progress = progress;
  result.decisions = state.decisions;
  for (const WorkerState& worker : state.workers) {
    const UnwalkedRest unwalked = unwalked_rest(worker, state.now);
    result.distance_mm += worker.travel_mm - unwalked.mm;
    result.distance_ticks += worker.travel_ticks - unwalked.ticks;
    result.workers.push_back(shares_of(worker, state.now));
  }
  const double length = std::max(1, state.now);
  for (const MachineState& machine : state.machines) {
    const Tick open = machine.taken ? state.now - machine.taken_at : 0;
    result.machines.push_back((machine.busy_ticks + open) / length);
  }
  return result;
}

std::vector<std::vector<TrialResult>> run_trials(const Scenario& scenario,
                                                 const Configuration& configuration,
                                                 const TrialPlan& plan,
                                                 const TrialProgress& progress,
                                                 const CancelToken* cancel) {
  const Simulator simulator(std::make_shared<const LineModel>(scenario.line));
  // Every crew and the configuration are tried before the first run, so that errors come at once.
  for (const RunOptions& crew : plan.crews) {
    static_cast<void>(sample_setup(simulator.line(), crew, plan.seed));
  }
  static_cast<void>(Bench(scenario, simulator, configuration, plan, cancel));

  const std::size_t total = plan.crews.size() * plan.trials;
  std::vector<std::vector<TrialResult>> results(plan.crews.size(),
                                                std::vector<TrialResult>(plan.trials));
  std::vector<std::atomic<std::size_t>> finished(plan.crews.size());
  std::atomic<std::size_t> next{0};
  std::atomic<std::size_t> done{0};
  std::mutex reporting;
  std::exception_ptr failure;

  const auto work = [&] {
    try {
      Bench bench(scenario, simulator, configuration, plan, cancel);
      constexpr std::size_t kChunk = 8;  // runs per grab: enough to keep the threads apart
      for (std::size_t begin = next.fetch_add(kChunk); begin < total;
           begin = next.fetch_add(kChunk)) {
        for (std::size_t job = begin; job < std::min(begin + kChunk, total); ++job) {
          if (cancel != nullptr && cancel->requested()) return;
          const std::size_t crew = job / plan.trials;
          TrialResult result = bench.run(plan.crews[crew], job % plan.trials);
          if (result.status == RunStatus::kRunning || result.status == RunStatus::kDecision) return;
          results[crew][job % plan.trials] = std::move(result);
          ++finished[crew];
          ++done;
        }
        if (progress) {
          const std::scoped_lock lock(reporting);
          progress(done.load(), total);
        }
      }
    } catch (...) {
      const std::scoped_lock lock(reporting);
      if (!failure) failure = std::current_exception();
      next = total;
    }
  };

  const std::size_t cores = std::max(1U, std::thread::hardware_concurrency());
  const std::size_t threads = std::min(plan.threads == 0 ? cores : plan.threads, total);
  std::vector<std::jthread> pool;  // joined also when a later one cannot be started
  for (std::size_t t = 1; t < threads; ++t) pool.emplace_back(work);
  work();
  for (std::jthread& thread : pool) thread.join();
  if (failure) std::rethrow_exception(failure);

  std::size_t complete = 0;
  while (complete < results.size() && finished[complete] == plan.trials) ++complete;
  results.resize(complete);
  return results;
}

TrialSummary summarize(const std::vector<TrialResult>& trials, const RunOptions& crew) {
  TrialSummary summary;
  for (const auto& count : crew.workers) summary.crew.push_back(count.value_or(0));
  summary.makespan = spread_over(trials, [](const TrialResult& t) { return double(t.makespan); });
  summary.distance_m =
      spread_over(trials, [](const TrialResult& t) { return double(t.distance_mm) / 1000.0; });
  summary.distance_ticks =
      spread_over(trials, [](const TrialResult& t) { return double(t.distance_ticks); });
  summary.success_rate = mean_of(
      trials, [](const TrialResult& t) { return t.status == RunStatus::kFinished ? 1.0 : 0.0; });
  summary.progress = mean_of(trials, [](const TrialResult& t) { return t.progress; });
  summary.decisions = mean_of(trials, [](const TrialResult& t) { return double(t.decisions); });
  average_shares(trials, summary);
  return summary;
}

PairedComparison compare_paired(const std::vector<TrialResult>& first,
                                const std::vector<TrialResult>& second) {
  PairedComparison comparison;
  std::vector<double> differences;
  for (std::size_t i = 0; i < std::min(first.size(), second.size()); ++i) {
    const Tick difference = second[i].makespan - first[i].makespan;
    differences.push_back(difference);
    ++(difference < 0 ? comparison.faster : difference > 0 ? comparison.slower : comparison.equal);
  }
  comparison.difference = spread_of(differences);
  return comparison;
}

}  // namespace linewright
