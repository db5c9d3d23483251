#include "linewright/evaluation/gantt.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <vector>

#include "linewright/allocation/allocator.hpp"
#include "linewright/base/diagnostic.hpp"
#include "linewright/evaluation/event_log_writer.hpp"
#include "linewright/planning/episode.hpp"
#include "linewright/planning/planner.hpp"
#include "linewright/scenario/load.hpp"
#include "linewright/simulation/simulator.hpp"
#include "small_log.hpp"

namespace linewright {
namespace {

using test::read_text;
using test::small_log;
using test::small_log_with;

GanttChart small_chart() { return make_gantt(read_text(small_log())); }

std::vector<std::string> texts(const GanttRow& row) {
  std::vector<std::string> result;
  for (const GanttInterval& interval : row.intervals) result.push_back(interval.text);
  return result;
}

Tick total(const GanttRow& row, GanttKind kind) {
  Tick sum = 0;
  for (const GanttInterval& interval : row.intervals) {
    if (interval.kind == kind) sum += interval.end - interval.begin;
  }
  return sum;
}

/// Every interval lies within the run, after the one before it, and says something.
void expect_sound(const GanttChart& chart) {
  for (const GanttSection& section : chart.sections) {
    for (const GanttRow& row : section.rows) {
      Tick free_from = 0;
      for (const GanttInterval& interval : row.intervals) {
        EXPECT_LE(free_from, interval.begin) << interval.text;
        EXPECT_LT(interval.begin, interval.end) << interval.text;
        EXPECT_LE(interval.end, chart.last) << interval.text;
        EXPECT_FALSE(interval.text.empty());
        EXPECT_LT(interval.task.value_or(0), chart.tasks.size());
        free_from = interval.end;
      }
    }
  }
}

/// A run of one of the scenarios that come with Linewright.
struct Playthrough {
  SimulationState state;
  GanttChart chart;
};

Playthrough simulate(const std::string& scenario_file, const RunOptions& options,
                     std::uint64_t seed) {
  const Scenario scenario = load_scenario(LINEWRIGHT_SOURCE_DIR "/scenarios/" + scenario_file);
  const Simulator simulator(std::make_shared<const LineModel>(scenario.line));
  const auto planner = PlannerRegistry::make("random", simulator);
  const auto allocator = make_allocator("no_spatial", simulator);
  Playthrough run;
  EventLog log;
  const RunSetup setup = sample_setup(scenario.line, options, seed);
  run_episode(simulator, run.state, setup, seed, *planner, *allocator, {.log = &log});
  run.chart = make_gantt(read_text(event_log_text(scenario, log, simulator.progress(run.state))));
  return run;
}

TEST(Gantt, ShowsPeopleThenRobotsThenMachines) {
  const GanttChart chart = small_chart();
  ASSERT_EQ(chart.sections.size(), 3U);
  EXPECT_EQ(chart.sections[0].heading, "People");
  EXPECT_EQ(chart.sections[1].heading, "Robots");
  EXPECT_EQ(chart.sections[2].heading, "Machines");
  EXPECT_EQ(chart.sections[2].rows[1].name, "clamp");
}

TEST(Gantt, ShowsOtherKindsOfWorkersUnderTheirNames) {
  const GanttChart chart = make_gantt(
      read_text(small_log_with(R"("kind":"human","start")", R"("kind":"drone","start")")));
  EXPECT_EQ(chart.sections[0].heading, "Robots");
  EXPECT_EQ(chart.sections[1].heading, "drone");
}

TEST(Gantt, TellsWhatEveryWorkerDid) {
  const GanttChart chart = small_chart();
  EXPECT_EQ(texts(chart.sections[0].rows[0]),
            (std::vector<std::string>{
                "human.0 · bring (decision 1) · wait at desk · ticks 1–2",
                "human.0 · bring (decision 1) · walk desk → rack · ticks 2–6 · 4.6 m",
                "human.0 · bring (decision 1) · wait at rack · ticks 6–10",
                "human.0 · bring (decision 1) · move box stock → cage.0 · ticks 10–13",
                "human.0 · bring (decision 1) · move box cage.0 → table · ticks 13–16",
                "human.0 · bring (decision 1) · wait at rack · ticks 16–18",
                "human.0 · operate (decision 2) · wait at rack · ticks 21–22",
                "human.0 · operate (decision 2) · operate punch · ticks 22–28",
            }));
}

TEST(Gantt, ShowsAWayToWhereOneStandsAsWaiting) {
  const GanttChart chart = make_gantt(
      read_text(small_log_with(R"("from":"desk","to":"rack")", R"("from":"desk","to":"desk")")));
  EXPECT_EQ(chart.sections[0].rows[0].intervals[0].text,
            "human.0 · bring (decision 1) · wait at desk · ticks 1–10");
}

TEST(Gantt, ShowsALateJoinerFromItsJoinToItsRelease) {
  const GanttChart chart = small_chart();
  EXPECT_EQ(texts(chart.sections[1].rows[0]),
            (std::vector<std::string>{
                "robot.0 · bring (decision 1) · drive dock → rack · ticks 3–10 · 7.8 m",
                "robot.0 · bring (decision 1) · wait at rack · ticks 10–16",
            }));
}

TEST(Gantt, TellsWhatEveryMachineDid) {
  const GanttSection machines = small_chart().sections[2];
  EXPECT_EQ(texts(machines.rows[0]),
            (std::vector<std::string>{
                "press · punch by human.0 · operate (decision 2) · ticks 22–28",
                "press · recovering after punch · ticks 28–31",
            }));
  EXPECT_EQ(texts(machines.rows[1]), (std::vector<std::string>{
                                         "clamp · grip · ticks 16–20",
                                         "clamp · held between grip and let_go · ticks 20–30",
                                         "clamp · let_go · ticks 30–32",
                                     }));
}

TEST(Gantt, KnowsWhatIsCarried) {
  const std::string put_down = R"({"t":16,"event":"put_down")";
  const std::string way =
      R"({"t":14,"event":"go","n":1,"worker":"robot.0","from":"rack","to":"dock","departs":14,"arrives":15,"metres":1})";
  const GanttChart chart = make_gantt(read_text(small_log_with(put_down, way + "\n" + put_down)));
  EXPECT_EQ(texts(chart.sections[1].rows[0])[2],
            "robot.0 · bring (decision 1) · drive rack → dock with cage.0 · ticks 14–15 · 1.0 m");
}

TEST(Gantt, TellsWhoWhatAndHowItEnded) {
  GanttChart chart = small_chart();
  EXPECT_EQ(chart.title, "little_line");
  EXPECT_EQ(chart.facts,
            (std::vector<std::string>{"1 human, 1 robot, 1 cage", "order: 2 × box",
                                      "finished after 32 ticks (16 s)", "2 decisions"}));
  EXPECT_TRUE(chart.finished);
  EXPECT_EQ(chart.ending, "finished 32");
  ASSERT_EQ(chart.decisions.size(), 2U);
  EXPECT_EQ(chart.decisions[0].text, "decision 1 · tick 1 · bring · cage.0 · human.0");
  ASSERT_EQ(chart.milestones.size(), 1U);
  EXPECT_EQ(chart.milestones[0].tick, 28);
  const std::string end = R"("status":"finished","makespan":32,"progress":1.0)";
  chart = make_gantt(
      read_text(small_log_with(end, R"("status":"horizon","makespan":null,"progress":0.5)")));
  EXPECT_EQ(chart.facts[2], "not finished within 32 ticks, 50 % of the order done");
  EXPECT_FALSE(chart.finished);
  EXPECT_EQ(chart.ending, "horizon 32");
  chart = make_gantt(
      read_text(small_log_with(end, R"("status":"deadlock","makespan":null,"progress":0.5)")));
  EXPECT_EQ(chart.facts[2], "deadlock at tick 32, 50 % of the order done");
}

TEST(Gantt, CutsWhatLastsLongerThanTheRun) {
  const GanttChart chart =
      make_gantt(read_text(small_log_with(R"("until":32})", R"("until":320})")));
  expect_sound(chart);
  EXPECT_EQ(chart.sections[2].rows[1].intervals.back().end, 32);
}

TEST(Gantt, StaysSoundWhenTheLogContradictsItself) {
  // The worker is bound twice, its ways overlap, and a machine is taken while it works.
  const std::string odd =
      R"({"t":17,"event":"join","n":1,"worker":"human.0","role":"human"})"
      "\n"
      R"({"t":17,"event":"go","n":1,"worker":"human.0","from":"rack","to":"rack","departs":20,"arrives":90,"metres":1})"
      "\n"
      R"({"t":17,"event":"go","n":1,"worker":"human.0","from":"rack","to":"desk","departs":17,"arrives":18,"metres":1})"
      "\n"
      R"({"t":17,"event":"operation_start","operation":"grip","until":90})"
      "\n";
  const std::string task_end = R"({"t":18,"event":"task_end")";
  expect_sound(make_gantt(read_text(small_log_with(task_end, odd + task_end))));
}

TEST(Gantt, RefusesMoreThanCanBeDrawn) {
  std::string text = test::small_log_lines().front() + "\n";
  for (std::size_t i = 0; i <= kMostGanttIntervals; ++i) {
    const std::string begin = std::to_string(2 * i);
    text += R"({"t":)" + begin + R"(,"event":"operation_start","operation":"let_go","until":)" +
            std::to_string(2 * i + 1) + "}\n";
  }
  text += R"({"t":1000000,"event":"end","status":"horizon","makespan":null,"progress":0})";
  EXPECT_THROW(static_cast<void>(make_gantt(read_text(text))), ScenarioError);
}

TEST(Gantt, LeavesIdleMachinesOutOfAHorde) {
  std::string names = R"("machines":["press","clamp")";
  for (int i = 0; i < 40; ++i) names += ",\"idle." + std::to_string(i) + "\"";
  const GanttChart chart =
      make_gantt(read_text(small_log_with(R"("machines":["press","clamp")", names)));
  EXPECT_EQ(chart.sections[2].rows.size(), 2U);
}

TEST(Gantt, AgreesWithTheSimulator) {
  RunOptions crew;
  crew.workers = {2, 2};
  for (std::uint64_t seed = 0; seed < 6; ++seed) {
    const Playthrough run = simulate("duct_line.yaml", crew, seed);
    expect_sound(run.chart);
    std::size_t number = 0;
    for (std::size_t section = 0; section < 2; ++section) {
      for (const GanttRow& row : run.chart.sections[section].rows) {
        const WorkerState& worker = run.state.workers.at(number++);
        if (!worker.free()) continue;  // its totals are not up to date yet
        EXPECT_EQ(row.busy_ticks(), worker.assigned_ticks) << row.name;
        EXPECT_EQ(total(row, GanttKind::kTravel), worker.travel_ticks) << row.name;
        EXPECT_EQ(total(row, GanttKind::kWork), worker.work_ticks) << row.name;
      }
    }
    ASSERT_EQ(number, run.state.workers.size());
  }
}

/// What the row of that name shows: "kind begin-end text".
std::vector<std::string> shown(const GanttChart& chart, const std::string& name) {
  std::vector<std::string> all;
  for (const GanttSection& section : chart.sections) {
    for (const GanttRow& row : section.rows) {
      if (row.name != name) continue;
      for (const GanttInterval& i : row.intervals) all.push_back(i.text);
    }
  }
  return all;
}

TEST(Gantt, ShowsZonesAndWhyAWayWasLeft) {
  const GanttChart chart = make_gantt(read_text(test::zones_log()));
  ASSERT_EQ(chart.sections.back().heading, "Zones");
  EXPECT_EQ(shown(chart, "gate"), std::vector<std::string>{"zone gate · closed · ticks 4–12"});
  EXPECT_EQ(
      shown(chart, "human.0"),
      (std::vector<std::string>{
          "human.0 · bring (decision 1) · wait at desk · ticks 3–5",
          "human.0 · bring (decision 1) · walk desk → rack · ticks 5–7",
          "human.0 · bring (decision 1) · wait for a way to rack: zone gate closed · ticks 7–12",
          "human.0 · bring (decision 1) · walk → rack · re-routed: zone gate opened · ticks "
          "12–15 · 2.8 m",
          "human.0 · bring (decision 1) · wait at rack · ticks 15–18"}));
  // On its way to rest, called on the way: from then on it is in the task.
  EXPECT_EQ(shown(chart, "robot.0"),
            (std::vector<std::string>{
                "robot.0 · to rest · drive dock → rack · ticks 2–4",
                "robot.0 · to rest · drive → rack · re-routed: zone gate closed · ticks 4–11",
                "robot.0 · bring (decision 1) · drive → rack · re-routed: zone gate closed · ticks "
                "11–18"}));
}

}  // namespace
}  // namespace linewright
