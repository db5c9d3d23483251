// The command line tool as a user meets it: what it prints, where, and its exit codes.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/cli_support.hpp"

#ifdef LINEWRIGHT_CLI

namespace linewright::testing {
namespace {

using Json = nlohmann::json;

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
  const std::string file = temporary("kitting_routes.yaml");
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
    // The page needs Node.js, which a build of the program alone does not.
    if (arguments.starts_with("view ") && output.err.find("make web") != std::string::npos)
      continue;
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

}  // namespace
}  // namespace linewright::testing

#endif
