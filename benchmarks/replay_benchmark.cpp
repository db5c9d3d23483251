// One step of learning as the replay buffer sees it: draw a batch, gather it, set its priorities.
// Beside it two plain buffers over flat arrays, in the same run: one with the classic binary sum
// tree (differences are propagated), one that adds up all priorities anew for every batch. Run with
// `make bench`. Arguments: transitions, features per observation, batch. Times are medians in
// microseconds: of the whole step (buffer, binary, linear) and of drawing and updating alone
// (choose, choose_binary); draw_ns is one item found by SumTree::find. 1e6 transitions have 200
// features instead of 400, so that the three buffers together stay below 4 GB.

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstring>
#include <vector>

#include "linewright/training/replay_buffer.hpp"

namespace linewright {
namespace {

using Clock = std::chrono::steady_clock;

double microseconds_of(const auto& action) {
  const auto start = Clock::now();
  action();
  return std::chrono::duration<double, std::micro>(Clock::now() - start).count();
}

double median(std::vector<double>& times) {
  if (times.empty()) return 0.0;
  const auto middle = times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2);
  std::nth_element(times.begin(), middle, times.end());
  return *middle;
}

/// The textbook's sum tree: node i has the children 2i + 1 and 2i + 2.
class BinaryTree {
 public:
  explicit BinaryTree(std::size_t leaves) : leaves_(leaves), nodes_(2 * leaves - 1) {}
  void set(std::size_t leaf, double weight) {
    std::size_t node = leaf + leaves_ - 1;
    const double change = weight - nodes_[node];
    nodes_[node] = weight;
    while (node > 0) {
      node = (node - 1) / 2;
      nodes_[node] += change;
    }
  }
  [[nodiscard]] double total() const { return nodes_[0]; }
  [[nodiscard]] double weight(std::size_t leaf) const { return nodes_[leaf + leaves_ - 1]; }
  void prepare() {}
  [[nodiscard]] std::size_t find(double prefix) const {
    std::size_t node = 0;
    while (2 * node + 1 < nodes_.size()) {
      const std::size_t left = 2 * node + 1;
      if (prefix < nodes_[left]) {
        node = left;
      } else {
        prefix -= nodes_[left];
        node = left + 1;
      }
    }
    return node - (leaves_ - 1);
  }

 private:
  std::size_t leaves_;
  std::vector<double> nodes_;
};

/// Running sums over everything, made anew for every batch, as std::discrete_distribution does.
class RunningSums {
 public:
  explicit RunningSums(std::size_t leaves) : weights_(leaves), sums_(leaves) {}
  void set(std::size_t leaf, double weight) { weights_[leaf] = weight; }
  void prepare() {
    double sum = 0.0;
    for (std::size_t i = 0; i < weights_.size(); ++i) sums_[i] = sum += weights_[i];
  }
  [[nodiscard]] double total() const { return sums_.back(); }
  [[nodiscard]] double weight(std::size_t leaf) const { return weights_[leaf]; }
  [[nodiscard]] std::size_t find(double prefix) const {
    const auto found = std::upper_bound(sums_.begin(), sums_.end() - 1, prefix);
    return static_cast<std::size_t>(found - sums_.begin());
  }

 private:
  std::vector<double> weights_;
  std::vector<double> sums_;
};

constexpr std::size_t kTokens = 40;
constexpr std::size_t kActions = 16;
constexpr std::size_t kEpisode = 100;  // decisions

Episode some_episode(std::size_t features, RandomStream& random) {
  Episode episode;
  episode.observation = {features, kTokens, kActions};
  std::vector<float> seen(features);
  for (std::size_t t = 0; t < kEpisode; ++t) {
    for (float& feature : seen) feature = static_cast<float>(random.uniform());
    episode.add(seen, std::vector<std::uint8_t>(kTokens, 1), std::vector<std::uint8_t>(kActions, 1),
                t % kActions);
  }
  return episode;
}

/// What any replay buffer has to do for a step, over flat arrays.
template <class Chooser>
class PlainBuffer {
 public:
  PlainBuffer(std::size_t count, std::size_t features)
      : chooser_(count),
        width_(features),
        features_(count * features, 0.5F),
        flags_(count * (kTokens + kActions), 1),
        count_(count) {
    for (std::size_t i = 0; i < count; ++i) chooser_.set(i, 1.0);
    chooser_.prepare();
  }

  void sample(std::size_t size, double beta, RandomStream& random, ReplayBatch& batch) {
    chooser_.prepare();
    const double part = chooser_.total() / static_cast<double>(size);
    double largest = 0.0;
    for (std::size_t i = 0; i < size; ++i) {
      const std::size_t at = chooser_.find((static_cast<double>(i) + random.uniform()) * part);
      batch.index[i] = at;
      gather(i, at, batch);
      const double chance = chooser_.weight(at) / chooser_.total();
      batch.weight[i] = static_cast<float>(std::pow(static_cast<double>(count_) * chance, -beta));
      largest = std::max(largest, static_cast<double>(batch.weight[i]));
    }
    for (float& weight : batch.weight) weight = static_cast<float>(weight / largest);
  }

  void update(const ReplayBatch& batch, const std::vector<float>& errors) {
    for (std::size_t i = 0; i < batch.size; ++i) {
      chooser_.set(batch.index[i], std::sqrt(std::abs(static_cast<double>(errors[i])) + 1e-6));
    }
  }

