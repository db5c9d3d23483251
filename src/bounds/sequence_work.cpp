#include "sequence_work.hpp"

#include <algorithm>

#include "requirements.hpp"

namespace linewright::bounds {
namespace {

template <class What>
void for_each_action(const Task& task, What what) {
  for (const Step& step : task.steps) {
    for (const ActorSequence& sequence : step.sequences) {
      for (const Action& action : sequence.actions) what(action);
    }
  }
}

bool operates(const Task& task, OperationId operation) {
  bool found = false;
  for_each_action(task, [&](const Action& action) {
    const auto* operate = std::get_if<OperateAction>(&action.what);
    found = found || (operate != nullptr && operate->operation == operation);
  });
  return found;
}

/// Items and operations of which every execution has a fixed number.
int certain_firings(const Task& task) {
  int firings = 0;
  for_each_action(task, [&](const Action& action) {
    const auto* transfer = std::get_if<TransferAction>(&action.what);
    if (transfer != nullptr) firings += transfer->repeat;
    if (std::holds_alternative<OperateAction>(action.what)) ++firings;
  });
  return firings;
}

}  // namespace

Work::Work(const LineNet& net, const SequenceProblem& problem, const Lags& lags)
    : net_(net), problem_(problem), lags_(lags) {
  weigh_jobs();
  weigh_tails();
  weigh_order();
}

Workload Work::all() const {
  return {.ticks = static_cast<Tick>(all_work_ + 1 - 1e-6), .rest = longest_rest_};
}

Tick Work::least_end(const std::vector<std::int16_t>& units, Tick free) const {
  struct Left {
    Tick tail;
    Tick work;
    Tick rest;
  };
  std::vector<Left> left;
  for (std::size_t j = 0; j < units.size(); ++j) {
    const int missing = lags_.end_needs(j) - units[j];
    if (missing <= 0) continue;
    left.push_back({tails_[j][static_cast<std::size_t>(units[j])],
                    least_work_[j][static_cast<std::size_t>(missing)], rests_[j]});
  }
  std::sort(left.begin(), left.end(), [](const Left& a, const Left& b) { return a.tail > b.tail; });
  Tick end = 1;
  Tick work = free;
  Tick rest = 0;
  for (const Left& one : left) {
    work += one.work;
    rest = std::max(rest, one.rest);  // the last one need not be over, only its first unit done
    end = std::max(end, work - rest + one.tail);
  }
  double more = all_work_;
  for (std::size_t j = 0; j < units.size(); ++j) more -= unit_work_[j] * units[j];
  if (more > 1e-6) end = std::max(end, free + static_cast<Tick>(more + 1 - 1e-6) - longest_rest_);
  return end;
}

void Work::weigh_tails() {
  for (std::size_t j = 0; j < problem_.jobs.size(); ++j) {
    auto& tails = tails_.emplace_back(static_cast<std::size_t>(lags_.columns()) + 1, 0);
    Tick least = kNever;
    for (int n = lags_.end_needs(j); n >= 1; --n) {
      Tick tail = 0;
      for (const auto& [entry, lag] : lags_.after(j, n)) {
        if (entry == Lags::kFinal) tail = lag;
      }
      least = std::min(least, tail);
      tails[static_cast<std::size_t>(n - 1)] = least;
    }
    Tick longest = 0;
    for (const JobType::Variant& variant : problem_.jobs[j].variants)
      longest = std::max(longest, variant.anchor_to_end - variant.units.front());
    rests_.push_back(std::max(0, longest));
    longest_rest_ = std::max(longest_rest_, rests_.back());
  }
}

void Work::weigh_jobs() {
  Tick gap = 1;  // between two jobs
  for (const JobType& job : problem_.jobs) {
    for (const JobEnd& end : job.ends) gap = std::min(gap, end.recovery);
  }
  for (const JobType& job : problem_.jobs) {
    auto& least = least_work_.emplace_back(1, 0);
    for (int units = 1; units <= lags_.columns(); ++units) {
      Tick best = kNever;
      for (int v = 1; v <= std::min(units, static_cast<int>(job.variants.size())); ++v) {
        const Tick once = job.variants[static_cast<std::size_t>(v - 1)].anchor_to_end + job.before +
                          job.least + gap;
        best = std::min(best, once + least[static_cast<std::size_t>(units - v)]);
      }
      least.push_back(best);
    }
    double per_unit = least.back();
    for (std::size_t units = 1; units < least.size(); ++units)
      per_unit = std::min(per_unit, least[units] / static_cast<double>(units));
    unit_work_.push_back(per_unit);
  }
}

void Work::weigh_order() {
  for (const auto& [store, tokens] : net_.done) {
    const double each = Requirements(net_, store).cost_of_goal([&](std::size_t f) {
      return work_of(net_.flows[f]);
    });
    all_work_ = std::max(all_work_, each * (tokens - net_.initial(store)));
  }
}

double Work::work_of(const Flow& flow) const {
  double least = -1.0;
  const auto may_be = [&](double work) { least = least < 0.0 ? work : std::min(least, work); };
  for (std::size_t t = 0; t < net_.tasks.size(); ++t) {
    const bool any =
        flow.task ? flow.task->index() == t : operates(net_.line.tasks[t], *flow.operation);
    if (!any) continue;
    double here = 0.0;
    for (std::size_t j = 0; j < problem_.jobs.size(); ++j) {
      const JobType& job = problem_.jobs[j];
      const bool own = job.anchor == net_.tasks[t].start ||
                       (job.anchor >= net_.tasks[t].first && job.anchor <= net_.tasks[t].last);
      if (own) here = unit_work_[j] * units_of(job, TaskId(t), flow);
    }
    may_be(here);
  }
  if (flow.operation) {
    for (std::size_t j = 0; j < problem_.jobs.size(); ++j) {
      if (problem_.jobs[j].unit == net_.ends[flow.operation->index()]) may_be(unit_work_[j]);
    }
  }
  return std::max(0.0, least);
}

double Work::units_of(const JobType& job, TaskId task, const Flow& flow) const {
  const Task& model = net_.line.tasks[task.index()];
  if (job.unit != job.anchor) {  // items of one of its transfers
    if (!flow.task) return 0.0;
    const int item = net_.tasks[task.index()].actions[flow.step][flow.sequence][flow.action].item;
    return item == job.unit ? 1.0 : 0.0;
  }
  // Executions, each of which fires a fixed number of flows: any one of these firings is its part.
  const int firings = certain_firings(model);
  if (flow.task) {
    const auto& transfer = std::get<TransferAction>(
        model.steps[flow.step].sequences[flow.sequence].actions[flow.action].what);
    if (transfer.repeat == TransferAction::kUntilBlocked) return 0.0;
  }
  return firings == 0 ? 0.0 : 1.0 / firings;
}

}  // namespace linewright::bounds
