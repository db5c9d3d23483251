#include <algorithm>

#include "joint_model.hpp"
#include "sequence.hpp"

namespace linewright::bounds {
namespace {

/// Later than any recovery: what a way takes is asked from there.
constexpr Tick kLater = 1'000'000;

/// The least ticks from the end of one job until the resource is where the next one needs it.
Tick lag_between(const SequenceProblem& problem, const JobType& job, const JobType& next) {
  Tick least = kNever;
  for (const JobEnd& end : job.ends) {
    least = std::min(least, problem.anchor(end.place, kLater + end.after, end.recovery, 0, next));
  }
  return least - kLater;
}

/// The least ticks from when the resource, standing where the job left it, sets out.
Tick way_between(const SequenceProblem& problem, const JobType& job, const JobType& next) {
  Tick least = kNever;
  for (const JobEnd& end : job.ends)
    least = std::min(least, problem.anchor(end.place, 0, 0, kLater, next));
  return least - kLater;
}

Tick recovery_of(const JobType& job) {
  Tick least = kNever;
  for (const JobEnd& end : job.ends) least = std::min(least, end.after + end.recovery);
  return least;
}

/// The decision of the job's task where the worker is bound by it; else when it begins.
int taken_at(const LineNet& net, WorkerKindId kind, const JobType& job) {
  for (std::size_t t = 0; t < net.tasks.size(); ++t) {
    const TaskEvents& events = net.tasks[t];
    const bool own =
        job.anchor == events.start || (job.anchor >= events.first && job.anchor <= events.last);
    if (!own) continue;
    for (const CrewSlot& slot : net.line.tasks[t].crew) {
      if (slot.worker == kind && !slot.join_late) return events.start;
    }
  }
  return job.start >= 0 ? job.start : job.anchor;
}

/// The berth into which the task parks the carrier of the crew slot.
std::optional<PlaceId> berth_parked(const Task& task, std::size_t slot) {
  for (const Step& step : task.steps) {
    for (const ActorSequence& sequence : step.sequences) {
      for (const Action& action : sequence.actions) {
        const auto* park = std::get_if<ParkAction>(&action.what);
        if (park != nullptr && park->carrier_slot == slot && park->berth) return park->berth;
      }
    }
  }
  return std::nullopt;
}

/// What the job costs by the number of its items, from below.
JointRelaxation::Work work_of(const JointModel& model, const JobType& job) {
  const Tick one = job.variants.front().anchor_to_end;
  JointRelaxation::Work work{.base = one};
  if (job.variants.size() < 2) return work;
  const std::vector<int> items = model.nodes_of(job.unit);
  for (std::size_t b = 0; b < model.made.batches.size(); ++b) {
    if (model.made.batches[b].items != items || items.empty()) continue;
    const Tick all = job.variants.back().anchor_to_end;
    work.each = (all - one) / static_cast<Tick>(job.variants.size() - 1);
    work.base = one - work.each;
    work.batch = static_cast<int>(b);
  }
  return work;
}

/// The carriers of a kind: each is with a task, or in a berth until a task takes it from there.
class CarrierStays {
 public:
  CarrierStays(JointModel& model, CarrierKindId kind)
      : model_(model), net_(model.net()), kind_(kind) {}

  void add() {
    resource_.name = net_.line.carrier_kinds[kind_.index()].name;
    resource_.capacity = static_cast<int>(net_.setup.carrier_start[kind_.index()].size());
    resource_.recovery = {1};
    for (std::size_t t = 0; t < net_.line.tasks.size(); ++t) {
      if (net_.line.tasks[t].max_running != 1 || !add_task(t)) return;
    }
    if (!resource_.jobs.empty()) model_.made.resources.push_back(std::move(resource_));
  }

 private:
  /// False: how the task handles carriers is not understood.
  bool add_task(std::size_t t) {
    const Task& task = net_.line.tasks[t];
    std::optional<std::size_t> slot;
    for (std::size_t s = 0; s < task.crew.size(); ++s) {
      if (task.crew[s].carrier != kind_) continue;
      if (slot) return false;
      slot = s;
    }
    if (!slot) return true;
    const auto parked = berth_parked(task, *slot);
    if (task.crew[*slot].wanted == CarrierWanted::kBerth) return !parked;  // its stay goes on
    if (!parked) {
      add_stays(t, t);
      return true;
    }
    const auto tasks = tasks_of_berth(net_.line, *parked);
    if (!tasks) return false;
    add_stays(t, tasks->takes);
    return true;
  }

  void add_stays(std::size_t takes, std::size_t frees) {
    const std::vector<int> starts = model_.nodes_of(net_.tasks[takes].start);
    for (std::size_t n = 0; n < starts.size(); ++n) {
      resource_.jobs.push_back(
          {.take = starts[n],
           .begin = JointRelaxation::kAbsent,
           .anchor = JointRelaxation::kAbsent,
           .free = model_.node(net_.tasks[frees].end, static_cast<int>(n) + 1)});
    }
  }

