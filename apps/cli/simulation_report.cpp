#include "simulation_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>

#include "linewright/evaluation/event_log_writer.hpp"
#include "linewright/evaluation/trials.hpp"

namespace linewright::cli {
namespace {

using Json = nlohmann::ordered_json;

std::optional<Tick> largest_difference(const Outcome& outcome) {
  std::optional<Tick> largest;
  for (const MilestoneComparison& milestone : outcome.milestones) {
    if (!milestone.ours) continue;
    const Tick difference = std::abs(*milestone.ours - milestone.recorded.tick);
    largest = std::max(largest.value_or(0), difference);
  }
  return largest;
}

std::size_t missing_milestones(const Outcome& outcome) {
  return static_cast<std::size_t>(std::count_if(
      outcome.milestones.begin(), outcome.milestones.end(), [](const auto& m) { return !m.ours; }));
}

Json replay_json(const Outcome& outcome, const LineModel& line) {
  Json object{{"decisions", outcome.recorded->decisions.size()}};
  std::size_t taken = 0;
  Json late = Json::array();
  for (std::size_t i = 0; i < outcome.replayed.decisions.size(); ++i) {
    const ReplayedDecision& decision = outcome.replayed.decisions[i];
    if (decision.taken) ++taken;
    if (decision.taken == decision.recorded) continue;
    late.push_back({{"n", i + 1},
                    {"task", line.tasks[outcome.recorded->decisions[i].task.index()].name},
                    {"recorded", decision.recorded},
                    {"taken", decision.taken ? Json(*decision.taken) : Json(nullptr)},
                    {"reason", decision.refusal}});
  }
  object["taken"] = taken;
  object["deviations"] = std::move(late);
  object["recorded_finished"] =
      outcome.recorded->finished ? Json(*outcome.recorded->finished) : Json();
  object["recorded_makespan"] =
      outcome.recorded->makespan ? Json(*outcome.recorded->makespan) : Json();
  const auto largest = largest_difference(outcome);
  object["milestones"] = {{"compared", outcome.milestones.size() - missing_milestones(outcome)},
                          {"missing", missing_milestones(outcome)},
                          {"largest_difference", largest ? Json(*largest) : Json()}};
  return object;
}

Json shares_json(const WorkerShares& shares) {
  return {{"work", shares.work},
          {"travel", shares.travel},
          {"wait", shares.wait},
          {"idle", shares.idle}};
}

}  // namespace

Json simulation_json(const Simulator& simulator, const SimulateArguments& arguments,
                     const Outcome& outcome) {
  const LineModel& line = simulator.line();
  const TrialResult result = measure(outcome.state, simulator.progress(outcome.state));
  const bool finished = outcome.state.status == RunStatus::kFinished;
  Json object{{"finished", finished},
              {"makespan", finished ? Json(outcome.state.now) : Json(nullptr)},
              {"progress", result.progress},
              {"status", run_status_name(outcome.state.status)},
              {"ended_at", outcome.state.now},
              {"line", line.name},
              {"order", outcome.log.setup.order},
              {"horizon", outcome.log.setup.horizon},
              {"decisions", result.decisions},
              {"distance_m", static_cast<double>(result.distance_mm) / 1000.0},
              {"distance_ticks", result.distance_ticks}};
  object["crew"] = Json::object();
  for (std::size_t k = 0; k < line.worker_kinds.size(); ++k) {
    object["crew"][line.worker_kinds[k].name] = outcome.log.setup.worker_start[k].size();
  }
  object["workers"] = Json::object();
  const auto names = worker_names(line, outcome.log.setup);
  for (std::size_t w = 0; w < names.size(); ++w)
    object["workers"][names[w]] = shares_json(result.workers[w]);
  object["machines"] = Json::object();
  for (std::size_t m = 0; m < line.machines.size(); ++m) {
    object["machines"][line.machines[m].name] = result.machines[m];
  }
  if (outcome.recorded) object["replay"] = replay_json(outcome, line);
  if (!arguments.log.empty()) object["log"] = arguments.log;
  if (!arguments.gantt.empty()) object["gantt"] = arguments.gantt;
  return object;
}

namespace {

std::string deadlock_text(const Simulator& simulator, const Outcome& outcome) {
  std::string text = "Nothing is under way and no task can start:\n";
  for (std::size_t t = 0; t < simulator.line().tasks.size(); ++t) {
    text += fmt::format("  {}: {}\n", simulator.line().tasks[t].name,
                        simulator.explain_unselectable(outcome.state, TaskId(t)));
  }
  return text;
}

std::string replay_text(const Outcome& outcome, const LineModel& line) {
  std::vector<std::vector<std::string>> rows{{"replay", "recorded", "ours", "difference"}};
  const auto row = [&](std::string what, std::optional<Tick> recorded, std::optional<Tick> ours) {
    rows.push_back({std::move(what), recorded ? std::to_string(*recorded) : "-",
                    ours ? std::to_string(*ours) : "-",
                    recorded && ours ? fmt::format("{:+}", *ours - *recorded) : "-"});
  };
  const bool finished = outcome.state.status == RunStatus::kFinished;
  row("makespan", outcome.recorded->makespan,
      finished ? std::optional(outcome.state.now) : std::nullopt);
  std::string reasons;
  for (std::size_t i = 0; i < outcome.replayed.decisions.size(); ++i) {
    const ReplayedDecision& decision = outcome.replayed.decisions[i];
    if (decision.taken == decision.recorded) continue;
    const std::string& task = line.tasks[outcome.recorded->decisions[i].task.index()].name;
    row(fmt::format("decision {} {}", i + 1, task), decision.recorded, decision.taken);
    reasons +=
        fmt::format("  decision {} at tick {}: {}\n", i + 1, decision.recorded, decision.refusal);
  }
  std::size_t exact = 0;
  for (const MilestoneComparison& milestone : outcome.milestones) {
    if (milestone.ours == milestone.recorded.tick) {
      ++exact;
      continue;
    }
    row(fmt::format("{} {}", milestone.recorded.name, milestone.recorded.label),
        milestone.recorded.tick, milestone.ours);
  }
  std::string text = text_table(rows);
  text += fmt::format(
      "{} of {} decisions taken, {} of {} milestones exact\n",
      std::count_if(outcome.replayed.decisions.begin(), outcome.replayed.decisions.end(),
                    [](const auto& d) { return d.taken.has_value(); }),
      outcome.recorded->decisions.size(), exact, outcome.milestones.size());
  if (!reasons.empty()) text += "Decisions that were not possible at their tick:\n" + reasons;
  return text;
}

}  // namespace

std::string simulation_text(const Simulator& simulator, const SimulateArguments& arguments,
                            const Outcome& outcome) {
  const LineModel& line = simulator.line();
  const TrialResult result = measure(outcome.state, simulator.progress(outcome.state));
  const bool finished = outcome.state.status == RunStatus::kFinished;
  std::string text = text_table({
      {"line", line.name},
      {"order", fmt::format("{} {}", outcome.log.setup.order, line.order.product)},
      {"status", run_status_name(outcome.state.status)},
      {finished ? "makespan" : "stopped at", fmt::format("{} ticks ({:.1f} min)", outcome.state.now,
                                                         outcome.state.now * line.tick_s / 60.0)},
      {"progress", percent(result.progress)},
      {"decisions", std::to_string(result.decisions)},
      {"distance", fmt::format("{:.0f} m", static_cast<double>(result.distance_mm) / 1000.0)},
  });
  std::vector<std::vector<std::string>> rows{{"worker", "work", "travel", "wait", "idle"}};
  const auto names = worker_names(line, outcome.log.setup);
  for (std::size_t w = 0; w < names.size(); ++w) {
    const WorkerShares& shares = result.workers[w];
    rows.push_back({names[w], percent(shares.work), percent(shares.travel), percent(shares.wait),
                    percent(shares.idle)});
  }
  text += "\n" + text_table(rows);
  rows = {{"machine", "busy"}};
  for (std::size_t m = 0; m < line.machines.size(); ++m) {
    rows.push_back({line.machines[m].name, percent(result.machines[m])});
  }
  if (rows.size() > 1) text += "\n" + text_table(rows);
  if (outcome.recorded) text += "\n" + replay_text(outcome, line);
  if (outcome.state.status == RunStatus::kDeadlock)
    text += "\n" + deadlock_text(simulator, outcome);
  if (!arguments.log.empty() || !arguments.gantt.empty()) text += "\n";
  if (!arguments.log.empty()) text += "event log    " + arguments.log + "\n";
  if (!arguments.gantt.empty()) text += "Gantt chart  " + arguments.gantt + "\n";
  return text;
}

}  // namespace linewright::cli
