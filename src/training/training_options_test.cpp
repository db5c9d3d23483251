#include "linewright/training/training_options.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "linewright/base/diagnostic.hpp"
#include "linewright/base/files.hpp"

namespace linewright {
namespace {

const std::string kRoot = LINEWRIGHT_SOURCE_DIR;
using Overrides = std::vector<std::string>;

std::string complaint_about(const std::string& text, const Overrides& overrides = {}) {
  try {
    static_cast<void>(training_options_from_text(text, "t.yaml", overrides));
  } catch (const ScenarioError& error) {
    return error.what();
  }
  return "";
}

TrainingOptions from_text(const std::string& text, const Overrides& overrides = {}) {
  return training_options_from_text(text, "t.yaml", overrides);
}

TEST(TrainingOptions, AreTheDefaultsWhereNothingIsGiven) {
  EXPECT_EQ(to_yaml(from_text("{}")), to_yaml(TrainingOptions()));
}

TEST(TrainingOptions, ReadBackWhatTheyWrite) {
  TrainingOptions options;
  options.algorithm = {.name = "x.y_z-1", .kind = AlgorithmSettings::Kind::kPpo};
  options.network.query = NetworkOptions::Query::kSingle;
  options.network.noisy = false;
  options.reward.eta1 = 0.1 + 0.2;  // needs all 17 digits
  options.optimizer.learning_rate = 1e-9;
  options.exploration.epsilon_decisions = 1'000'000'000'000;
  options.run.order = 7;
  options.run.horizon = {{{{"human", 1}, {"robot", 2}}, 1250}, {{}, 1000}};
  options.run.crews = RunSettings::Crews::kSampled;
  const TrainingOptions again = from_text(to_yaml(options));
  EXPECT_EQ(to_yaml(again), to_yaml(options));
  EXPECT_EQ(again.reward.eta1, options.reward.eta1);
  EXPECT_EQ(again.network.query, NetworkOptions::Query::kSingle);
  EXPECT_EQ(again.exploration.epsilon_decisions, 1'000'000'000'000);
  EXPECT_EQ(again.run.horizon[0].crew, options.run.horizon[0].crew);
  EXPECT_NO_THROW(check_training_options(options));
}

TEST(TrainingOptions, UnknownKeysNameTheNearestOne) {
  EXPECT_EQ(complaint_about("buffer:\n  alhpa: 0.5\n"),
            "t.yaml:2:3: error: 'buffer': unknown key 'alhpa'\n  hint: did you mean 'alpha'?");
  EXPECT_EQ(complaint_about("bufer: {alpha: 1}"),
            "t.yaml:1:1: error: unknown key 'bufer'\n  hint: did you mean 'buffer'?");
  EXPECT_NE(complaint_about("algorithm: {kind: dqm}").find("did you mean 'dqn'?"),
            std::string::npos);
  EXPECT_NE(complaint_about("run: {allocator: sup}").find("did you mean 'sap'?"),
            std::string::npos);
}

TEST(TrainingOptions, ValuesOutOfRangeNameTheRange) {
  EXPECT_EQ(complaint_about("buffer: {alpha: 1.5}"),
            "t.yaml:1:17: error: 'buffer.alpha' must be a number from 0 to 1, but is '1.5'");
  EXPECT_NE(complaint_about("optimizer: {gamma: .nan}"), "");
  EXPECT_NE(complaint_about("optimizer: {gamma: nan}"), "");
  EXPECT_NE(complaint_about("optimizer: {batch: 12.5}"), "");
  EXPECT_NE(complaint_about("optimizer: {updates: 0}"), "");
  EXPECT_NE(complaint_about("optimizer: {updates: 99999999999999999999}"), "");
  EXPECT_NE(complaint_about("network: {noisy: 1}"), "");
  EXPECT_NE(complaint_about("network: {noisy: [true]}"), "");
  EXPECT_NE(complaint_about("network: 3"), "");
  EXPECT_NE(complaint_about("hello"), "");
  EXPECT_NE(complaint_about(""), "");
  EXPECT_NE(complaint_about("algorithm: {name: 'a b'}"), "");
  EXPECT_NE(complaint_about("run: {horizon: []}"), "");
  EXPECT_NE(complaint_about("run: {horizon: [{crew: {human: 1}}]}"), "");
  EXPECT_NE(complaint_about("run: {horizon: soon}"), "");
}

TEST(TrainingOptions, EverythingWrongIsReportedAtOnce) {
  const std::string complaint = complaint_about("buffer: {alpha: 2, copies: 0}\nppo: {epoch: 1}\n");
  EXPECT_NE(complaint.find("buffer.alpha"), std::string::npos);
  EXPECT_NE(complaint.find("buffer.copies"), std::string::npos);
  EXPECT_NE(complaint.find("did you mean 'epochs'?"), std::string::npos);
}

TEST(TrainingOptions, ValuesMustGoTogether) {
  EXPECT_EQ(complaint_about("network: {width: 33}"),
            "t.yaml:1:18: error: 'network.width' (33) must be a multiple of 'network.heads' (2)\n"
            "  hint: each head works on an equal share of the width");
  for (const std::string text :
       {"buffer: {beta_start: 0.9, beta_end: 0.5}", "buffer: {capacity: 100}",
        "optimizer: {warmup: 100}", "buffer: {copies: 100, capacity: 99}",
        "exploration: {epsilon_start: 0.1, epsilon_end: 0.2}",
        "run: {horizon: [{ticks: 1000}, {crew: {human: 1}, ticks: 10}]}"}) {
    EXPECT_NE(complaint_about(text), "") << text;
  }
}

TEST(TrainingOptions, OptionsMadeInCodeAreCheckedToo) {
  TrainingOptions options;
  options.optimizer.gamma = std::nan("");
  EXPECT_THROW(check_training_options(options), ScenarioError);
  options = {};
  options.algorithm.name = "\"\n: {";
  EXPECT_THROW(check_training_options(options), ScenarioError);
  options = {};
  options.algorithm.kind = static_cast<AlgorithmSettings::Kind>(9);
  EXPECT_THROW(check_training_options(options), ScenarioError);
}

TEST(Overrides, ReplaceSingleValues) {
  const TrainingOptions options =
      from_text("buffer: {alpha: 0.5, eta4: 0.3}",
                {"buffer.alpha=0.6", "run.horizon=[{crew: {human: 1}, ticks: 1250}, {ticks: 9}]",
                 "buffer.alpha=0.7", "run.order=3"});
  EXPECT_EQ(options.buffer.alpha, 0.7);
  EXPECT_EQ(options.buffer.eta4, 0.3);
  EXPECT_EQ(options.run.order, 3);
  EXPECT_EQ(options.run.horizon.size(), 2U);
}

TEST(Overrides, WrongOnesAreNamed) {
  EXPECT_EQ(complaint_about("{}", {"buffer.alhpa=0.6"}),
            "override 'buffer.alhpa=0.6': error: 'buffer': unknown key 'alhpa'\n"
            "  hint: did you mean 'alpha'?");
  EXPECT_EQ(complaint_about("{}", {"bufer.alpha=0.6"}),
            "override 'bufer.alpha=0.6': error: unknown key 'bufer'\n"
            "  hint: did you mean 'buffer'?");
  EXPECT_EQ(complaint_about("{}", {"buffer.alpha=2"}),
            "override 'buffer.alpha=2': error: 'buffer.alpha' must be a number from 0 to 1, but is "
            "'2'");
  for (const std::string text :
       {"", "=", "buffer", "buffer.alpha", "buffer.alpha=", "buffer.alpha=~", "buffer.alpha=[",
        ".alpha=1", "buffer..alpha=1", "a.b.c.d.e.f=1", "buffer=1", "buffer.alpha.x=1", "buffer.=1",
        "buffer.alpha=# nothing", "buffer.alpha=\x01"}) {
    EXPECT_NE(complaint_about("{}", {text}).find("override "), std::string::npos) << text;
  }
}

TEST(HorizonFor, TheFirstRuleThatFitsCounts) {
  RunSettings run;
  EXPECT_EQ(horizon_for(run, {{"human", 1}}), std::nullopt);
  run.horizon = {{{{"human", 1}}, 1250}, {{{"human", 2}, {"robot", 1}}, 1100}};
  EXPECT_EQ(horizon_for(run, {{"human", 1}, {"robot", 3}}), 1250);
  EXPECT_EQ(horizon_for(run, {{"human", 2}, {"robot", 1}}), 1100);
  EXPECT_EQ(horizon_for(run, {{"human", 2}, {"robot", 2}}), std::nullopt);
  run.horizon.push_back({{}, 1000});
  EXPECT_EQ(horizon_for(run, {{"human", 2}, {"robot", 2}}), 1000);
}

/// Files of this test alone, one beside the other.
class OptionFiles : public testing::Test {
 protected:
  std::string file(const std::string& name, const std::string& text) {
    const std::string path = folder_ + "/" + name;
    write_file(path, text);
    return path;
  }
  static std::string complaint(const std::string& path, const std::string& preset = {}) {
    try {
      static_cast<void>(load_training_options(path, preset));
    } catch (const ScenarioError& error) {
      return error.what();
    }
    return "";
  }
  std::string folder_ = testing::TempDir() + "linewright_training_options_" +
                        testing::UnitTest::GetInstance()->current_test_info()->name();
};

TEST_F(OptionFiles, ExtendsIsRelativeToTheFile) {
  file("base.yaml", "buffer: {alpha: 0.1, eta4: 0.2}\nrun: {order: 3}\n");
  const TrainingOptions options = load_training_options(
      file("mine.yaml", "extends: base.yaml\nbuffer: {alpha: 0.3}\nrun: {order: ~}\n"));
  EXPECT_EQ(options.buffer.alpha, 0.3);
  EXPECT_EQ(options.buffer.eta4, 0.2);
  EXPECT_EQ(options.run.order, std::nullopt);
}

TEST_F(OptionFiles, MistakesAreNamedWhereTheyStand) {
  const std::string base = file("base.yaml", "buffer:\n  alpa: 0.1\n");
  const std::string mine = file("mine.yaml", "extends: base.yaml\nbuffer: {eta4: 1}\n");
  EXPECT_EQ(complaint(mine), base +
                                 ":2:3: error: 'buffer': unknown key 'alpa'\n"
                                 "  hint: did you mean 'alpha'?");
  EXPECT_NE(complaint(folder_ + "/none.yaml").find("none.yaml: error: cannot read"),
            std::string::npos);
  EXPECT_NE(complaint(file("circle.yaml", "extends: circle.yaml")).find("in a circle"),
            std::string::npos);
  const std::string sound = file("sound.yaml", "{}");
  EXPECT_NE(complaint(sound, folder_ + "/none.yaml").find("cannot read"), std::string::npos);
  EXPECT_NE(complaint(sound, file("text.yaml", "text")).find("text.yaml:1:1"), std::string::npos);
  EXPECT_NE(complaint(file("text.yaml", "text"), sound).find("text.yaml:1:1"), std::string::npos);
}

TEST(Algorithms, BaseWritesTheDefaultsOut) {
  TrainingOptions defaults;
  defaults.algorithm.name = "base";
  EXPECT_EQ(to_yaml(load_training_options(kRoot + "/algorithms/base.yaml")), to_yaml(defaults));
}

/// One row of the paper's Table 3.
struct Row {
  std::string name;
  bool modify = false;
  int copies = 1;
  bool epsilon_greedy = false;
  bool noisy = false;
  bool dueling = false;
  bool double_q = false;
};

const std::vector<Row> kTable = {
    {"d3qn", false, 1, true, false, true, true},  {"no-modify", false, 5, true, false, true, true},
    {"edqn1", true, 5, true, false, true, false}, {"edqn2", true, 5, true, false, false, true},
    {"ebq-g", true, 5, true, false, true, true},  {"ebq-n", true, 5, false, true, true, true},
    {"ebq-gn", true, 5, true, true, true, true},  {"eppo", true, 5, false, true, true, false},
};

TEST(Algorithms, AreTheRowsOfTheTableWithEveryPreset) {
  for (const Row& row : kTable) {
    for (const std::string preset : {"", "/algorithms/paper.yaml"}) {
      const TrainingOptions options = load_training_options(
          kRoot + "/algorithms/" + row.name + ".yaml", preset.empty() ? "" : kRoot + preset);
      EXPECT_EQ(options.algorithm.name, row.name);
      EXPECT_EQ(options.algorithm.kind == AlgorithmSettings::Kind::kPpo, row.name == "eppo");
      EXPECT_EQ(options.buffer.modify_reward, row.modify) << row.name;
      EXPECT_EQ(options.buffer.copies, row.copies) << row.name;
      EXPECT_EQ(options.exploration.epsilon_greedy, row.epsilon_greedy) << row.name;
      EXPECT_EQ(options.network.noisy, row.noisy) << row.name;
      EXPECT_EQ(options.network.dueling, row.dueling) << row.name;
      EXPECT_EQ(options.optimizer.double_q, row.double_q) << row.name;
    }
  }
}

TEST(Algorithms, EachFileOfTheFolderIsKnownHere) {
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(kRoot + "/algorithms")) {
    EXPECT_NO_THROW(static_cast<void>(load_training_options(entry.path().string())));
    ++files;
  }
  EXPECT_EQ(files, kTable.size() + 2);
}

TEST(Algorithms, ThePaperPresetHasThePublishedSettings) {
  const TrainingOptions o =
      load_training_options(kRoot + "/algorithms/ebq-n.yaml", kRoot + "/algorithms/paper.yaml");
  EXPECT_EQ(o.network.width, 512);
  EXPECT_EQ(o.network.heads, 8);
  EXPECT_EQ(o.network.encoder_layers, 2);
  EXPECT_EQ(o.network.feedforward, 2048);
  EXPECT_EQ(o.optimizer.warmup + o.optimizer.updates * o.optimizer.decisions_per_update, 700'000);
  EXPECT_EQ(o.optimizer.target_every * o.optimizer.decisions_per_update, 2000);
  EXPECT_EQ(horizon_for(o.run, {{"human", 1}, {"robot", 3}}), 1250);
  EXPECT_EQ(horizon_for(o.run, {{"human", 3}, {"robot", 1}}), 1000);
}

TEST(TrainingOptions, EveryKeyIsDocumented) {
  std::string reason;
  const std::string page = read_file(kRoot + "/docs/formats/training.md", 1 << 20, reason).value();
  const std::string yaml = to_yaml(TrainingOptions());
  std::size_t keys = 0;
  for (std::size_t at = 0; at < yaml.size(); at = yaml.find('\n', at) + 1, ++keys) {
    const std::size_t start = yaml.find_first_not_of(' ', at);
    const std::string key = yaml.substr(start, yaml.find(':', start) - start);
    const bool is_group = start == at;
    EXPECT_NE(page.find((is_group ? "### `" : "| `") + key + "`"), std::string::npos) << key;
  }
  EXPECT_GT(keys, 60U);
}

}  // namespace
}  // namespace linewright
