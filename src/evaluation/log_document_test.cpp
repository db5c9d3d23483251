#include "linewright/evaluation/log_document.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <set>
#include <string>

#include "linewright/base/diagnostic.hpp"
#include "linewright/base/random.hpp"
#include "small_log.hpp"

namespace linewright {
namespace {

using test::read_text;
using test::small_log;
using test::small_log_lines;
using test::small_log_with;

/// What the reader says about the text; empty: nothing.
std::string complaint(const std::string& text) {
  try {
    static_cast<void>(read_text(text));
  } catch (const ScenarioError& error) {
    return error.what();
  }
  return {};
}

/// The complaint names the line and contains the words.
void expect_complaint(const std::string& text, int line, const std::string& words) {
  const std::string said = complaint(text);
  const std::string where =
      line > 0 ? "run.jsonl:" + std::to_string(line) + ": error: " : "run.jsonl: error: ";
  EXPECT_EQ(said.rfind(where, 0), 0U) << said;
  EXPECT_NE(said.find(words), std::string::npos) << said;
  EXPECT_NE(said.find("hint: "), std::string::npos) << said;
}

/// The small log with its line `number` (1 is the header) replaced.
std::string with_line(std::size_t number, const std::string& line) {
  auto lines = small_log_lines();
  lines.at(number - 1) = line;
  return test::joined(lines);
}

TEST(LogDocument, HoldsTheHeader) {
  const LogHeader header = read_text(small_log()).header;
  EXPECT_EQ(header.line, "little_line");
  EXPECT_EQ(header.scenario_hash, "00112233445566ff");
  EXPECT_EQ(header.tick_s, 0.5);
  EXPECT_EQ(header.horizon, 100);
  EXPECT_EQ(header.product, "box");
  EXPECT_EQ(header.quantity, 2);
  EXPECT_EQ(header.places[header.finished_in.index()].name, "store");
  ASSERT_EQ(header.workers.size(), 2U);
  EXPECT_EQ(header.workers[1].kind, "robot");
  EXPECT_EQ(header.stations[header.workers[1].start.index()].name, "dock");
  EXPECT_EQ(header.stations[2].poses.at("robot").y_m, 6.0);
  ASSERT_EQ(header.carriers.size(), 1U);
  EXPECT_EQ(header.carriers[0].capacity, 2);
  EXPECT_EQ(header.places[1].capacity, 2);
  EXPECT_FALSE(header.places[0].capacity);
  EXPECT_EQ(header.places[3].berth, "cage");
  EXPECT_EQ(header.machines, (std::vector<std::string>{"press", "clamp"}));
  ASSERT_EQ(header.operations.size(), 3U);
  EXPECT_EQ(header.operations[0].claims, std::vector<MachineId>{MachineId(1)});
  EXPECT_EQ(header.operations[1].recovery, 3);
  ASSERT_EQ(header.operations[2].produces.size(), 1U);
  EXPECT_EQ(header.operations[2].produces[0].place, header.finished_in);
  EXPECT_EQ(header.tasks[1].number, 2);
  ASSERT_TRUE(header.hall);
  EXPECT_EQ(header.hall->bounds.x1_m, 10.0);
  EXPECT_EQ(header.hall->obstacles.at(0).polygon.at(2).y_m, 10.0);
  EXPECT_EQ(header.hall->obstacles.at(0).height_m, 2.5);
}

TEST(LogDocument, HoldsTheEvents) {
  const LogDocument log = read_text(small_log());
  ASSERT_EQ(log.events.size(), small_log_lines().size() - 2);
  EXPECT_EQ(log.decisions, (std::vector<std::size_t>{0, 12}));
  EXPECT_EQ(log.decision(2).task, TaskId(1));
  const LoggedDecision& first = log.decision(1);
  ASSERT_EQ(first.crew.size(), 3U);  // sorted by role: cage, human, robot
  EXPECT_EQ(first.crew[0].carriers, std::vector<CarrierId>{CarrierId(0)});
  EXPECT_EQ(first.crew[1].workers, std::vector<WorkerId>{WorkerId(0)});
  EXPECT_TRUE(first.crew[2].workers.empty());
  const auto& go = std::get<LoggedGo>(log.events[1].what);
  EXPECT_EQ(go.departs, 2);
  EXPECT_EQ(go.arrives, 6);
  EXPECT_EQ(go.metres, 4.61);
  EXPECT_EQ(go.path.size(), 3U);
  const auto& transfer = std::get<LoggedTransfer>(log.events[5].what);
  EXPECT_EQ(std::get<PlaceId>(transfer.from), PlaceId(0));
  EXPECT_EQ(std::get<CarrierId>(transfer.to), CarrierId(0));
  EXPECT_EQ(std::get<LoggedPutDown>(log.events[7].what).berth, PlaceId(3));
  EXPECT_EQ(std::get<LoggedBerth>(log.events[13].what).berth, PlaceId(3));
  EXPECT_EQ(std::get<LoggedOperationStart>(log.events[14].what).worker, WorkerId(0));
  EXPECT_EQ(log.end.tick, 32);
  EXPECT_EQ(log.end.makespan, 32);
  EXPECT_EQ(log.end.status, RunStatus::kFinished);
}

TEST(LogDocument, HoldsRunsThatDidNotFinish) {
  const std::string end = R"("status":"finished","makespan":32,"progress":1.0)";
  const LogDocument stuck =
      read_text(small_log_with(end, R"("status":"deadlock","makespan":null,"progress":0.5)"));
  EXPECT_EQ(stuck.end.status, RunStatus::kDeadlock);
  EXPECT_FALSE(stuck.end.makespan);
  EXPECT_EQ(stuck.end.progress, 0.5);
  const LogDocument late =
      read_text(small_log_with(end, R"("status":"horizon","makespan":null,"progress":0)"));
  EXPECT_EQ(late.end.status, RunStatus::kHorizon);
}

TEST(LogDocument, IgnoresKeysItDoesNotKnowAndBlankLines) {
  EXPECT_EQ(complaint(small_log_with(R"("event":)", R"("later":[{"x":1}],"event":)")), "");
  EXPECT_EQ(complaint(small_log_with("\n", "\r\n\n")), "");
}

TEST(LogDocument, RefusesAFileThatCannotBeRead) {
  EXPECT_THROW(static_cast<void>(load_event_log("/nowhere/run.jsonl")), ScenarioError);
  EXPECT_THROW(static_cast<void>(load_event_log("/")), ScenarioError);
}

TEST(LogDocument, ReadsAFile) {
  const std::string file = testing::TempDir() + "/linewright_log_document.jsonl";
  std::ofstream(file) << small_log();
  EXPECT_EQ(load_event_log(file).end.tick, 32);
  std::filesystem::remove(file);
}

TEST(LogDocument, RefusesAnEmptyFile) {
  expect_complaint("", 0, "the file is empty");
  expect_complaint("\n \n", 0, "the file is empty");
}

TEST(LogDocument, RefusesWhatIsNotJson) {
  expect_complaint("hello\n", 1, "is not JSON: 'hello'");
  expect_complaint(with_line(3, "{\"t\":1,"), 3, "is not JSON");
  expect_complaint(with_line(3, "{\"t\":1, \"event\":\"\xff\"}"), 3, "is not JSON");
  expect_complaint(with_line(3, "[1]"), 3, "must be a JSON object, not array");
}

TEST(LogDocument, RefusesOtherFormatsAndVersions) {
  expect_complaint("{}\n", 1, "is not an event log");
  expect_complaint("{\"format\":7}\n", 1, "is not an event log");
  expect_complaint("[]\n", 1, "must be a JSON object, not array");
  expect_complaint(small_log_with("event_log/1", "event_log/2"), 1,
                   "has the format 'linewright/event_log/2', but this version reads");
}

TEST(LogDocument, RefusesAnUnknownEvent) {
  expect_complaint(small_log_with("\"recovery_end\"", "\"recovery_ende\""), 21,
                   "did you mean 'recovery_end'?");
}

TEST(LogDocument, RefusesNamesThatTheHeaderDoesNotList) {
  expect_complaint(
      with_line(6, R"({"t":10,"event":"pick_up","n":1,"worker":"robot.9","carrier":"cage.0"})"), 6,
      "unknown worker 'robot.9'");
  expect_complaint(
      with_line(6, R"({"t":10,"event":"pick_up","n":1,"worker":"robot.0","carrier":"cage.1"})"), 6,
      "unknown carrier 'cage.1'");
  expect_complaint(small_log_with(R"("to":"rack")", R"("to":"rock")"), 3, "unknown station 'rock'");
  expect_complaint(small_log_with(R"("from":"stock")", R"("from":"stack")"), 7,
                   "unknown place 'stack'");
  expect_complaint(small_log_with(R"("operation":"grip")", R"("operation":"gripe")"), 11,
                   "unknown operation 'gripe'");
  expect_complaint(small_log_with(R"("task":"operate")", R"("task":"operated")"), 14,
                   "unknown task 'operated'");
  expect_complaint(small_log_with(R"(["human.0"])", R"(["human.1"])"), 2,
                   "unknown worker or carrier 'human.1'");
  expect_complaint(small_log_with(R"("uses":["press"])", R"("uses":["pres"])"), 1,
                   "unknown machine 'pres'");
  expect_complaint(small_log_with(R"("finished_in":"store")", R"("finished_in":"x")"), 1,
                   "unknown place 'x'");
  expect_complaint(small_log_with(R"("start":"desk")", R"("start":"disk")"), 1,
                   "unknown station 'disk'");
}

TEST(LogDocument, RefusesNamesListedTwice) {
  expect_complaint(small_log_with("\"robot.0\"", "\"human.0\""), 1,
                   "worker 'human.0' is listed twice");
  expect_complaint(small_log_with("\"clamp\"", "\"press\""), 1, "machine 'press' is listed twice");
}

TEST(LogDocument, RefusesEventsWithoutAKey) {
  const std::set<std::string> optional = {"path", "berth"};
  const auto& lines = small_log_lines();
  for (std::size_t i = 1; i < lines.size(); ++i) {
    const auto event = nlohmann::json::parse(lines[i]);
    for (const auto& [key, value] : event.items()) {
      if (optional.contains(key) || (key == "worker" && event["event"] == "operation_start"))
        continue;
      if (key == "n" && event["event"] == "go") continue;  // of a worker on its way to rest
      auto without = event;
      without.erase(key);
      expect_complaint(with_line(i + 1, without.dump()), static_cast<int>(i) + 1,
                       "lacks the key '" + key + "'");
    }
  }
}

TEST(LogDocument, RefusesAHeaderWithoutAKey) {
  for (const std::string key :
       {"line", "scenario_hash", "tick_s", "horizon", "order", "workers", "carriers", "stations",
        "places", "machines", "operations", "tasks", "finished_in", "kind", "capacity\":2,\"start",
        "bounds", "obstacles", "polygon", "height"}) {
    const std::string said = complaint(small_log_with("\"" + key + "\":", "\"x" + key + "\":"));
    EXPECT_NE(said.find("run.jsonl:1: error: "), std::string::npos) << key << said;
    EXPECT_NE(said.find("lacks the key"), std::string::npos) << key << said;
  }
}

/// The small log with what only pictures need, which logs of earlier versions lack.
std::string log_with_looks() {
  std::string text = test::small_log_with(
      R"("hall":)",
      R"("kinds":{"human":{"radius_m":0.25,"speed_mps":1.5},"robot":{"footprint_m":[1.4,0.9],"speed_mps":2}},"machine_stations":{"press":"desk"},"machine_positions":{"clamp":["open","shut"]},"machine_areas":{"press":[[2,2],[4,2],[4,3]]},"hall":)");
  const std::string table = R"({"name":"table","of":"box")";
  return text.replace(text.find(table), table.size(), table + R"(,"at":"rack")");
}

TEST(LogDocument, WhatIsThereOfALogThatIsCutOffCanBeRead) {
  const auto so_far = [](const std::string& text) {
    std::istringstream stream(text);
    return read_event_log(stream, "run.jsonl", CutOffLog::kAccept);
  };
  const std::string text = test::small_log();
  EXPECT_FALSE(so_far(text).cut_off);
  const std::size_t header = text.find('\n') + 1;
  for (std::size_t size = header; size < text.size(); ++size) {
    const LogDocument log = so_far(text.substr(0, size));
    EXPECT_EQ(log.cut_off.has_value(), size < text.size() - 1) << size;
    if (!log.cut_off) continue;
    EXPECT_EQ(log.end.status, RunStatus::kRunning);
    EXPECT_EQ(log.end.tick, log.events.empty() ? 0 : log.events.back().tick);
  }
  const std::string half = text.substr(0, text.find("\"pick_up\"") + 4);
  EXPECT_EQ(so_far(half).cut_off->line, 6);
  EXPECT_EQ(so_far(half).events.size(), 4U);
  EXPECT_NE(complaint(half).find("cut off in the middle of this line"), std::string::npos);
  EXPECT_THROW(so_far(text.substr(0, header / 2)), ScenarioError);
  EXPECT_THROW(so_far(""), ScenarioError);
}

TEST(LogDocument, HoldsHowWorkersAndMachinesAreDrawn) {
  const LogHeader header = read_text(log_with_looks()).header;
  ASSERT_EQ(header.kinds.size(), 2U);
  EXPECT_EQ(header.kinds[0].name, "human");
  EXPECT_EQ(header.kinds[0].radius_m, 0.25);
  EXPECT_EQ(header.kinds[0].speed_mps, 1.5);
  EXPECT_EQ(header.kinds[1].footprint_m, (std::vector<double>{1.4, 0.9}));
  EXPECT_EQ(header.stations[header.places[1].at->index()].name, "rack");
  EXPECT_FALSE(header.places[0].at);
  ASSERT_EQ(header.machine_sites.size(), 2U);
  EXPECT_EQ(header.stations[header.machine_sites[0].at->index()].name, "desk");
  EXPECT_EQ(header.machine_sites[0].area_m.size(), 3U);
  EXPECT_EQ(header.machine_sites[1].positions, (std::vector<std::string>{"open", "shut"}));
  EXPECT_TRUE(header.machine_sites[1].area_m.empty());
}

TEST(LogDocument, ALogWithoutTheseKeysIsWhole) {
  const LogHeader header = read_text(test::small_log()).header;
  EXPECT_TRUE(header.kinds.empty());
  ASSERT_EQ(header.machine_sites.size(), 2U);
  EXPECT_FALSE(header.machine_sites[0].at);
}

TEST(LogDocument, RefusesLooksThatAreWrong) {
  const auto said = [](const std::string& from, const std::string& to) {
    std::string text = log_with_looks();
    return complaint(text.replace(text.find(from), from.size(), to));
  };
  EXPECT_NE(said("[1.4,0.9]", "[1.4]").find("'footprint_m' of kind 'robot' must be a list of 2"),
            std::string::npos);
  EXPECT_NE(said("0.25", "-1").find("'radius_m' of kind 'human' must be a number"),
            std::string::npos);
  EXPECT_NE(said(R"({"press":"desk"})", R"({"pres":"desk"})").find("unknown machine 'pres'"),
            std::string::npos);
  EXPECT_NE(said(R"({"press":"desk"})", R"({"press":"dsk"})").find("unknown station 'dsk'"),
            std::string::npos);
  EXPECT_NE(said(",[4,3]]", "]").find("the area of 'press' has fewer than three corners"),
            std::string::npos);
  EXPECT_NE(said(R"(["open","shut"])", R"(["open",2])").find("must hold text only"),
            std::string::npos);
  EXPECT_NE(said(R"("at":"rack")", R"("at":3)").find("'at' of places[1] must be text"),
            std::string::npos);
}

TEST(LogDocument, HoldsZonesAndWaysFromBetweenStations) {
  const LogDocument log = read_text(test::zones_log());
  ASSERT_EQ(log.header.zones.size(), 1U);
  EXPECT_EQ(log.header.zones[0].name, "gate");
  EXPECT_EQ(log.header.zones[0].polygon.size(), 4U);
  EXPECT_EQ(log.header.zones[0].closed, (std::vector<std::pair<Tick, Tick>>{{4, 12}}));
  EXPECT_EQ(std::get<LoggedGo>(log.events[0].what).n, 0);
  const auto& zone = std::get<LoggedZone>(log.events[2].what);
  EXPECT_EQ(zone.zone, ZoneId(0));
  EXPECT_TRUE(zone.closed);
  const auto& reroute = std::get<LoggedReroute>(log.events[3].what);
  EXPECT_EQ(reroute.n, 0);
  EXPECT_EQ(reroute.pose.x_m, 2.0);
  EXPECT_EQ(reroute.arrives, 20);
  EXPECT_EQ(reroute.path.size(), 2U);
  const auto& blocked = std::get<LoggedBlocked>(log.events[5].what);
  EXPECT_EQ(blocked.pose.y_m, 3.0);
  EXPECT_EQ(log.header.stations[blocked.to.index()].name, "rack");
}

TEST(LogDocument, RefusesZonesAndWaysThatAreWrong) {
  const auto with = [](const std::string& from, const std::string& to) {
    std::string text = test::zones_log();
    text.replace(text.find(from), from.size(), to);
    return text;
  };
  expect_complaint(with(R"("zone":"gate")", R"("zone":"gat")"), 4, "unknown zone 'gat'");
  expect_complaint(with(R"("closed":true)", R"("closed":1)"), 4, "must be true or false");
  expect_complaint(with(R"("closed":true)", R"("closed":false)"), 4, "zone 'gate' is open already");
  expect_complaint(with(R"("closed":false)", R"("closed":true)"), 9,
                   "zone 'gate' is closed already");
  expect_complaint(with(R"("closed":[[4,8]])", R"("closed":[[4]])"), 1, "a list of [tick, ticks]");
  expect_complaint(with(R"("closed":[[4,8]])", R"("closed":[[4,-8]])"), 1,
                   "a list of [tick, ticks]");
  expect_complaint(with(R"([[1,1],)", R"([[1],)"), 1, "must be a list of 2 numbers");
  expect_complaint(with(R"("pose":[2,0,0])", R"("pose":[2,0])"), 5, "must be a list of 3 numbers");
  expect_complaint(with(R"("departs":4)", R"("departs":3)"), 5, "'departs'");
  expect_complaint(with(R"("arrives":20)", R"("arrives":2)"), 5, "'arrives'");
  expect_complaint(with(R"("metres":9.5)", R"("metres":"far")"), 5, "'metres'");
  expect_complaint(with(R"([2,0,0,0],)", R"([2,0,0],)"), 5, "must be a list of 4 numbers");
  expect_complaint(with(R"("to":"rack","departs":12)", R"("to":"rock","departs":12)"), 10,
                   "unknown station 'rock'");
  expect_complaint(with(R"("n":1,"worker":"human.0","pose")", R"("n":2,"worker":"human.0","pose")"),
                   10, "decision 2 has not been taken yet");
  std::vector<std::string> lines;
  std::istringstream stream(test::zones_log());
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  for (std::size_t i = 3; i < 10; ++i) {
    const auto event = nlohmann::json::parse(lines[i]);
    if (event["event"] == "decision") continue;
    for (const auto& [key, value] : event.items()) {
      if (key == "path" || key == "n") continue;
      auto without = event;
      without.erase(key);
      auto damaged = lines;
      damaged[i] = without.dump();
      expect_complaint(test::joined(damaged), static_cast<int>(i) + 1,
                       "lacks the key '" + key + "'");
    }
  }
}

TEST(LogDocument, RefusesValuesOfTheWrongType) {
  expect_complaint(small_log_with(R"("tick_s":0.5)", R"("tick_s":"fast")"), 1,
                   "'tick_s' of the header must be");
  expect_complaint(small_log_with(R"("tick_s":0.5)", R"("tick_s":0)"), 1,
                   "'tick_s' of the header must be");
  expect_complaint(small_log_with(R"("workers":[{)", R"("workers":[7,{)"), 1,
                   "must be a JSON object");
  expect_complaint(small_log_with(R"([1.5,2.0,0.0])", R"([1.5,2.0])"), 1,
                   "must be a list of 3 numbers");
  expect_complaint(small_log_with(R"([1.5,2.0,0.0])", R"([1.5,2.0,"0"])"), 1,
                   "must be a list of 3 numbers");
  expect_complaint(small_log_with(R"("departs":2)", R"("departs":2.5)"), 3,
                   "'departs' of event 'go' must be");
  expect_complaint(
      small_log_with(R"("worker":"human.0","from":"desk")", R"("worker":0,"from":"desk")"), 3,
      "'worker' of event 'go' must be text");
  expect_complaint(small_log_with(R"("metres":4.61)", R"("metres":-1)"), 3,
                   "'metres' of event 'go' must be");
  expect_complaint(small_log_with(R"("path":[[1.5,2,0,0],)", R"("path":[[1.5],)"), 3,
                   "must be a list of 4 numbers");
  expect_complaint(small_log_with(R"("human":["human.0"])", R"("human":"human.0")"), 2,
                   "must be a list");
  expect_complaint(small_log_with(R"("status":"finished")", R"("status":"great")"), 23, "'status'");
  expect_complaint(small_log_with(R"("makespan":32)", R"("makespan":null)"), 23, "'makespan'");
  expect_complaint(small_log_with(R"("status":"finished")", R"("status":"deadlock")"), 23,
                   "must be null");
  expect_complaint(small_log_with(R"("progress":1.0)", R"("progress":1.5)"), 23, "'progress'");
}

TEST(LogDocument, RefusesTicksThatRunBackwards) {
  expect_complaint(small_log_with(R"("t":13)", R"("t":9)"), 8,
                   "time runs backwards: tick 9 after tick 10");
  expect_complaint(small_log_with(R"({"t":32,"event":"end")", R"({"t":3,"event":"end")"), 23,
                   "backwards");
  expect_complaint(small_log_with(R"("arrives":6)", R"("arrives":1)"), 3, "'arrives'");
  expect_complaint(small_log_with(R"("departs":2)", R"("departs":0)"), 3, "'departs'");
  expect_complaint(small_log_with(R"("until":13)", R"("until":9)"), 7, "'until'");
}

TEST(LogDocument, RefusesAbsurdTicks) {
  for (const std::string tick :
       {"-1", "100000001", "1e3", "99999999999", "18446744073709551615", "1e99"}) {
    expect_complaint(small_log_with(R"({"t":13)", R"({"t":)" + tick), 8,
                     "'t' of event 'transfer' must be");
  }
  expect_complaint(small_log_with(R"("until":13)", R"("until":400000001)"), 7, "'until'");
  expect_complaint(small_log_with(R"("horizon":100)", R"("horizon":100000001)"), 1, "'horizon'");
}

TEST(LogDocument, RefusesDecisionsOutOfNumber) {
  expect_complaint(small_log_with(R"("decision","n":2)", R"("decision","n":3)"), 14,
                   "decision 3 follows decision 1");
  expect_complaint(small_log_with(R"("join","n":1)", R"("join","n":2)"), 4,
                   "decision 2 has not been taken yet");
  expect_complaint(small_log_with(R"("join","n":1)", R"("join","n":0)"), 4, "'n' of event 'join'");
}

TEST(LogDocument, RefusesLinesAfterTheEnd) {
  expect_complaint(small_log() + small_log_lines().back() + "\n", 24, "after the event 'end'");
}

TEST(LogDocument, RefusesALogThatIsCutOffAnywhere) {
  const std::string whole = small_log();
  ASSERT_EQ(complaint(whole), "");
  EXPECT_EQ(complaint(whole.substr(0, whole.size() - 1)), "");  // all but the last line break
  for (std::size_t size = 1; size + 1 < whole.size(); ++size) {
    const std::string said = complaint(whole.substr(0, size));
    ASSERT_NE(said.find("the log is cut off"), std::string::npos)
        << "at byte " << size << ": " << said;
  }
}

TEST(LogDocument, RefusesDeepNestingAndLongLines) {
  const std::string deep(100'000, '[');
  expect_complaint(deep + "\n", 1, "nested deeper than 64");
  expect_complaint(with_line(3, "{\"t\":1,\"x\":" + deep + "}"), 3, "nested deeper than 64");
  const std::string brackets_in_text =
      R"({"t":1,"event":"milestone","name":"a\"[[[[)" + std::string(100, '[') + "\"}";
  EXPECT_EQ(complaint(with_line(2, brackets_in_text + "\n" + small_log_lines()[1])), "");
  expect_complaint(std::string(kLongestLogLine + 2, ' ') + "\n", 1, "longer than 16 MB");
}

TEST(LogDocument, RefusesNamesTooLongToShow) {
  expect_complaint(small_log_with("little_line", std::string(5000, 'x')), 1, "bytes long");
  expect_complaint(small_log_with("\"rack\"", "\"" + std::string(5000, 'x') + "\""), 1,
                   "longer than");
}

TEST(LogDocument, CutsForeignTextInMessages) {
  const std::string said = complaint(std::string(100, 'x') + "\x1b[31m\n");
  EXPECT_EQ(said.find('\x1b'), std::string::npos);
  EXPECT_LT(said.size(), 300U);
}

TEST(LogDocument, SurvivesDamagedBytes) {
  RandomStream random(7);
  const std::string whole = small_log();
  for (int round = 0; round < 3000; ++round) {
    std::string text = whole;
    for (std::size_t i = 0; i <= random.below(4); ++i) {
      text[random.below(text.size())] = static_cast<char>(random.below(256));
    }
    static_cast<void>(complaint(text));  // neither crashes nor throws anything else
  }
}

}  // namespace
}  // namespace linewright
