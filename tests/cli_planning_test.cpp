// The commands that compare, search and explain, as a user meets them.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/cli_support.hpp"

#ifdef LINEWRIGHT_CLI

namespace linewright::testing {
namespace {

using Json = nlohmann::json;

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

TEST(Cli, EvaluateTakesTheFilesOfAFolderAsTrainingSeeds) {
  const std::string folder = temporary("seeds");
  std::filesystem::create_directory(folder);
  for (const char* name : {"/1.safetensors", "/2.safetensors"}) {
    std::filesystem::copy_file(LINEWRIGHT_SOURCE_DIR "/policies/ebq-n.safetensors", folder + name);
  }
  std::ofstream(folder + "/README.md") << "not a policy";
  const std::string command =
      "evaluate scenarios/duct_line.yaml --humans 2..3 --robots 2 --trials 3 --planner "
      "first,policy:" +
      folder;
  const Output output = linewright(command + " --json");
  ASSERT_EQ(output.code, 0) << output.err;
  const Json json = Json::parse(output.out);
  ASSERT_EQ(json["evaluations"].size(), 3U);
  ASSERT_EQ(json["seeds"].size(), 1U);
  const Json& seeds = json["seeds"][0];
  EXPECT_EQ(seeds["planner"], "policy:" + folder);
  EXPECT_EQ(seeds["seeds"], 2);
  EXPECT_EQ(seeds["makespan"]["mean"], json["evaluations"][1]["mean_makespan"]);
  EXPECT_EQ(seeds["makespan"]["ci95"], 0.0);  // twice the same
  EXPECT_EQ(seeds["crews"].size(), 2U);
  EXPECT_NE(linewright(command).out.find("training seeds of"), std::string::npos);
  std::filesystem::remove_all(folder);
}

TEST(Cli, BoundNamesItsArgumentAndIsBelowEverySolution) {
  const std::string run = " scenarios/duct_line.yaml --humans 2 --robots 2 --order 2 --json";
  const Output output = linewright("bound" + run + " --makespan 500");
  ASSERT_EQ(output.code, 0) << output.err;
  const Json json = Json::parse(output.out);
  EXPECT_NEAR(json["gap"].get<double>(), 500.0 / json["bound"].get<double>() - 1.0, 1e-6);
  for (const Json& bound : json["bounds"])
    EXPECT_FALSE(bound["argument"].get<std::string>().empty());
  const Json solved = Json::parse(linewright("solve" + run + " --rollouts 200").out);
  EXPECT_LE(json["bound"], solved["runs"][0]["makespan"]);
}

TEST(Cli, TheShieldFinishesWhatFailsWithoutIt) {
  const std::string command =
      "evaluate scenarios/duct_line.yaml --planner random --humans 1 --robots 1 --order 2 --trials "
      "20 ";
  const Json shielded = Json::parse(linewright(command + "--json").out);
  const Json bare = Json::parse(linewright(command + "--json --shield off").out);
  EXPECT_EQ(shielded["success_rate"], 1.0);
  EXPECT_LT(bare["success_rate"], 0.5);
  EXPECT_NE(linewright(command).out.find("decisions ruled out"), std::string::npos);
}

TEST(Cli, ExplainsEachDecisionInTextAndLog) {
  const std::string log = temporary("explained.jsonl");
  const std::string command = "simulate scenarios/duct_line.yaml --humans 2 --robots 1 --order 1";
  const Output output = linewright(command + " --explain --log " + log);
  ASSERT_EQ(output.code, 0) << output.err;
  EXPECT_TRUE(output.out.starts_with("tick 1: ")) << output.out;
  EXPECT_NE(output.out.find("could not be chosen:"), std::string::npos);
  const std::string text = read_file(log);
  EXPECT_NE(text.find("\"why\":{\"alternatives\":[{\"task\":"), std::string::npos);
  EXPECT_EQ(Json::parse(linewright(command + " --json --explain --log " + log).out)["finished"],
            true);
  std::filesystem::remove(log);
}

/// Every mean of the CSV stands, rounded, in the report's row of that name, in the same order.
void expect_same_numbers(const std::string& csv, const std::string& html) {
  std::istringstream lines(csv);
  std::string line;
  std::getline(lines, line);
  std::string row;
  std::size_t at = 0;
  while (std::getline(lines, line)) {
    std::vector<std::string> fields;
    std::istringstream in(line);
    for (std::string field; std::getline(in, field, ',');) fields.push_back(field);
    if (fields[2] != row) at = html.find("<th scope=\"row\">" + fields[2] + "</th>");
    row = fields[2];
    ASSERT_NE(at, std::string::npos) << line;
    char cell[32];
    std::snprintf(cell, sizeof cell, "<td>%.1f", std::stod(fields[4]));
    at = html.find("<td>", at + 1);
    EXPECT_EQ(html.substr(at, std::strlen(cell)), cell) << line;
  }
}

TEST(Cli, ReproducesAnExperimentAndGoesOnWithWhatIsThere) {
  const std::string folder = temporary("reproduce");
  std::filesystem::create_directory(folder);
  std::filesystem::copy_file(LINEWRIGHT_SOURCE_DIR "/scenarios/teaching/kitting_cell.yaml",
                             folder + "/line.yaml");
  std::ofstream(folder + "/rules.yaml")
      << "title: Rules\nscenario: line.yaml\ncolumns: orders\norders: [1, 2]\n"
         "metrics: [makespan]\ntrials: 3\nrows:\n  - {row: lowest, planner: first}\n"
         "  - {row: any, planner: random}\n  - {row: bound, bound: combined, trials: 2}\nclaims: "
         "[{says: a rule helps, lower: lowest, than: "
         "any}]\n";
  const std::string command = "reproduce " + folder + "/rules.yaml --out " + folder + "/out";
  const Output first = linewright(command);
  ASSERT_EQ(first.code, 0) << first.err;
  EXPECT_NE(first.out.find("| **lowest** |"), std::string::npos) << first.out;
  const std::string csv = read_file(folder + "/out/tables/rules.csv");
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 3 * 2);
  expect_same_numbers(csv, read_file(folder + "/out/report.html"));
  // One cell is lost, the others are taken as they are.
  std::size_t cells = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder + "/out/results")) {
    if (cells++ == 0) std::filesystem::remove(entry.path());
  }
  EXPECT_EQ(cells, 6U);
  EXPECT_EQ(linewright(command).out, first.out);
  EXPECT_EQ(read_file(folder + "/out/tables/rules.csv"), csv);
  std::filesystem::remove_all(folder);
}

