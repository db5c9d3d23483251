// The command line tool as a user meets it: what it prints, where, and its exit codes.

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "tests/support.hpp"

#ifdef LINEWRIGHT_CLI

namespace linewright::testing {
namespace {

using Json = nlohmann::json;

struct Output {
  int code = -1;
  std::string out;
  std::string err;
};

std::string read_file(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

/// A path of this process alone: tests run side by side.
std::string temporary(const std::string& name) {
  return fmt::format("{}/linewright_cli_{}_{}", ::testing::TempDir(), getpid(), name);
}

Output linewright(const std::string& arguments) {
  const std::string errors = temporary("errors.txt");
  const std::string command = std::string(LINEWRIGHT_CLI) + " " + arguments + " 2>" + errors;
  Output output;
  FILE* pipe = popen(command.c_str(), "r");
  if (pipe == nullptr) return output;
  std::array<char, 4096> buffer{};
  while (const std::size_t n = fread(buffer.data(), 1, buffer.size(), pipe))
    output.out.append(buffer.data(), n);
  const int status = pclose(pipe);
  output.code = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  output.err = read_file(errors);
  std::filesystem::remove(errors);
  return output;
}

TEST(Cli, SimulatePrintsOneJsonObject) {
  const Output output =
      linewright("simulate scenarios/duct_line.yaml --humans 2 --robots 2 --json");
  ASSERT_EQ(output.code, 0) << output.err;
  const Json json = Json::parse(output.out);
  EXPECT_TRUE(json["finished"].get<bool>());
  EXPECT_GT(json["makespan"].get<int>(), 600);
  EXPECT_EQ(json["progress"], 1.0);
  EXPECT_EQ(json["crew"], (Json{{"human", 2}, {"robot", 2}}));
  EXPECT_EQ(output.err, "");
}

TEST(Cli, ReplaysARecordedRun) {
  const Output output = linewright(
      "simulate scenarios/duct_line_published.yaml --planner replay "
      "--decisions tests/data/recorded/rule_H3R3_n6_s2.json --json");
  ASSERT_EQ(output.code, 0) << output.err;
  const Json json = Json::parse(output.out);
  EXPECT_EQ(json["makespan"], 795);
  EXPECT_EQ(json["replay"]["milestones"]["largest_difference"], 0);
}

TEST(Cli, MapTellsTheFactsAndWritesWhatItTells) {
  const std::string file = ::testing::TempDir() + "/cli_map/hall.yaml";
  const Output output = linewright("map scenarios/duct_line.yaml --json --out " + file);
  ASSERT_EQ(output.code, 0) << output.err;
  const Json json = Json::parse(output.out);
  EXPECT_EQ(json["columns"], 240);
  EXPECT_EQ(json["rows"], 140);
  EXPECT_EQ(json["origin"], (Json{-50.0, -10.0, 0.0}));
  EXPECT_EQ(json["cells"]["free"].get<int>() + json["cells"]["occupied"].get<int>(), 240 * 140);
  EXPECT_EQ(json["obstacles"].size(), 12U);
  EXPECT_EQ(json["stations"].size(), 20U);
  EXPECT_FALSE(json["stations"][0]["blocked"].get<bool>());
  // The shipped map is that of the shipped line.
  EXPECT_EQ(read_file(::testing::TempDir() + "/cli_map/hall.pgm"),
            read_file("scenarios/maps/duct_hall.pgm"));
  const std::string text = linewright("map scenarios/duct_line.yaml").out;
  EXPECT_NE(text.find("240 x 140 cells of 0.25 m"), std::string::npos) << text;
  std::filesystem::remove_all(::testing::TempDir() + "/cli_map");
}

TEST(Cli, RoutesTellsEveryPairAndDrawsThem) {
  const std::string svg = temporary("routes.svg");
  const Output output =
      linewright("routes scenarios/duct_line_routed.yaml --no-cache --json --svg " + svg);
  ASSERT_EQ(output.code, 0) << output.err;
  const Json json = Json::parse(output.out);
  EXPECT_EQ(json["pairs"], 180);
  EXPECT_EQ(json["failed"], 0);
  EXPECT_TRUE(json["cold_ms"].is_number());
  EXPECT_TRUE(json["cached_ms"].is_number());
  ASSERT_EQ(json["kinds"].size(), 2U);
  EXPECT_EQ(json["kinds"][1]["kind"], "robot");
  EXPECT_EQ(json["kinds"][1]["planner"], "hybrid_a_star");
  EXPECT_GT(json["kinds"][1]["longest_m"].get<double>(), json["kinds"][1]["mean_m"].get<double>());
  ASSERT_EQ(json["routes"].size(), 180U);
  EXPECT_EQ(json["routes"][0]["from"], "flange_rack");
  EXPECT_EQ(json["routes"][0]["status"], "found");
  EXPECT_EQ(json["svg"], svg);
  EXPECT_TRUE(read_file(svg).starts_with("<svg "));
  std::filesystem::remove(svg);
}

TEST(Cli, RoutesKeepsThemBesideTheScenarioUnlessTold) {
  const std::string file = temporary("kitting.yaml");
  std::filesystem::copy_file("scenarios/teaching/kitting_cell.yaml", file);
  ASSERT_EQ(linewright("routes --no-cache " + file).code, 0);
  EXPECT_FALSE(std::filesystem::exists(file + ".routes"));
  const Output output = linewright("routes " + file);
  ASSERT_EQ(output.code, 0) << output.err;
  EXPECT_TRUE(std::filesystem::exists(file + ".routes"));
  EXPECT_EQ(output.err, "");
  std::filesystem::remove(file + ".routes");
  std::filesystem::remove(file);
}

TEST(Cli, RoutesDrawsAPanelForEachStartAndKindAsked) {
  const std::string svg = temporary("starts.svg");
  const Output output = linewright(
      "routes scenarios/duct_line_routed.yaml --no-cache --kind robot --start outfeed "
      "--start storage --svg " +
      svg);
  ASSERT_EQ(output.code, 0) << output.err;
  EXPECT_NE(output.out.find("\nrobot   hybrid_a_star        10     90     90       0"),
            std::string::npos)
      << output.out;
  EXPECT_EQ(output.out.find("human"), std::string::npos) << output.out;
  const std::string picture = read_file(svg);
  EXPECT_NE(picture.find("robot from outfeed"), std::string::npos);
  EXPECT_NE(picture.find("robot from storage"), std::string::npos);
  EXPECT_EQ(picture.find("human"), std::string::npos);
  std::filesystem::remove(svg);
}

TEST(Cli, TellsADeadlock) {
  const Output output = linewright(
      "simulate scenarios/duct_line_published.yaml --planner replay "
      "--decisions tests/data/recorded/random_H1R1_n5_s0.json --json");
  ASSERT_EQ(output.code, 0) << output.err;
  const Json json = Json::parse(output.out);
  EXPECT_FALSE(json["finished"].get<bool>());
  EXPECT_TRUE(json["makespan"].is_null());
  EXPECT_EQ(json["status"], "deadlock");
}

TEST(Cli, EvaluateIsTheSameForEveryNumberOfThreads) {
  const std::string command =
      "evaluate scenarios/duct_line.yaml --planner random --humans 1..2 --robots 2 --trials 20 "
      "--json --threads ";
  const Output one = linewright(command + "1");
  ASSERT_EQ(one.code, 0) << one.err;
  EXPECT_EQ(one.out, linewright(command + "2").out);
  const Json json = Json::parse(one.out);
  ASSERT_EQ(json["rows"].size(), 2U);
  EXPECT_EQ(json["rows"][1]["humans"], 2);
  EXPECT_EQ(json["rows"][1]["robots"], 2);
  for (const char* key : {"mean", "sd", "ci95"})
    EXPECT_TRUE(json["rows"][0]["makespan"].contains(key));
  for (const char* key : {"success_rate", "progress", "distance"})
    EXPECT_TRUE(json["rows"][0].contains(key));
  EXPECT_TRUE(json.contains("mean_makespan"));
  EXPECT_TRUE(json.contains("success_rate"));
}

TEST(Cli, EvaluateComparesTwoConfigurationsInPairs) {
  const Output output = linewright(
      "evaluate scenarios/duct_line.yaml --humans 1 --robots 1 --trials 10 --versus +longest_path "
      "--json");
  ASSERT_EQ(output.code, 0) << output.err;
  EXPECT_EQ(Json::parse(output.out)["paired"]["equal"], 10);
}

TEST(Cli, EvaluateComparesAllocatorsWhichAreEqualWhereThereIsNothingToChoose) {
  const std::string all = "sap,no_spatial,longest_path,first_idle,sap_snapped";
  const Output output = linewright(
      "evaluate scenarios/duct_line.yaml --humans 1 --robots 1 --trials 10 --json --allocator " +
      all);
  ASSERT_EQ(output.code, 0) << output.err;
  const Json json = Json::parse(output.out);
  ASSERT_EQ(json["evaluations"].size(), 5U);
  ASSERT_EQ(json["paired"].size(), 4U);
  for (const Json& paired : json["paired"]) EXPECT_EQ(paired["equal"], 10) << paired;
  for (const Json& evaluation : json["evaluations"]) {
    Json first = json["evaluations"][0];
    first["allocator"] = evaluation["allocator"];
    EXPECT_EQ(evaluation, first);
  }
  EXPECT_EQ(json["lowest"]["makespan"].size(), 5U);
  EXPECT_EQ(json["trials"], 10);
}

TEST(Cli, EvaluatePutsAllocatorsSideBySide) {
  const std::string csv = temporary("allocators.csv");
  const Output output = linewright(
      "evaluate scenarios/duct_line.yaml --humans 2..3 --robots 2 --trials 20 --allocator "
      "longest_path,sap --csv " +
      csv);
  ASSERT_EQ(output.code, 0) << output.err;
  EXPECT_NE(output.out.find("makespan, ticks\ncrew  longest_path"), std::string::npos);
  EXPECT_NE(output.out.find("distance, metres\ncrew  longest_path"), std::string::npos);
  EXPECT_NE(output.out.find("lowest mean distance: sap\n"), std::string::npos) << output.out;
  EXPECT_EQ(output.out.find("success"), std::string::npos);
  const std::string rows = read_file(csv);
  EXPECT_EQ(std::count(rows.begin(), rows.end(), '\n'), 1 + 2 * 3);
  std::filesystem::remove(csv);
  const Output failing = linewright(
      "evaluate scenarios/duct_line.yaml --humans 2 --robots 2 --trials 4 --horizon 100 "
      "--allocator longest_path,sap");
  EXPECT_NE(failing.out.find("success rate\n"), std::string::npos) << failing.out;
}

TEST(Cli, BenchPrintsSpeedAndTheSameFingerprintTwice) {
  const std::string command =
      "bench scenarios/duct_line.yaml --humans 2 --robots 2 --seconds 0.05 --json";
  const Output output = linewright(command);
  ASSERT_EQ(output.code, 0) << output.err;
  const Json json = Json::parse(output.out);
  EXPECT_GT(json["decisions_per_second"].get<double>(), 0.0);
  EXPECT_GT(json["episodes_per_second"].get<double>(), 0.0);
  EXPECT_EQ(json["fingerprint"], Json::parse(linewright(command).out)["fingerprint"]);
}

TEST(Cli, EvaluatePutsPlannersSideBySide) {
  const std::string command =
      "evaluate scenarios/duct_line.yaml --humans 2 --robots 2 --trials 4 --allocator "
      "sap,first_idle --planner first,priority:1,2,8,mwkr --planner lookahead:5r";
  const Output output = linewright(command + " --json");
  ASSERT_EQ(output.code, 0) << output.err;
  const Json json = Json::parse(output.out);
  ASSERT_EQ(json["evaluations"].size(), 8U);
  EXPECT_EQ(json["evaluations"][2]["planner"], "priority:1,2,8");
  EXPECT_EQ(json["evaluations"][3]["allocator"], "first_idle");
  EXPECT_GE(json["evaluations"][6]["decision_ms"]["p99"],
            json["evaluations"][6]["decision_ms"]["p50"]);
  ASSERT_EQ(json["paired"].size(), 7U);
  EXPECT_EQ(json["paired"][0]["minus"], "first+sap");
  EXPECT_LT(json["paired"][5]["difference"]["mean"], 0.0);
  EXPECT_NE(linewright(command).out.find("lookahead:5r"), std::string::npos);
}

TEST(Cli, TunesAPriorityThatThePlannerThenTakes) {
  const std::string file = temporary("kitting.yaml");
  std::filesystem::copy_file(LINEWRIGHT_SOURCE_DIR "/scenarios/teaching/kitting_cell.yaml", file);
  const Output tuned = linewright("tune-priority " + file + " --runs 500 --starts 3 --json");
  ASSERT_EQ(tuned.code, 0) << tuned.err;
  const Json json = Json::parse(tuned.out);
  ASSERT_EQ(json["orders"].size(), 2U);
  EXPECT_TRUE(std::filesystem::exists(json["file"].get<std::string>()));
  const std::string run = "simulate " + file + " --json --planner priority:";
  EXPECT_EQ(linewright(run + "tuned").out,
            linewright(run + json["orders"][0]["priority"].get<std::string>()).out);
  std::ofstream(file, std::ios::app) << "allow_wait: true\n";
  const Output stale = linewright(run + "tuned");
  EXPECT_EQ(stale.code, 2);
  EXPECT_NE(stale.err.find("linewright tune-priority"), std::string::npos) << stale.err;
  std::filesystem::remove(file);
  std::filesystem::remove(json["file"].get<std::string>());
}

TEST(Cli, SolvesAndWritesALogThatReplays) {
  const std::string log = temporary("solved.jsonl");
  const Output output = linewright(
      "solve scenarios/duct_line.yaml --humans 2 --robots 1 --rollouts 400 --agents "
      "free --wait --json --log " +
      log);
  ASSERT_EQ(output.code, 0) << output.err;
  const Json run = Json::parse(output.out)["runs"][0];
  EXPECT_LT(run["makespan"], run["warm_start"]["makespan"]);
  const Output replay =
      linewright("simulate scenarios/duct_line.yaml --planner replay --json --decisions " + log);
  ASSERT_EQ(replay.code, 0) << replay.err;
  EXPECT_EQ(Json::parse(replay.out)["makespan"], run["makespan"]);
  std::filesystem::remove(log);
}

TEST(Cli, CheckReportsTheDeadStateOfEarlyCollecting) {
  const Output output = linewright("check scenarios/duct_line.yaml --humans 1 --robots 1 --json");
  ASSERT_EQ(output.code, 0) << output.err;
  const Json json = Json::parse(output.out);
  ASSERT_FALSE(json["dead_states"].empty());
  EXPECT_EQ(json["dead_states"][0]["task"], "collect_ducts");
  EXPECT_EQ(json["dead_states"][0]["proven"], true);
  EXPECT_EQ(linewright("check scenarios/duct_line.yaml --humans 1 --robots 1 --strict").code, 1);
}

TEST(Cli, WritesLogAndGanttAndDrawsTheLogAgain) {
  const std::string folder = temporary("files") + "/out";
  const Output output = linewright("simulate scenarios/teaching/kitting_cell.yaml --log " + folder +
                                   "/run.jsonl --gantt " + folder + "/run.svg");
  ASSERT_EQ(output.code, 0) << output.err;
  EXPECT_NE(output.out.find(folder + "/run.svg"), std::string::npos);
  ASSERT_EQ(linewright("gantt " + folder + "/run.jsonl --out " + folder + "/again.svg").code, 0);
  EXPECT_EQ(read_file(folder + "/run.svg"), read_file(folder + "/again.svg"));
  EXPECT_FALSE(read_file(folder + "/run.svg").empty());
  std::filesystem::remove_all(temporary("files"));
}

/// Without LibTorch there is none.
bool has_trainer() {
  return std::filesystem::exists(std::filesystem::path(LINEWRIGHT_CLI).parent_path() /
                                 "linewright-train");
}

TEST(Readme, EveryCommandLineWorks) {
  std::ifstream in(LINEWRIGHT_SOURCE_DIR "/README.md");
  const std::string prefix = "    linewright ";
  int seen = 0;
  for (std::string line; std::getline(in, line);) {
    if (!line.starts_with(prefix)) continue;
    ++seen;
    std::string arguments = line.substr(prefix.size());
    if (arguments.starts_with("train ")) {
      if (!has_trainer()) continue;
      // A whole training run takes minutes; two updates try out the same words.
      arguments = arguments.substr(0, arguments.find("  #")) +
                  " --set optimizer.updates=2 --set optimizer.warmup=200 --set run.evaluate_every=2"
                  " --quiet --out " +
                  temporary("readme");
    }
    const Output output = linewright(arguments);
    EXPECT_EQ(output.code, 0) << line << "\n" << output.err;
    EXPECT_NE(output.out, "") << line;
  }
  EXPECT_GE(seen, 5);
  std::filesystem::remove_all(temporary("readme"));
}

TEST(Cli, CheckPrintsDiagnosticsAsJson) {
  const Output output = linewright("check tests/diagnostics/unknown_key.yaml --json");
  EXPECT_EQ(output.code, 2);
  const Json json = Json::parse(output.out);
  EXPECT_EQ(json["valid"], false);
  ASSERT_FALSE(json["diagnostics"].empty());
  EXPECT_GT(json["diagnostics"][0]["line"].get<int>(), 0);
}

struct Wrong {
  const char* arguments;
  const char* says;
};

class CliErrors : public ::testing::TestWithParam<Wrong> {};

TEST_P(CliErrors, ExitWithTwoAndSayWhatToWrite) {
  const Output output = linewright(GetParam().arguments);
  EXPECT_EQ(output.code, 2);
  EXPECT_EQ(output.out, "");
  EXPECT_NE(output.err.find(GetParam().says), std::string::npos) << output.err;
}

INSTANTIATE_TEST_SUITE_P(
    All, CliErrors,
    ::testing::Values(
        Wrong{"simulate nowhere.yaml", "nowhere.yaml"},
        Wrong{"simulate scenarios/duct_line.yaml --planner frist", "did you mean 'first'?"},
        Wrong{"simulate scenarios/duct_line.yaml --allocator sapp", "did you mean 'sap'?"},
        Wrong{"simulate scenarios/duct_line.yaml --planner priority:1,99", "no task '99'"},
        Wrong{"simulate scenarios/duct_line.yaml --planner priority:cut_strait",
              "did you mean 'cut_straight'?"},
        Wrong{"simulate scenarios/duct_line.yaml --planner priority:1,1", "listed twice"},
        Wrong{"simulate scenarios/duct_line.yaml --planner lookahead:0ms", "nothing to look ahead"},
        Wrong{"simulate scenarios/duct_line.yaml --planner lookahead:1ms,agent=free",
              "did you mean 'agents'?"},
        Wrong{"simulate scenarios/teaching/long_hall.yaml --planner priority:tuned",
              "linewright tune-priority scenarios/teaching/long_hall.yaml"},
        Wrong{"evaluate scenarios/duct_line.yaml --planner first,random,first", "listed twice"},
        Wrong{"evaluate scenarios/duct_line.yaml --planner first,random --versus random",
              "name one planner"},
        Wrong{"solve scenarios/duct_line.yaml --budget 0s", "leaves nothing to search with"},
        Wrong{"solve scenarios/duct_line.yaml --budget 60", "is no time"},
        Wrong{"solve scenarios/duct_line.yaml --budget 1s --rollouts 5", "--rollouts"},
        Wrong{"solve scenarios/duct_line.yaml --humans 1,2 --rollouts 5 --log out/x.jsonl",
              "for one run"},
        Wrong{"solve scenarios/duct_line.yaml --rollouts 5 --allocator no_spatial",
              "draws at random"},
        Wrong{"tune-priority scenarios/duct_line.yaml --runs 0", "--runs"},
        Wrong{"simulate scenarios/duct_line.yaml --planner first:3", "takes no '3'"},
        Wrong{"simulate scenarios/duct_line.yaml --humans 7", "made for 1 to 3"},
        Wrong{"simulate scenarios/duct_line.yaml --humans two", "is no count"},
        Wrong{"simulate scenarios/duct_line.yaml --crew forklift=1",
              "no workers called 'forklift'"},
        Wrong{"simulate scenarios/duct_line.yaml --order 0", "order of 0"},
        Wrong{"simulate scenarios/duct_line.yaml --close ramp@10+5", "has no zone 'ramp'"},
        Wrong{"evaluate scenarios/duct_line.yaml --close ramp@10", "is no ZONE@TICK+TICKS"},
        Wrong{"simulate scenarios/duct_line.yaml --close ramp@0+5", "is no ZONE@TICK+TICKS"},
        Wrong{"simulate scenarios/duct_line.yaml --horizon -5", "horizon"},
        Wrong{"simulate scenarios/duct_line.yaml --planner replay", "--decisions FILE"},
        Wrong{"simulate scenarios/duct_line.yaml --decisions x.json", "--planner replay"},
        Wrong{"simulate scenarios/duct_line.yaml --planner replay --decisions nowhere.json",
              "nowhere.json"},
        Wrong{"simulate scenarios/duct_line.yaml --planner replay --decisions README.md",
              "event log"},
        Wrong{"simulate scenarios/duct_line.yaml --log /proc/nowhere/x.jsonl", "cannot be written"},
        Wrong{"simulate scenarios/duct_line.yaml --gantt out/x.pdf", ".svg"},
        Wrong{"evaluate scenarios/duct_line.yaml --humans 3..1", "is empty"},
        Wrong{"evaluate scenarios/duct_line.yaml --trials 0", "--trials"},
        Wrong{"evaluate scenarios/duct_line.yaml --allocator sap,longest_pth",
              "did you mean 'longest_path'?"},
        Wrong{"evaluate scenarios/duct_line.yaml --allocator sap,sap", "listed twice"},
        Wrong{"evaluate scenarios/duct_line.yaml --allocator sap,first_idle --versus random",
              "name one allocator"},
        Wrong{"evaluate scenarios/duct_line.yaml --humans 0..10000 --robots 1..2",
              "more than 10000 crews"},
        Wrong{"simulate scenarios/duct_line.yaml --humans 10001", "a number up to 10000"},
        Wrong{"gantt nowhere.jsonl", "nowhere.jsonl"},
        Wrong{"gantt scenarios/duct_line.yaml", "scenarios/duct_line.yaml"},
        Wrong{"simulate scenarios/duct_line.yaml --humanz 2", "did you mean '--humans'?"},
        Wrong{"simulate scenarios/duct_line.yaml --humans 1..2", "this command runs one"},
        Wrong{"simulate scenarios/duct_line.yaml --humans 2 --crew human=1", "given twice"},
        Wrong{"simulate scenarios/duct_line.yaml --log out/x.svg --gantt out/x.svg", "two files"},
        Wrong{"simulate scenarios/duct_line.yaml --seed -1", "--seed"},
        Wrong{"simulate scenarios/duct_line.yaml --planner replay --humans 1 --decisions x.json",
              "from the record"},
        Wrong{"simulate scenarios/duct_line.yaml --planner replay --order 0 --decisions "
              "tests/data/recorded/rule_H2R2_n1_s0.json",
              "order of 0"},
        Wrong{"evaluate scenarios/duct_line.yaml --planner replay", "only for simulate"},
        Wrong{"map scenarios/maps/duct_hall.yaml", "a map file of ROS map_server, not a scenario"},
        Wrong{"map scenarios/teaching/one_human_one_robot.yaml", "the scenario has no map"},
        Wrong{"map scenarios/duct_line.yaml --out out/hall.png", "name the YAML file: hall.yaml"},
        Wrong{"map nowhere.yaml", "nowhere.yaml"},
        Wrong{"routes scenarios/duct_line.yaml",
              "write travel: {human: hybrid_a_star, robot: hybrid_a_star}"},
        Wrong{"routes scenarios/teaching/one_human_one_robot.yaml", "give it a map"},
        Wrong{"routes scenarios/duct_line_routed.yaml --no-cache --kind robt",
              "did you mean 'robot'?"},
        Wrong{"routes scenarios/duct_line_routed.yaml --no-cache --svg out/x.svg --start "
              "flange_rak",
              "did you mean 'flange_rack'?"},
        Wrong{"routes scenarios/duct_line_routed.yaml --start storage", "add --svg FILE.svg"},
        Wrong{"routes scenarios/duct_line_routed.yaml --svg out/x.png", "ends in .svg"},
        Wrong{"simualte", "did you mean 'simulate'?"}));

}  // namespace
}  // namespace linewright::testing

#endif
