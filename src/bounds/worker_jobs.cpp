#include <algorithm>
#include <map>

#include "sequence.hpp"
#include "task_net.hpp"
#include "transfers.hpp"

namespace linewright::bounds {
namespace {

struct Where {
  std::size_t step = 0;
  std::size_t sequence = 0;
  std::size_t action = 0;
};

const Action& action_at(const Task& task, const Where& where) {
  return task.steps[where.step].sequences[where.sequence].actions[where.action];
}

/// All actions of a task, or those of one member of its crew, in order.
std::vector<Where> actions_of(const Task& task, std::optional<std::size_t> slot) {
  std::vector<Where> found;
  for (std::size_t step = 0; step < task.steps.size(); ++step) {
    for (std::size_t s = 0; s < task.steps[step].sequences.size(); ++s) {
      if (slot && task.steps[step].sequences[s].slot != *slot) continue;
      for (std::size_t a = 0; a < task.steps[step].sequences[s].actions.size(); ++a)
        found.push_back({step, s, a});
    }
  }
  return found;
}

/// The transfer whose items are the units of a task, and the one that loads them first.
struct Batching {
  Where unloads;
  std::optional<Where> loads;
  int most = 1;
};

/// Makes the job of one member of the crew of one task.
class WorkerJob {
 public:
  WorkerJob(const LineNet& net, TaskId task, std::size_t slot)
      : net_(net),
        task_(net.line.tasks[task.index()]),
        events_(net.tasks[task.index()]),
        slot_(slot),
        kind_(*task_.crew[slot].worker) {}

  JobType make() {
    job_.name = task_.name;
    set_anchor();
    set_end();
    const auto batching = batching_of();
    if (!batching || !set_batches(*batching)) {
      job_.unit = job_.anchor;
      job_.variants = {{.anchor_to_end = lag(job_.anchor, job_.end).value_or(0), .units = {0}}};
    }
    return job_;
  }

 private:
  [[nodiscard]] const ActionEvents& events_at(const Where& where) const {
    return events_.actions[where.step][where.sequence][where.action];
  }
  [[nodiscard]] std::optional<Tick> lag(int from, int to,
                                        const std::map<int, Tick>& more = {}) const {
    return longest_lag(net_.net, events_, from, to, more);
  }

  [[nodiscard]] std::optional<StationId> carrier_stands(std::size_t slot) const {
    const CrewSlot& crew = task_.crew[slot];
    if (crew.wanted != CarrierWanted::kBerth) return std::nullopt;
    return station_of_berth(net_.line, crew.berth);
  }

  void set_anchor() {
    const std::vector<Where> acts = actions_of(task_, slot_);
    if (acts.empty()) {
      job_.start = job_.anchor = events_.start;
      return;
    }
    const Action& first = action_at(task_, acts[0]);
    job_.start = job_.anchor = events_at(acts[0]).begin;
    std::optional<StationId> place;
    if (const auto* go = std::get_if<GoAction>(&first.what)) {
      place = go->station;
    } else if (const auto* fetch = std::get_if<FetchAction>(&first.what)) {
      place = carrier_stands(fetch->carrier_slot);
    } else {
      return;
    }
    job_.anchor = events_at(acts[0]).end;
    job_.before = first.before + first.after;
    job_.least = net_.line.worker_kinds[kind_.index()].min_leg_ticks;
    job_.place = place ? place->value : -1;
  }

  void set_end() {
    job_.end = events_.end;
    std::int32_t stands = -1;
    for (const Where& where : actions_of(task_, slot_)) {
      const Action& action = action_at(task_, where);
      if (const auto* go = std::get_if<GoAction>(&action.what)) stands = go->station.value;
      if (const auto* fetch = std::get_if<FetchAction>(&action.what)) {
        const auto at = carrier_stands(fetch->carrier_slot);
        stands = at ? at->value : -1;
      }
      if (!std::holds_alternative<ReleaseAction>(action.what)) continue;
      job_.end = events_at(where).end;
      break;
    }
    job_.ends = {{.place = stands, .after = 0, .recovery = 1}};
  }

