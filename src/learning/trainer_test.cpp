#include "linewright/learning/trainer.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <stdexcept>

#include "checkpoint.hpp"
#include "linewright/base/diagnostic.hpp"
#include "linewright/evaluation/trials.hpp"
#include "linewright/scenario/load.hpp"

namespace linewright {
namespace {

namespace fs = std::filesystem;

const std::string kRoot = LINEWRIGHT_SOURCE_DIR;

const Scenario& oven() {
  static const Scenario kOven = load_scenario(kRoot + "/tests/data/learning/oven.yaml");
  return kOven;
}

/// A folder that is empty now and goes away at the end.
class Folder {
 public:
  explicit Folder(const std::string& name)
      : path_(fs::temp_directory_path() / (name + "." + std::to_string(getpid()))) {
    fs::remove_all(path_);
  }
  ~Folder() { fs::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  [[nodiscard]] std::string path() const { return path_.string(); }
  [[nodiscard]] std::string text(const std::string& file) const {
    std::ifstream stream(path_ / file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  void write(const std::string& file, const std::string& bytes) const {
    std::ofstream(path_ / file, std::ios::binary) << bytes;
  }

 private:
  fs::path path_;
};

/// An algorithm of the repository, in a size that learns the oven in seconds.
TrainingOptions toy_options(const std::string& algorithm, std::vector<std::string> more = {}) {
  std::vector<std::string> settings{"network.width=16",
                                    "network.heads=1",
                                    "network.feedforward=16",
                                    "network.head_hidden=16",
                                    "reward.eta1=0.01",
                                    "optimizer.batch=32",
                                    "optimizer.warmup=200",
                                    "optimizer.updates=600",
                                    "optimizer.learning_rate=0.003",
                                    "optimizer.learning_rate_end=0.0003",
                                    "optimizer.target_every=25",
                                    "optimizer.average=0.9",
                                    "optimizer.decisions_per_update=8",
                                    "exploration.epsilon_decisions=2000",
                                    "ppo.episodes_per_update=16",
                                    "ppo.minibatch=64",
                                    "run.environments=8",
                                    "run.threads=1",
                                    "run.evaluate_every=50",
                                    "run.evaluation_trials=1",
                                    "run.checkpoint_every=100"};
  settings.insert(settings.end(), more.begin(), more.end());
  return load_training_options(kRoot + "/algorithms/" + algorithm + ".yaml", {}, settings);
}

TrainingHooks no_clock() {
  return {.wall_time_s = [] { return 0.0; }};
}

/// The smallest makespan that any sequence of decisions reaches from here.
Tick optimum(const Simulator& simulator, SimulationState state, Allocator& allocator) {
  if (simulator.advance(state) != RunStatus::kDecision) {
    return state.status == RunStatus::kFinished ? state.now : state.horizon;
  }
  Tick least = state.horizon;
  for (std::size_t t = 0; t < simulator.line().tasks.size(); ++t) {
    if (!state.is_selectable(TaskId(t))) continue;
    SimulationState next = state;
    simulator.assign(next, allocator.allocate(next, TaskId(t)));
    least = std::min(least, optimum(simulator, std::move(next), allocator));
  }
  return least;
}

class EveryAlgorithm : public ::testing::TestWithParam<const char*> {};

TEST_P(EveryAlgorithm, LearnsTheOptimumOfASmallLine) {
  const Simulator simulator(std::make_shared<const LineModel>(oven().line));
  const auto allocator = make_allocator("sap", simulator);
  SimulationState start;
  simulator.reset(start, sample_setup(oven().line, {}, 1));
  const Tick best = optimum(simulator, start, *allocator);

  const Folder folder(std::string("oven_") + GetParam());
  const TrainingResult result = train(
      {.scenario = &oven(), .options = toy_options(GetParam()), .seed = 1, .folder = folder.path()},
      no_clock());
  ASSERT_TRUE(result.finished);
  ASSERT_TRUE(result.status.best.has_value());
  EXPECT_EQ(result.status.best->makespan, best);

  // And the file is a planner that does it without LibTorch.
  const Configuration configuration{.planner = "policy:" + result.best_policy};
  const auto trials =
      run_trials(oven(), configuration, {.crews = {RunOptions{}}, .trials = 2, .threads = 1});
  EXPECT_EQ(trials[0][0].makespan, best);
}

INSTANTIATE_TEST_SUITE_P(Learning, EveryAlgorithm,
                         ::testing::Values("d3qn", "no-modify", "edqn1", "edqn2", "ebq-g", "ebq-n",
                                           "ebq-gn", "eppo"));

/// Trains until the program "dies" after `updates` updates, without a chance to save anything.
void train_and_die(TrainingRun run, std::int64_t updates) {
  TrainingHooks hooks = no_clock();
  hooks.progress = [&](const TrainingStatus& status) {
    if (status.updates >= updates) throw std::runtime_error("killed");
  };
  EXPECT_THROW(static_cast<void>(train(run, hooks)), std::runtime_error);
}

void expect_same_after_resuming(const std::string& algorithm) {
  const TrainingOptions options =
      toy_options(algorithm, {"optimizer.updates=300", "run.checkpoint_every=60"});
  const Folder whole("whole_" + algorithm);
  const Folder broken("broken_" + algorithm);
  TrainingRun run{.scenario = &oven(), .options = options, .seed = 3, .folder = whole.path()};
  ASSERT_TRUE(train(run, no_clock()).finished);

  run.folder = broken.path();
  train_and_die(run, 170);
  run.resume = true;
  TrainingHooks cancelling = no_clock();
  CancelToken cancel;  // and once more, politely
  cancelling.cancel = &cancel;
  cancelling.progress = [&](const TrainingStatus& status) {
    if (status.updates >= 230) cancel.request();
  };
  EXPECT_FALSE(train(run, cancelling).finished);
  ASSERT_TRUE(train(run, no_clock()).finished);

  for (const char* file : {"final.safetensors", "best.safetensors", "progress.csv",
                           "evaluations.csv", "events.out.tfevents.0.linewright"}) {
    EXPECT_EQ(whole.text(file), broken.text(file)) << file;
    EXPECT_FALSE(whole.text(file).empty()) << file;
  }
}

TEST(Training, GivesTheSameBytesForAnyNumberOfThreads) {
  for (const char* algorithm : {"ebq-n", "eppo"}) {
    const Folder one(std::string("one_thread_") + algorithm);
    const Folder three(std::string("three_threads_") + algorithm);
    // Batches of two whole slices and a part of one.
    TrainingOptions options = toy_options(
        algorithm, {"optimizer.updates=60", "optimizer.batch=160", "ppo.minibatch=160"});
    for (const Folder* folder : {&one, &three}) {
      options.run.threads = folder == &one ? 1 : 3;
      ASSERT_TRUE(
          train({.scenario = &oven(), .options = options, .folder = folder->path()}, no_clock())
              .finished);
    }
    for (const char* file : {"final.safetensors", "progress.csv", "options.yaml"}) {
      EXPECT_EQ(one.text(file), three.text(file)) << algorithm << " " << file;
      EXPECT_FALSE(one.text(file).empty()) << file;
    }
  }
}

TEST(Resuming, GivesTheSameBytesAsAnUninterruptedRun) { expect_same_after_resuming("ebq-gn"); }

TEST(Resuming, GivesTheSameBytesForPpo) { expect_same_after_resuming("eppo"); }

/// What resuming says after `spoil` was at work in the folder of a run.
std::string refusal(const std::function<void(const Folder&, TrainingRun&)>& spoil) {
  const Folder folder("refusal");
  TrainingRun run{
      .scenario = &oven(),
      .options = toy_options("ebq-n", {"optimizer.updates=80", "run.checkpoint_every=40"}),
      .seed = 1,
      .folder = folder.path()};
  train_and_die(run, 50);
  run.resume = true;
  spoil(folder, run);
  try {
    static_cast<void>(train(run, no_clock()));
  } catch (const ScenarioError& error) {
    return error.what();
  }
  return "no refusal";
}

TEST(Resuming, RefusesWhatIsNotItsCheckpoint) {
  const auto expect = [](const std::string& text, const std::string& part) {
    EXPECT_NE(text.find(part), std::string::npos) << text;
  };
  expect(refusal([](const Folder& folder, TrainingRun&) {
           const std::string bytes = folder.text("checkpoint.bin");
           folder.write("checkpoint.bin", bytes.substr(0, bytes.size() / 2));
         }),
         "is cut off or damaged");
  expect(refusal([](const Folder& folder, TrainingRun&) {
           std::string bytes = folder.text("checkpoint.bin");
           bytes[12] = '0';  // the version
           folder.write("checkpoint.bin", bytes);
         }),
         "another version");
  expect(refusal([](const Folder& folder, TrainingRun&) { folder.write("checkpoint.bin", "hi"); }),
         "is not a checkpoint");
  expect(refusal([](const Folder& folder, TrainingRun&) {
           fs::remove(folder.path() + "/checkpoint.bin");
         }),
         "there is nothing to resume");
  expect(refusal([](const Folder&, TrainingRun& run) { run.seed = 2; }), "seed 1, not 2");
  expect(refusal([](const Folder&, TrainingRun& run) { run.options.optimizer.batch = 33; }),
         "other options");
}

TEST(Training, StopsWhenTheLossIsNoNumberAndKeepsTheLastCheckpoint) {
  const Folder folder("not_a_number");
  TrainingRun run{.scenario = &oven(),
                  .options = toy_options("ebq-n", {"run.checkpoint_every=40"}),
                  .seed = 1,
                  .folder = folder.path()};
  train_and_die(run, 50);
  const std::string file = folder.path() + "/checkpoint.bin";
  learning::Checkpoint checkpoint =
      learning::checkpoint_from_bytes(folder.text("checkpoint.bin"), file);
  checkpoint.learner.parameters[0] = std::numeric_limits<float>::quiet_NaN();
  const std::string spoilt = learning::to_bytes(checkpoint);
  folder.write("checkpoint.bin", spoilt);
  run.resume = true;
  try {
    static_cast<void>(train(run, no_clock()));
    FAIL() << "no refusal";
  } catch (const ScenarioError& error) {
    EXPECT_NE(std::string(error.what()).find("update 41 of 600"), std::string::npos)
        << error.what();
  }
  EXPECT_EQ(folder.text("checkpoint.bin"), spoilt);
}

TEST(Training, SaysWhereItCannotWrite) {
  TrainingRun run{.scenario = &oven(), .options = toy_options("ebq-n"), .folder = "/proc/nowhere"};
  EXPECT_THROW(static_cast<void>(train(run, no_clock())), ScenarioError);
}

TEST(Training, RefusesAHorizonThatIsTooShortForTheOrder) {
  const Folder folder("short_horizon");
  TrainingRun run{.scenario = &oven(),
                  .options = toy_options("ebq-n", {"run.horizon=50"}),
                  .folder = folder.path()};
  try {
    static_cast<void>(train(run, no_clock()));
    FAIL() << "no refusal";
  } catch (const ScenarioError& error) {
    EXPECT_NE(std::string(error.what()).find("50 ticks"), std::string::npos) << error.what();
  }
}

TEST(TrainingCrews, AreAllCombinationsWithTheirHorizons) {
  const Scenario duct = load_scenario(kRoot + "/scenarios/duct_line.yaml");
  RunSettings settings;
  settings.order = 4;
  settings.horizon = {{{{"human", 1}}, 1250}, {{}, 1000}};
  const std::vector<RunOptions> crews = training_crews(duct, settings);
  ASSERT_EQ(crews.size(), 9U);
  EXPECT_EQ(crews[2].workers, (std::vector<std::optional<std::int32_t>>{1, 3}));
  EXPECT_EQ(crews[2].horizon, 1250);
  EXPECT_EQ(crews[3].horizon, 1000);
  EXPECT_EQ(crews[3].order, 4);
}

TEST(TrainingCrews, HaveAHorizonInProportionToTheRuleThatTakesTheFirstTask) {
  RunSettings settings;
  EXPECT_EQ(training_crews(oven(), settings)[0].horizon, 278);  // 1.25 * 222, rounded up
  settings.horizon_factor = 10.0;
  EXPECT_EQ(training_crews(oven(), settings)[0].horizon, 400);  // the scenario's
  settings.horizon_factor = 0.0;
  EXPECT_EQ(training_crews(oven(), settings)[0].horizon, std::nullopt);
}

}  // namespace
}  // namespace linewright