TEST(Cli, ReproduceTrainsWhatIsMissingAndNothingTwice) {
  if (!has_trainer()) GTEST_SKIP() << "built without LibTorch";
  const std::string folder = temporary("reproduce_training");
  std::filesystem::create_directory(folder);
  std::filesystem::copy_file(LINEWRIGHT_SOURCE_DIR "/scenarios/teaching/one_human_one_robot.yaml",
                             folder + "/line.yaml");
  std::ofstream(folder + "/mini.yaml") << "extends: " LINEWRIGHT_SOURCE_DIR
                                          "/algorithms/base.yaml\nalgorithm: {name: mini}\n"
                                          "optimizer: {updates: 20, warmup: 300, batch: 32}\n"
                                          "run: {evaluate_every: 10, evaluation_trials: 1}\n";
  std::ofstream(folder + "/learned.yaml")
      << "title: Learned\nscenario: line.yaml\ncolumns: crews\norders: [2]\nmetrics: [makespan]\n"
         "trials: 2\nseeds: [1, 2]\nrows: [{row: mini, algorithm: mini.yaml}, {row: one copy, "
         "algorithm: mini.yaml, set: [buffer.copies=1]}]\n";
  std::ofstream(folder + "/records.yaml")
      << "title: Records\nscenario: line.yaml\ncolumns: training\nseeds: [1, 2]\n"
         "rows: [{row: mini, algorithm: mini.yaml}]\n";
  const std::string command = "reproduce " + folder + "/learned.yaml --out " + folder + "/out";
  const Output first = linewright(command);
  ASSERT_EQ(first.code, 0) << first.err;
  const std::string policy = folder + "/out/train/line/mini-s2/best.safetensors";
  const auto written = std::filesystem::last_write_time(policy);
  EXPECT_EQ(linewright(command).out, first.out);
  EXPECT_EQ(std::filesystem::last_write_time(policy), written);
  const std::string variant = folder + "/out/train/line/buffer.copies=1/mini-s1/options.yaml";
  EXPECT_NE(read_file(variant).find("copies: 1\n"), std::string::npos);
  const Output records =
      linewright("reproduce " + folder + "/records.yaml --out " + folder + "/out");
  ASSERT_EQ(records.code, 0) << records.err;
  EXPECT_NE(records.out.find("| 20 |"), std::string::npos) << records.out;  // updates
  EXPECT_EQ(std::filesystem::last_write_time(policy), written);
  EXPECT_TRUE(std::filesystem::exists(folder + "/out/figures/records_training_return.svg"));
  // A run whose evaluations all had failures has no best policy: the last one is played.
  std::filesystem::remove(policy);
  const Output without_best = linewright(command);
  ASSERT_EQ(without_best.code, 0) << without_best.err;
  EXPECT_NE(without_best.err.find("mini-s2: no evaluation had every run succeed"),
            std::string::npos)
      << without_best.err;
  EXPECT_FALSE(std::filesystem::exists(policy));
  std::filesystem::remove_all(folder);
}