  /// The only items that a task moves as many of as it can: out of a carrier that stood in a berth,
  /// or that it has loaded itself, or straight from place to place.
  [[nodiscard]] std::optional<Batching> batching_of() const {
    std::vector<Where> open;
    for (const Where& where : actions_of(task_, std::nullopt)) {
      const auto* transfer = std::get_if<TransferAction>(&action_at(task_, where).what);
      if (transfer != nullptr && transfer->repeat == TransferAction::kUntilBlocked)
        open.push_back(where);
    }
    if (open.empty() || open.size() > 2) return std::nullopt;
    const auto& last = std::get<TransferAction>(action_at(task_, open.back()).what);
    Batching batching{.unloads = open.back(), .most = events_at(open.back()).most};
    if (open.size() == 2) {
      const auto& first = std::get<TransferAction>(action_at(task_, open[0]).what);
      const bool chained = !last.source.place && !first.destination.place &&
                           last.source.slot == first.destination.slot &&
                           task_.crew[last.source.slot].wanted == CarrierWanted::kEmpty;
      if (!chained) return std::nullopt;
      batching.loads = open[0];
      batching.most = std::min(batching.most, events_at(open[0]).most);
    } else if (!last.source.place && task_.crew[last.source.slot].wanted != CarrierWanted::kBerth) {
      return std::nullopt;
    }
    if (!last.destination.place) return std::nullopt;
    batching.most = std::min(batching.most, net_.columns);
    return batching;
  }

  bool set_batches(const Batching& batching) {
    const Action& unloads = action_at(task_, batching.unloads);
    const Tick each = std::get<TransferAction>(unloads.what).takes;
    for (int items = 1; items <= batching.most; ++items) {
      std::map<int, Tick> more{{events_at(batching.unloads).end, each * items}};
      if (batching.loads) {
        const auto& loads = std::get<TransferAction>(action_at(task_, *batching.loads).what);
        more[events_at(*batching.loads).end] = loads.takes * items;
      }
      const auto begins = lag(job_.anchor, events_at(batching.unloads).begin, more);
      const auto ends = lag(job_.anchor, job_.end, more);
      if (!begins || !ends) {
        job_.variants.clear();
        return false;
      }
      JobType::Variant& variant = job_.variants.emplace_back();
      variant.anchor_to_end = *ends;
      for (int item = 1; item <= items; ++item)
        variant.units.push_back(*begins + unloads.before + item * each);
    }
    job_.unit = events_at(batching.unloads).item;
    job_.supply = supply_of(batching).value_or(0);
    return true;
  }

  /// Where each execution brings as many as its carrier holds of what is left, and all of them fit:
  /// how many there are in all.
  [[nodiscard]] std::optional<int> supply_of(const Batching& batching) const {
    if (!batching.loads || task_.max_running != 1) return std::nullopt;
    const auto& loads = std::get<TransferAction>(action_at(task_, *batching.loads).what);
    const auto& unloads = std::get<TransferAction>(action_at(task_, batching.unloads).what);
    const PlaceId place = *unloads.destination.place;
    const auto capacity = net_.line.places[place.index()].capacity;
    const auto before = most_when_chosen(net_, task_, place, events_at(batching.unloads).item);
    const bool fits =
        !capacity || (before && *before + events_at(*batching.loads).most <= *capacity);
    const bool promised =  // its room, to others
        std::any_of(net_.line.tasks.begin(), net_.line.tasks.end(), [&](const Task& task) {
          return std::any_of(task.reserves.begin(), task.reserves.end(),
                             [&](const Reservation& r) { return r.room && r.place == place; });
        });
    if (!fits || promised) return std::nullopt;
    return supply_loaded(net_, task_, loads, events_at(*batching.loads).item);
  }