  JointModel& model_;
  const LineNet& net_;
  CarrierKindId kind_;
  JointRelaxation::Resource resource_;
};

}  // namespace

/// One decision per tick.
void add_decisions(JointModel& model) {
  JointRelaxation::Resource decisions{.name = "decision", .recovery = {0}};
  for (const TaskEvents& task : model.net().tasks) {
    for (const int node : model.nodes_of(task.start)) {
      decisions.jobs.push_back({.take = node,
                                .begin = JointRelaxation::kAbsent,
                                .anchor = JointRelaxation::kAbsent,
                                .free = JointRelaxation::kAlways,
                                .hold = 1});
    }
  }
  model.made.resources.push_back(std::move(decisions));
}

void add_workers(JointModel& model) {
  const LineNet& net = model.net();
  for (std::size_t k = 0; k < net.line.worker_kinds.size(); ++k) {
    const WorkerKindId kind(k);
    const auto problem = worker_problem(net, kind);
    if (!problem) continue;
    JointRelaxation::Resource resource{
        .name = net.line.worker_kinds[k].name,
        .capacity = static_cast<int>(net.setup.worker_start[k].size())};
    for (std::size_t j = 0; j < problem->jobs.size(); ++j) {
      const JobType& job = problem->jobs[j];
      const std::vector<int> taken = model.nodes_of(taken_at(net, kind, job));
      for (std::size_t n = 0; n < taken.size(); ++n) {
        const int number = static_cast<int>(n) + 1;
        resource.jobs.push_back({.take = taken[n],
                                 .begin = job.start >= 0 ? model.node(job.start, number) : taken[n],
                                 .anchor = model.node(job.anchor, number),
                                 .free = model.node(job.end, number),
                                 .type = static_cast<int>(j),
                                 .number = static_cast<int>(n)});
      }
      resource.work.push_back(work_of(model, job));
      resource.recovery.push_back(recovery_of(job));
      auto& lags = resource.lag.emplace_back();
      auto& ways = resource.way.emplace_back();
      for (const JobType& next : problem->jobs) {
        lags.push_back(lag_between(*problem, job, next));
        ways.push_back(way_between(*problem, job, next));
      }
    }
    for (const StationId start : net.setup.worker_start[k]) {
      auto& ways = resource.first_way.emplace_back();
      for (const JobType& job : problem->jobs)
        ways.push_back(problem->anchor(start.value, 0, 0, kLater, job) - kLater);
    }
    // With several executions at once the n-th end need not be that of the n-th decision.
    const bool one_by_one = std::all_of(net.line.tasks.begin(), net.line.tasks.end(),
                                        [](const Task& task) { return task.max_running == 1; });
    if (!one_by_one) resource.lag.clear();  // and with it what else the order tells
    model.made.resources.push_back(std::move(resource));
  }
}

std::optional<BerthTasks> tasks_of_berth(const LineModel& line, PlaceId berth) {
  std::optional<std::size_t> parks;
  std::optional<std::size_t> takes;
  for (std::size_t t = 0; t < line.tasks.size(); ++t) {
    const Task& task = line.tasks[t];
    for (std::size_t s = 0; s < task.crew.size(); ++s) {
      if (!task.crew[s].carrier) continue;
      if (berth_parked(task, s) == berth) {
        if (parks) return std::nullopt;
        parks = t;
      }
      if (task.crew[s].wanted != CarrierWanted::kBerth || task.crew[s].berth != berth) continue;
      if (takes) return std::nullopt;
      takes = t;
    }
  }
  if (!parks || !takes || line.tasks[*parks].max_running != 1 ||
      line.tasks[*takes].max_running != 1) {
    return std::nullopt;
  }
  return BerthTasks{.parks = *parks, .takes = *takes};
}

/// Between a decision to take the carrier away and the next one's arrival nothing can start that
/// asks for one; and the next one is called only then.
void add_berths(JointModel& model) {
  const LineNet& net = model.net();
  for (std::size_t p = 0; p < net.line.places.size(); ++p) {
    if (!net.line.places[p].berth) continue;
    const auto tasks = tasks_of_berth(net.line, PlaceId(p));
    if (!tasks) continue;
    const std::vector<int> called = model.nodes_of(net.tasks[tasks->parks].start);
    JointRelaxation::Resource empty{
        .name = "no carrier in " + net.line.places[p].name, .recovery = {0}, .exclusive = false};
    for (std::size_t n = 1; n <= called.size(); ++n) {
      const auto number = static_cast<int>(n);
      const int gone = model.node(net.tasks[tasks->takes].start, number - 1);
      if (n > 1) model.made.precedences.push_back({.from = gone, .to = called[n - 1], .lag = 1});
      if (gone == JointRelaxation::kAbsent) continue;
      empty.jobs.push_back({.take = gone,
                            .begin = JointRelaxation::kAbsent,
                            .anchor = JointRelaxation::kAbsent,
                            .free = model.node(net.parked[p], number)});
    }
    for (const VariableKind kind : {VariableKind::kPlaceCount, VariableKind::kPlaceAvailable,
                                    VariableKind::kPlaceRoom, VariableKind::kPlaceOccupied}) {
      for (const auto& instant :
           instants_asking(model, {kind, static_cast<std::int32_t>(p)}, false)) {
        empty.instants.push_back(instant);
      }
    }
    if (!empty.instants.empty()) model.made.resources.push_back(std::move(empty));
  }
}

void add_carriers(JointModel& model) {
  for (std::size_t k = 0; k < model.net().line.carrier_kinds.size(); ++k)
    CarrierStays(model, CarrierKindId(k)).add();
}

}  // namespace linewright::bounds