/// A program in place of Python: what it says is what the solver has proven.
std::string solver_saying(const std::string& body) {
  const std::string file = temporary("solver.sh");
  std::ofstream(file) << "#!/bin/sh\n" << body << "\n";
  std::filesystem::permissions(file, std::filesystem::perms::owner_all);
  return file;
}

const char* const kBoundOfOne =
    "bound scenarios/duct_line.yaml --humans 3 --robots 3 --order 2 --states 0 --json --solver "
    "cp-sat --python ";

TEST(Cli, BoundTakesWhatASolverProves) {
  const std::string solver = solver_saying(
      "cat >/dev/null; echo '{\"bound\":340,\"closed\":0,\"cases\":2}'; echo "
      "'{\"bound\":350,\"closed\":2,\"cases\":2}'");
  const Output output = linewright(kBoundOfOne + solver);
  ASSERT_EQ(output.code, 0) << output.err;
  const Json json = Json::parse(output.out);
  EXPECT_EQ(json["name"], "joint:cp_sat");
  EXPECT_EQ(json["bound"], 350);
  EXPECT_GE(json["found"], 350);
}

TEST(Cli, BoundSaysWhatASolverIsMissing) {
  Output output = linewright(std::string(kBoundOfOne) + "/no/such/python");
  EXPECT_EQ(output.code, 2);
  EXPECT_NE(output.err.find("there is no such program"), std::string::npos) << output.err;
  EXPECT_NE(output.err.find("pip install ortools"), std::string::npos) << output.err;
  output = linewright(kBoundOfOne + solver_saying("echo no ortools here >&2; exit 1"));
  EXPECT_EQ(output.code, 2);
  EXPECT_NE(output.err.find("no ortools here"), std::string::npos) << output.err;
  output = linewright(kBoundOfOne + solver_saying("cat >/dev/null; echo nonsense"));
  EXPECT_EQ(output.code, 2);
  EXPECT_NE(output.err.find("nonsense"), std::string::npos) << output.err;
}

TEST(Cli, BoundRefusesABudgetThatIsNoneOrWithoutASolver) {
  const std::string run = "bound scenarios/duct_line.yaml --humans 3 --robots 3 --order 2 ";
  Output output = linewright(run + "--solver cp-sat --budget soon");
  EXPECT_EQ(output.code, 2);
  EXPECT_NE(output.err.find("'soon' is no time"), std::string::npos) << output.err;
  output = linewright(run + "--budget 5s");
  EXPECT_EQ(output.code, 2);
  EXPECT_NE(output.err.find("requires --solver"), std::string::npos) << output.err;
}

/// With LINEWRIGHT_ORTOOLS naming a Python that has ortools: what it proves is below what is known.
TEST(Cli, BoundByCpSatIsBelowTheBestRun) {
  const char* python = std::getenv("LINEWRIGHT_ORTOOLS");
  if (python == nullptr) GTEST_SKIP() << "LINEWRIGHT_ORTOOLS names no Python with ortools";
  for (const char* run : {" --humans 2 --robots 1 --order 1", " --humans 1 --robots 2 --order 2"}) {
    const std::string line = std::string(" scenarios/duct_line.yaml --json") + run;
    const Output solved = linewright("solve" + line + " --agents free --wait --rollouts 2000");
    ASSERT_EQ(solved.code, 0) << solved.err;
    const Output output = linewright("bound" + line +
                                     " --states 0 --makespan 900 --solver cp-sat "
                                     "--budget 5s --python " +
                                     python);
    ASSERT_EQ(output.code, 0) << output.err;
    EXPECT_LE(Json::parse(output.out)["bound"], Json::parse(solved.out)["runs"][0]["makespan"])
        << run;
  }
}

}  // namespace
}  // namespace linewright::testing

#endif