  const LineNet& net_;
  const Task& task_;
  const TaskEvents& events_;
  std::size_t slot_;
  WorkerKindId kind_;
  JobType job_;
};

/// What the counts of the jobs say about the tokens in places that nothing else touches.
class Counts {
 public:
  Counts(const LineNet& net, const std::vector<JobType>& jobs, const std::vector<TaskId>& tasks)
      : net_(net) {
    for (std::size_t j = 0; j < jobs.size(); ++j) {
      const TaskEvents& events = net.tasks[tasks[j].index()];
      if (jobs[j].end != events.end) continue;  // free again before all has been moved
      if (jobs[j].unit != jobs[j].anchor) moves_[jobs[j].unit] = {j, 1};
      if (jobs[j].unit != jobs[j].anchor) continue;
      for (const Where& where : actions_of(net.line.tasks[tasks[j].index()], std::nullopt)) {
        const Action& action = action_at(net.line.tasks[tasks[j].index()], where);
        const auto* transfer = std::get_if<TransferAction>(&action.what);
        if (transfer == nullptr || transfer->repeat == TransferAction::kUntilBlocked) continue;
        moves_[events.actions[where.step][where.sequence][where.action].item] = {j,
                                                                                 transfer->repeat};
      }
    }
  }

  /// The comparisons of the task's condition that the counts decide.
  [[nodiscard]] std::vector<CountCondition> conditions(const Task& task) const {
    std::vector<CountCondition> found;
    if (task.when.any_of.size() != 1) return found;
    for (const Comparison& comparison : task.when.any_of[0]) {
      CountCondition condition{.constant = comparison.constant, .relation = comparison.relation};
      bool known = true;
      const bool lower = comparison.relation == Relation::kGreater ||
                         comparison.relation == Relation::kGreaterEqual;
      for (const Term& term : comparison.terms) {
        // What others have reserved is not counted here: there may be less, never more.
        const bool least =
            term.variable.kind != VariableKind::kPlaceAvailable || (lower && term.coefficient > 0);
        known = known && least && add(term, condition);
      }
      if (known) found.push_back(std::move(condition));
    }
    return found;
  }

 private:
  bool add(const Term& term, CountCondition& condition) const {
    if (term.variable.kind == VariableKind::kOrder) {
      condition.constant += std::int64_t{term.coefficient} * net_.setup.order;
      return true;
    }
    if (term.variable.kind != VariableKind::kPlaceCount &&
        term.variable.kind != VariableKind::kPlaceAvailable) {
      return false;
    }
    const auto place = static_cast<std::size_t>(term.variable.index);
    if (net_.line.places[place].berth) return false;
    condition.constant += std::int64_t{term.coefficient} * net_.initial(term.variable.index);
    for (const auto& [events, sign] :
         {std::pair(net_.arrivals[place], 1), std::pair(net_.departures[place], -1)}) {
      for (const Source& source : net_.net[events].sources) {
        const auto moves = moves_.find(source.event);
        if (moves == moves_.end()) return false;
        condition.terms.emplace_back(moves->second.first,
                                     sign * term.coefficient * moves->second.second);
      }
    }
    return true;
  }

  const LineNet& net_;
  std::map<int, std::pair<std::size_t, int>> moves_;  ///< by event of an item: job, items per unit
};

}  // namespace

std::optional<SequenceProblem> worker_problem(const LineNet& net, WorkerKindId kind) {
  if (net.setup.worker_start[kind.index()].empty()) return std::nullopt;
  if (!net.line.worker_kinds[kind.index()].rest.empty()) return std::nullopt;
  SequenceProblem problem;
  std::vector<TaskId> tasks;
  for (std::size_t t = 0; t < net.line.tasks.size(); ++t) {
    std::optional<std::size_t> slot;
    for (std::size_t s = 0; s < net.line.tasks[t].crew.size(); ++s) {
      if (net.line.tasks[t].crew[s].worker != kind) continue;
      if (slot) return std::nullopt;
      slot = s;
    }
    if (!slot) continue;
    problem.jobs.push_back(WorkerJob(net, TaskId(t), *slot).make());
    tasks.emplace_back(t);
  }
  if (problem.jobs.empty()) return std::nullopt;
  const Counts counts(net, problem.jobs, tasks);
  for (const TaskId task : tasks)
    problem.conditions.push_back(counts.conditions(net.line.tasks[task.index()]));
  problem.starts = {net.setup.worker_start[kind.index()][0].value};
  problem.anchor = [&net, kind](int place, Tick free, Tick recovery, Tick from,
                                const JobType& job) {
    Tick way = 0;
    if (place >= 0 && job.place >= 0)
      way = net.ways.between(kind, StationId(place), StationId(job.place));
    return std::max(free + recovery, from) + job.before + std::max(way, job.least);
  };
  return problem;
}

}  // namespace linewright::bounds