 private:
  void gather(std::size_t i, std::size_t at, ReplayBatch& batch) const {
    const std::size_t next = std::min(at + 1, count_ - 1);
    const std::size_t bytes = width_ * sizeof(float);
    std::memcpy(&batch.features[i * width_], &features_[at * width_], bytes);
    std::memcpy(&batch.next_features[i * width_], &features_[next * width_], bytes);
    const std::uint8_t* flags = &flags_[at * (kTokens + kActions)];
    const std::uint8_t* next_flags = &flags_[next * (kTokens + kActions)];
    std::memcpy(&batch.present[i * kTokens], flags, kTokens);
    std::memcpy(&batch.next_present[i * kTokens], next_flags, kTokens);
    std::memcpy(&batch.next_selectable[i * kActions], next_flags + kTokens, kActions);
  }

  Chooser chooser_;
  std::size_t width_;
  std::vector<float> features_;
  std::vector<std::uint8_t> flags_;
  std::size_t count_;
};

/// Drawing and setting priorities without any observation; microseconds per batch.
template <class Draw, class Update>
double choosing(std::size_t batch, double total, const Draw& draw, const Update& update) {
  RandomStream random(2);
  std::vector<double> prefixes(batch);
  std::vector<std::size_t> found(batch);
  std::vector<float> weights(batch);
  std::vector<double> times;
  for (int round = 0; round < 500; ++round) {
    for (float& weight : weights) weight = static_cast<float>(random.uniform());
    times.push_back(microseconds_of([&] {
      const double part = total / 2.0 / static_cast<double>(batch);  // the total shrinks with time
      for (std::size_t i = 0; i < batch; ++i) {
        prefixes[i] = (static_cast<double>(i) + random.uniform()) * part;
      }
      draw(prefixes, found);
      update(found, weights);
    }));
  }
  return median(times);
}

/// Nanoseconds per item drawn, 512 at a time.
double drawing(const SumTree& tree) {
  RandomStream random(5);
  std::vector<double> prefixes(512);
  std::vector<std::size_t> found(512);
  std::vector<double> times;
  for (int round = 0; round < 2000; ++round) {
    times.push_back(microseconds_of([&] {
      for (double& prefix : prefixes) prefix = random.uniform() * tree.total();
      tree.find(prefixes, found);
    }));
  }
  return median(times) * 1000.0 / 512.0;
}

void compare_choosing(benchmark::State& run, std::size_t count, std::size_t batch) {
  SumTree tree(count);
  BinaryTree binary(count);
  RandomStream random(3);
  for (std::size_t i = 0; i < count; ++i) {
    const auto weight = static_cast<float>(0.5 + random.uniform());
    tree.set(i, weight);
    binary.set(i, static_cast<double>(weight));
  }
  run.counters["draw_ns"] = drawing(tree);
  run.counters["choose"] = choosing(
      batch, tree.total(), [&](auto& prefixes, auto& found) { tree.find(prefixes, found); },
      [&](const auto& found, const auto& weights) { tree.set(found, weights); });
  run.counters["choose_binary"] = choosing(
      batch, binary.total(),
      [&](auto& prefixes, auto& found) {
        for (std::size_t i = 0; i < found.size(); ++i) found[i] = binary.find(prefixes[i]);
      },
      [&](const auto& found, const auto& weights) {
        for (std::size_t i = 0; i < found.size(); ++i) {
          binary.set(found[i], static_cast<double>(weights[i]));
        }
      });
}

void replay_step(benchmark::State& run) {
  const auto count = static_cast<std::size_t>(run.range(0));
  const auto features = static_cast<std::size_t>(run.range(1));
  const auto size = static_cast<std::size_t>(run.range(2));
  RandomStream random(1);
  PrioritizedReplayBuffer buffer({features, kTokens, kActions}, {.capacity = count});
  for (std::size_t i = 0; i < count / kEpisode; ++i)
    buffer.insert(some_episode(features, random), 1);
  PlainBuffer<BinaryTree> binary(count, features);
  PlainBuffer<RunningSums> linear(count, features);
  ReplayBatch batch;
  std::vector<float> errors(size);
  std::vector<double> ours;
  std::vector<double> of_binary;
  std::vector<double> of_linear;
  for (auto _ : run) {
    for (float& error : errors) error = static_cast<float>(random.uniform());
    ours.push_back(microseconds_of([&] {
      buffer.sample(size, 0.5, random, batch);
      buffer.update_priorities(batch.index, errors);
    }));
    of_binary.push_back(microseconds_of([&] {
      binary.sample(size, 0.5, random, batch);
      binary.update(batch, errors);
    }));
    if (of_linear.size() * 20 > ours.size()) continue;  // it would take most of the time
    of_linear.push_back(microseconds_of([&] {
      linear.sample(size, 0.5, random, batch);
      linear.update(batch, errors);
    }));
  }
  const double time = median(ours);
  run.counters["buffer"] = time;
  run.counters["binary"] = median(of_binary);
  run.counters["linear"] = median(of_linear);
  run.counters["ratio_binary"] = median(of_binary) / time;
  run.counters["ratio_linear"] = median(of_linear) / time;
  compare_choosing(run, count, size);
}
BENCHMARK(replay_step)
    ->Args({100'000, 400, 64})
    ->Args({100'000, 400, 512})
    ->Args({1'000'000, 200, 64})
    ->Args({1'000'000, 200, 512})
    ->Iterations(2000)
    ->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace linewright

BENCHMARK_MAIN();
