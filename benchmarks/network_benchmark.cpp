// Latency of the network per state: 43 tokens, about 450 numbers, 9 actions. Prints the median and
// the 99th percentile for several sizes and for every instruction set of this machine.
// usage: network_benchmark [STATES]                                          (default: 20000)

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "linewright/base/random.hpp"
#include "linewright/network/network.hpp"

namespace {

using namespace linewright;
using Clock = std::chrono::steady_clock;

std::vector<std::string> names(const std::string& stem, std::size_t count) {
  std::vector<std::string> result;
  for (std::size_t i = 0; i < count; ++i) result.push_back(fmt::format("{}{}", stem, i));
  return result;
}

ObservationSpec line_spec() {
  using Encoder = TokenGroup::Encoder;
  ObservationSpec spec;
  spec.groups.push_back({"human", Encoder::kShared, names("h", 6), {names("f", 13)}});
  spec.groups.push_back({"robot", Encoder::kShared, names("r", 6), {names("f", 11)}});
  spec.groups.push_back({"machines", Encoder::kOwn, names("m", 12), {}});
  for (std::size_t i = 0; i < 12; ++i) spec.groups[2].features.push_back(names("f", 6 + i % 7));
  spec.groups.push_back({"materials", Encoder::kNamed, names("p", 9), {names("f", 6)}});
  spec.groups.push_back({"tasks", Encoder::kNamed, names("t", 9), {names("f", 15)}});
  spec.groups.push_back({"global", Encoder::kOwn, {"global"}, {names("f", 9)}});
  spec.actions = spec.groups[4].tokens;
  return spec;
}

struct Latency {
  double median_us = 0.0;
  double p99_us = 0.0;
};

template <class Work>
Latency measure(std::size_t count, const Work& work) {
  std::vector<double> times_us;
  for (std::size_t i = 0; i < count; ++i) {
    const auto start = Clock::now();
    work(i);
    const std::chrono::duration<double, std::micro> taken = Clock::now() - start;
    times_us.push_back(taken.count());
  }
  std::sort(times_us.begin(), times_us.end());
  return {times_us[count / 2], times_us[count * 99 / 100]};
}

void run_size(const ObservationSpec& spec, const NetworkOptions& options, const std::string& set,
              std::size_t count) {
  Network network(spec, options, initial_tensors(spec, options, 1));
  network.use_instructions(set);
  RandomStream random(1);
  constexpr std::size_t kStates = 64;
  std::vector<float> features(kStates * spec.feature_count());
  for (float& value : features) value = static_cast<float>(random.uniform());
  const std::vector<std::uint8_t> present(spec.token_count(), 1);
  Workspace workspace;
  NetworkOutput output;
  Noise noise = network.make_noise();
  const auto forward = [&](std::size_t i, const Noise* with) {
    const float* state = features.data() + i % kStates * spec.feature_count();
    network.forward(state, present.data(), workspace, with, output);
  };
  const Latency plain = measure(count, [&](std::size_t i) { forward(i, nullptr); });
  const Latency noisy = measure(count, [&](std::size_t i) {
    sample_noise(random, noise);
    forward(i, &noise);
  });
  fmt::print("{:>5} {:>7} {:<8} {:>10.1f} {:>10.1f} {:>15.1f} {:>10.1f}\n", options.width,
             options.encoder_layers, set, plain.median_us, plain.p99_us, noisy.median_us,
             noisy.p99_us);
}

}  // namespace

int main(int argc, char** argv) {
  const int states = argc > 1 ? std::atoi(argv[1]) : 20000;
  const auto count = static_cast<std::size_t>(std::max(states, 1000));
  const ObservationSpec spec = line_spec();
  fmt::print("{} tokens, {} numbers, {} actions, {} states\n", spec.token_count(),
             spec.feature_count(), spec.actions.size(), count);
  fmt::print("width  layers set       median us     p99 us  with noise: med.     p99 us\n");
  for (const std::string& set : Network::instruction_sets()) {
    for (const int width : {32, 64, 128}) {
      for (const int layers : {1, 2}) {
        NetworkOptions options;
        options.width = width;
        options.feedforward = 2 * width;
        options.encoder_layers = layers;
        run_size(spec, options, set, set == "plain" ? count / 100 : count);
      }
    }
  }
  return 0;
}
