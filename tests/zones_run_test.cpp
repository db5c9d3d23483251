// Runs with zones that close and workers that rest, from the scenario to the log and its replay.
// The ways are those of a hall of cells (src/simulation/fake_ways.hpp).

#include <gtest/gtest.h>

#include <sstream>

#include "../src/simulation/fake_ways.hpp"
#include "linewright/allocation/allocator.hpp"
#include "linewright/base/diagnostic.hpp"
#include "linewright/evaluation/event_log_writer.hpp"
#include "linewright/evaluation/gantt.hpp"
#include "linewright/evaluation/log_document.hpp"
#include "linewright/evaluation/recorded_run.hpp"
#include "linewright/evaluation/trials.hpp"
#include "linewright/scenario/load.hpp"
#include "tests/log_audit.hpp"
#include "tests/support.hpp"

namespace linewright::testing {
namespace {

constexpr const char* kHall = R"(
schema: line/1
name: hall
horizon: 800
order: {product: p, quantity: 12, finished_in: done}
workers:
  human: {count: [1, 3], rest: south, rest_after: 2}
stations:
  west: {human: [0, 2, 0]}
  east: {human: [9, 2, 0]}
  south: {human: [4, 0, 0], slots: {human: 2}}
places: {stock: {of: p, initial: order}, done: {of: p}}
tasks:
  carry:
    crew: {human: 1}
    max_running: 2
    reserves: stock
    steps: [{human: [{go: west}, {go: east, before: 1}, {transfer: [stock, done], takes: 2}]}]
  sweep:
    crew: {human: 1}
    when: done < 6
    steps: [{human: {go: south}}]
)";

Line hall_line() {
  Line line;
  line.scenario = load_scenario_text(kHall, "hall.yaml");
  LineModel& model = line.scenario.line;
  model.zones = {test::rectangle_zone("middle", 4, 6, 1, 3),
                 test::rectangle_zone("wall", 7, 7, 0, 4)};
  model.zones[0].closed = {{6, 30}, {60, 64}, {90, 140}};
  test::walk_on_cells(model, 10, 5);
  line.simulator = std::make_unique<Simulator>(std::make_shared<const LineModel>(model));
  return line;
}

/// Other closures for every seed.
RunOptions closures_for(std::uint64_t seed) {
  const auto first = static_cast<Tick>(3 + seed * 5 % 40);
  return {.closures = {{1, first, first + static_cast<Tick>(seed % 13) + 1}, {0, 150, 170}}};
}

std::size_t count(const std::string& text, const std::string& words) {
  std::size_t found = 0;
  for (auto at = text.find(words); at != std::string::npos; at = text.find(words, at + 1)) ++found;
  return found;
}

TEST(ZonesRun, StandsUpToTheAudit) {
  const Line line = hall_line();
  std::size_t reroutes = 0;
  std::size_t blocked = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const LoggedRun run = run_line(line, closures_for(seed), seed, "random", "no_spatial");
    ASSERT_EQ(Audit(run.text).problem, "") << seed;
    EXPECT_EQ(run.state.status, RunStatus::kFinished) << seed;
    reroutes += count(run.text, "\"reroute\"");
    blocked += count(run.text, "\"blocked\"");
    std::istringstream in(run.text);
    EXPECT_NE(gantt_svg(make_gantt(read_event_log(in, "run"))).find(">Zones<"), std::string::npos);
  }
  EXPECT_GT(reroutes, 100U);
  EXPECT_GT(blocked, 20U);
}

/// What was walked, by the log alone.
TEST(ZonesRun, TotalsAreThoseOfTheLog) {
  const Line line = hall_line();
  for (std::uint64_t seed = 1; seed <= 30; ++seed) {
    const LoggedRun run = run_line(line, closures_for(seed), seed, "random", "no_spatial");
    std::vector<Tick> begun(run.state.workers.size(), 0);
    std::vector<Tick> until(run.state.workers.size(), 0);
    std::vector<Tick> walked(run.state.workers.size(), 0);
    const auto stop = [&](std::size_t w, Tick tick) {
      if (begun[w] < std::min(tick, until[w])) walked[w] += std::min(tick, until[w]) - begun[w];
      begun[w] = until[w] = 0;
    };
    for (const LogEvent& event : run.log.events) {
      const bool goes = event.type == LogEvent::Type::kGo || event.type == LogEvent::Type::kReroute;
      if (!goes && event.type != LogEvent::Type::kBlocked) continue;
      const auto w = static_cast<std::size_t>(event.a);
      stop(w, event.tick);
      if (!goes) continue;
      begun[w] = event.e;
      until[w] = event.until;
    }
    for (std::size_t w = 0; w < walked.size(); ++w) {
      const WorkerState& worker = run.state.workers[w];
      // The totals have the whole of a way that is not over yet.
      const Tick left = worker.no_way ? 0 : std::max(0, worker.arrive - run.state.now);
      stop(w, run.state.now);
      EXPECT_EQ(worker.travel_ticks - std::min(left, worker.way_ticks), walked[w]) << seed;
      EXPECT_EQ(worker.travel_mm - std::min(left, worker.way_ticks) * 1000, walked[w] * 1000)
          << seed;
    }
  }
}

TEST(ZonesRun, ReplaysByteForByteFromItsLog) {
  const Line line = hall_line();
  const auto fallback = make_allocator("first_idle", *line.simulator);
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    const LoggedRun run = run_line(line, closures_for(seed), seed, "random", "no_spatial");
    const RecordedRun recorded = read_recorded_run(run.text, "log", line.simulator->line());
    EXPECT_EQ(recorded.setup.closures, run.log.setup.closures);
    LoggedRun again;
    replay(*line.simulator, again.state, recorded.setup, recorded.decisions, *fallback, &again.log);
    EXPECT_EQ(event_log_text(line.scenario, again.log, line.simulator->progress(again.state)),
              run.text)
        << seed;
  }
}

TEST(ZonesRun, GivesTheSameLogWhateverWasAskedOfTheWaysBefore) {
  const Line used = hall_line();
  for (std::uint64_t seed = 20; seed >= 1; --seed) {
    static_cast<void>(run_line(used, closures_for(seed), seed, "random", "sap"));
  }
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    EXPECT_EQ(run_line(used, closures_for(seed), seed, "random", "sap").text,
              run_line(hall_line(), closures_for(seed), seed, "random", "sap").text)
        << seed;
  }
}

TEST(ZonesRun, ResultsDoNotDependOnTheNumberOfThreads) {
  const auto makespans = [](std::size_t threads) {
    const Line line = hall_line();
    TrialPlan plan{.crews = {closures_for(1), closures_for(7)}, .trials = 40, .threads = threads};
    std::vector<std::pair<Tick, std::int64_t>> all;
    for (const auto& row : run_trials(line.scenario, {"random", "no_spatial"}, plan)) {
      for (const TrialResult& trial : row) all.emplace_back(trial.makespan, trial.distance_mm);
    }
    return all;
  };
  EXPECT_EQ(makespans(1), makespans(2));
}

TEST(ZonesRun, AZoneInAScenarioNeedsWaysOnAMap) {
  try {
    static_cast<void>(load_scenario_text(
        std::string(kHall) + "zones: {gate: {rectangle: [0, 1, 0, 1]}}\n", "hall.yaml"));
    FAIL();
  } catch (const ScenarioError& error) {
    EXPECT_NE(std::string(error.what()).find("hybrid_a_star"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace linewright::testing
