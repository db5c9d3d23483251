// What learning costs, in one run: decisions of the environment, one update of the Q-learner by
// size, batch and threads beside the same network in PyTorch (where python3-torch is installed),
// and the latency of one decision, plain and by LibTorch. The replay buffer has replay_benchmark.
// usage: learning_benchmark [UPDATES]                                               (default: 20)

#include <fmt/format.h>
#include <malloc.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "../src/learning/duct_line.hpp"
#include "../src/learning/torch_network.hpp"
#include "../src/learning/torch_values.hpp"
#include "linewright/environment/vector_environment.hpp"
#include "linewright/learning/q_learner.hpp"
#include "linewright/learning/runtime.hpp"

namespace {

using namespace linewright;
using Clock = std::chrono::steady_clock;

constexpr const char* kScenario = LINEWRIGHT_SOURCE_DIR "/scenarios/duct_line.yaml";

double milliseconds(Clock::duration time) {
  return std::chrono::duration<double, std::milli>(time).count();
}

double share_of(std::vector<double>& times, double share) {
  std::sort(times.begin(), times.end());
  return times[static_cast<std::size_t>(share * static_cast<double>(times.size() - 1))];
}

void measure_environment(std::size_t threads) {
  const Simulator simulator(std::make_shared<const LineModel>(load_scenario(kScenario).line));
  EpisodePlan plan;
  plan.crews.resize(1);
  WorkerPool pool(threads);
  constexpr std::size_t kRuns = 64;
  VectorEnvironment environments(simulator, plan, "sap", {}, kRuns, pool);
  const ObservationSpec& spec = environments.spec();
  std::vector<float> features(kRuns * spec.feature_count());
  std::vector<std::uint8_t> present(kRuns * spec.token_count());
  std::vector<std::uint8_t> selectable(kRuns * spec.actions.size());
  const ObservationRows rows{features.data(), present.data(), selectable.data()};
  environments.reset(rows);
  std::vector<RandomStream> random;
  for (std::uint64_t i = 0; i < kRuns; ++i) random.push_back(RandomStream::derive(1, "run", i));
  const std::size_t actions = spec.actions.size();
  constexpr int kSteps = 10'000;
  const auto start = Clock::now();
  for (int step = 0; step < kSteps; ++step) {
    environments.step(
        [&](std::size_t run, std::size_t, ObservationView view) {
          std::size_t action = random[run].below(actions);
          while (view.selectable[action] == 0) action = random[run].below(actions);
          return action;
        },
        rows);
  }
  const double seconds = milliseconds(Clock::now() - start) / 1000.0;
  fmt::print("environment, random policy, with observations, {} thread(s): {:.0f} decisions/s\n",
             threads, kSteps * static_cast<double>(kRuns) / seconds);
}

ReplayBatch batch_of(const learning::SeenStates& seen, std::size_t rows) {
  const auto part = [&](const auto& column, std::size_t first) {
    const std::size_t width = column.size() / seen.count;
    return std::vector(column.begin() + static_cast<std::ptrdiff_t>(first * width),
                       column.begin() + static_cast<std::ptrdiff_t>((first + rows) * width));
  };
  ReplayBatch batch;
  batch.size = rows;
  batch.features = part(seen.features, 0);
  batch.present = part(seen.present, 0);
  batch.next_features = part(seen.features, 1);
  batch.next_present = part(seen.present, 1);
  batch.next_selectable = part(seen.selectable, 1);
  for (std::size_t i = 0; i < rows; ++i) {
    const std::size_t actions = seen.spec.actions.size();
    const std::uint8_t* selectable = seen.selectable.data() + i * actions;
    batch.action.push_back(std::find(selectable, selectable + actions, 1) - selectable);
  }
  batch.returns.assign(rows, 0.1F);
  batch.discount.assign(rows, 0.99F);
  batch.weight.assign(rows, 1.0F);
  return batch;
}

double median_update(const learning::SeenStates& seen, const NetworkOptions& options,
                     std::size_t rows, std::size_t threads, int updates) {
  QLearner learner(seen.spec, options, initial_tensors(seen.spec, options, 1), {.threads = threads},
                   1);
  const ReplayBatch batch = batch_of(seen, rows);
  std::vector<float> errors;
  std::vector<double> times;
  for (int i = 0; i < updates + 3; ++i) {
    const auto start = Clock::now();
    learner.update(batch, 1e-4, errors);
    if (i >= 3) times.push_back(milliseconds(Clock::now() - start));
  }
  return share_of(times, 0.5);
}

/// The python3 that Debian's python3-torch belongs to, unless PYTHON names another.
constexpr const char* kPython = "${PYTHON:-/usr/bin/python3}";

bool has_pytorch() {
  return std::system(fmt::format("{} -c 'import torch' 2>/dev/null", kPython).c_str()) == 0;
}

/// The same in PyTorch.
double median_update_of_pytorch(const ObservationSpec& spec, int width, std::size_t rows,
                                std::size_t threads, int updates) {
  std::string groups;
  for (const TokenGroup& group : spec.groups) {
    std::size_t most = 0;
    for (std::size_t t = 0; t < group.tokens.size(); ++t) {
      most = std::max(most, group.features_of(t).size());
    }
    const char* encoder = group.encoder == TokenGroup::Encoder::kShared  ? "shared"
                          : group.encoder == TokenGroup::Encoder::kNamed ? "named"
                                                                         : "own";
    groups += fmt::format("{}{}:{}:{}:{}", groups.empty() ? "" : ",", group.name,
                          group.tokens.size(), most, encoder);
  }
  const std::string command = fmt::format(
      "{} " LINEWRIGHT_SOURCE_DIR "/benchmarks/learning/torch_update.py '{}' {} {} {} {} {}",
      kPython, groups, spec.actions.size(), width, rows, threads, updates);
  std::FILE* pipe = popen(command.c_str(), "r");
  double median = 0.0;
  if (pipe == nullptr) return median;
  if (std::fscanf(pipe, "%lf", &median) != 1) median = 0.0;
  pclose(pipe);
  return median;
}

void measure_updates(const learning::SeenStates& seen, int updates) {
  fmt::print("\none update, median of {}\n{:>6} {:>6} {:>6} {:>8} {:>9} {:>10} {:>11} {:>6}\n",
             updates, "width", "layers", "batch", "threads", "ms", "us/sample", "PyTorch ms",
             "ratio");
  const bool pytorch = has_pytorch();
  if (!pytorch)
    fmt::print(
        "no PyTorch to compare with: install python3-torch, or set PYTHON to a Python with "
        "torch\n");
  for (const std::size_t threads : {1, 2}) {
    prepare_learning(threads);
    for (const int width : {32, 64, 128}) {
      for (const int layers : {1, 2}) {
        for (const std::size_t rows : {64, 128, 512}) {
          const NetworkOptions options{
              .width = width, .encoder_layers = layers, .feedforward = 2 * width};
          const double ms = median_update(seen, options, rows, threads, updates);
          const double theirs =
              pytorch && layers == 1
                  ? median_update_of_pytorch(seen.spec, width, rows, threads, updates)
                  : 0.0;
          fmt::print("{:>6} {:>6} {:>6} {:>8} {:>9.2f} {:>10.0f} {:>11} {:>6}\n", width, layers,
                     rows, threads, ms, 1000.0 * ms / static_cast<double>(rows),
                     theirs > 0.0 ? fmt::format("{:.2f}", theirs) : "-",
                     theirs > 0.0 ? fmt::format("{:.1f}", theirs / ms) : "-");
          std::fflush(stdout);
        }
      }
    }
  }
}

template <class Forward>
void measure_latency(const char* who, std::size_t states, Forward&& forward) {
  std::vector<double> times;
  for (std::size_t i = 0; i < states; ++i) {
    const auto start = Clock::now();
    forward(i);
    times.push_back(1000.0 * milliseconds(Clock::now() - start));
  }
  const double p50 = share_of(times, 0.5);
  fmt::print("one decision, {}: p50 {:.0f} us, p99 {:.0f} us\n", who, p50, share_of(times, 0.99));
}

void measure_inference(const learning::SeenStates& seen) {
  prepare_learning(1);
  const NetworkOptions options;
  const TensorMap tensors = initial_tensors(seen.spec, options, 1);
  const Network plain(seen.spec, options, tensors);
  Workspace workspace;
  NetworkOutput output;
  fmt::print("\n");
  measure_latency("plain code", seen.count, [&](std::size_t i) {
    plain.forward(seen.features.data() + i * seen.spec.feature_count(),
                  seen.present.data() + i * seen.spec.token_count(), workspace, nullptr, output);
  });
  const learning::TorchNetwork torch_network(seen.spec, options, tensors, torch::kCPU);
  const auto rows = static_cast<std::int64_t>(seen.count);
  const torch::Tensor features = learning::rows_of(seen.features, rows, torch::kCPU);
  const torch::Tensor present = learning::rows_of(seen.present, rows, torch::kCPU);
  measure_latency("LibTorch", seen.count, [&](std::size_t i) {
    const torch::NoGradGuard no_gradient;
    const auto row = static_cast<std::int64_t>(i);
    static_cast<void>(
        torch_network.forward(features.narrow(0, row, 1), present.narrow(0, row, 1), nullptr));
  });
}

}  // namespace

int main(int argc, char** argv) {
  mallopt(M_MMAP_THRESHOLD, 1 << 30);
  mallopt(M_TRIM_THRESHOLD, 1 << 30);
  mallopt(M_TOP_PAD, 64 << 20);
  const int updates = argc > 1 ? std::max(1, std::atoi(argv[1])) : 20;
  const auto seen = learning::random_states(kScenario, 2'000, 1);
  const LearningRuntime runtime = prepare_learning(1);
  fmt::print("duct line: {} tokens, {} features; LibTorch {} on {}, matrices by {}\n\n",
             seen.spec.token_count(), seen.spec.feature_count(), runtime.torch_version,
             runtime.device, runtime.blas);
  for (const std::size_t threads : {1, 2}) measure_environment(threads);
  measure_inference(seen);
  measure_updates(seen, updates);
}
