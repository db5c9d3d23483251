#include "linewright/network/network.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <thread>

#include "linewright/base/diagnostic.hpp"
#include "linewright/base/hash.hpp"
#include "reference_network.hpp"
#include "small_spec.hpp"

namespace linewright {
namespace {

using testing_network::line_spec;
using testing_network::random_state;
using testing_network::random_tensors;
using testing_network::small_spec;
using testing_network::State;
using Query = NetworkOptions::Query;

NetworkOptions small_options() {
  NetworkOptions options;
  options.width = 16;
  options.feedforward = 24;
  options.head_hidden = 12;
  return options;
}

/// The options that the network is compared with the reference for.
std::vector<NetworkOptions> option_combinations() {
  std::vector<NetworkOptions> all;
  const auto add = [&all](auto change) {
    NetworkOptions options = small_options();
    change(options);
    all.push_back(options);
  };
  for (const int heads : {1, 2, 4}) {
    for (const int layers : {0, 1, 2}) {
      add([&](NetworkOptions& o) { o.heads = heads, o.encoder_layers = layers; });
    }
  }
  for (const Query query : {Query::kPerTask, Query::kSingle}) {
    add([&](NetworkOptions& o) { o.query = query, o.noisy = false; });
    add([&](NetworkOptions& o) { o.query = query, o.actor_critic = true; });
    add([&](NetworkOptions& o) { o.query = query, o.dueling = false; });
    add([&](NetworkOptions& o) { o.query = query, o.width = 40, o.heads = 2; });  // 20 per head
    add([&](NetworkOptions& o) { o.query = query, o.width = 6, o.heads = 3, o.head_hidden = 33; });
  }
  return all;
}

std::string title(const NetworkOptions& options) { return to_json(options); }

/// Runs `count` random states, with and without noise, through network and reference.
void compare_with_reference(const ObservationSpec& spec, const NetworkOptions& options, int count) {
  const TensorMap tensors = random_tensors(spec, options, 7);
  const Network network(spec, options, tensors);
  const reference::ReferenceNetwork plain(spec, options, tensors);
  RandomStream random(11);
  Workspace workspace;
  NetworkOutput output;
  Noise noise = network.make_noise();
  for (int i = 0; i < count; ++i) {
    const State state = random_state(spec, random);
    sample_noise(random, noise);
    const Noise* with = options.noisy && i % 2 == 1 ? &noise : nullptr;
    network.forward(state.features.data(), state.present.data(), workspace, with, output);
    const auto expected = plain.run(state.features.data(), state.present.data(), with);
    ASSERT_EQ(output.actions.size(), expected.actions.size());
    for (std::size_t a = 0; a < expected.actions.size(); ++a) {
      const double e = expected.actions[a];
      ASSERT_NEAR(output.actions[a], e, 1e-5 * std::max(1.0, std::abs(e))) << i << " " << a;
    }
    ASSERT_NEAR(output.value, expected.value, 1e-5 * std::max(1.0, std::abs(expected.value)));
  }
}

TEST(Network, AgreesWithTheReferenceForAllOptions) {
  for (const NetworkOptions& options : option_combinations()) {
    SCOPED_TRACE(title(options));
    compare_with_reference(small_spec(), options, 150);
  }
}

TEST(Network, AgreesWithTheReferenceAtTheSizeOfALine) {
  compare_with_reference(line_spec(), {}, 30);
}

TEST(Network, AgreesWithTheReferenceOnTheSmallestLine) {
  ObservationSpec spec;
  spec.groups = {{"materials", TokenGroup::Encoder::kNamed, {}, {{"f"}}},
                 {"tasks", TokenGroup::Encoder::kNamed, {"t"}, {{"f"}}},
                 {"global", TokenGroup::Encoder::kOwn, {"global"}, {{}}}};
  spec.actions = {"t"};
  for (NetworkOptions options : option_combinations()) {
    SCOPED_TRACE(title(options));
    compare_with_reference(spec, options, 4);
  }
}

std::vector<std::uint32_t> bits_of(const NetworkOutput& output) {
  std::vector<std::uint32_t> bits = {std::bit_cast<std::uint32_t>(output.value)};
  for (const float a : output.actions) bits.push_back(std::bit_cast<std::uint32_t>(a));
  return bits;
}

/// The bits of the outputs for some states, noise included.
std::vector<std::uint32_t> bits_of_run(const Network& network, const ObservationSpec& spec,
                                       int count) {
  RandomStream random(5);
  Workspace workspace;
  NetworkOutput output;
  Noise noise = network.make_noise();
  std::vector<std::uint32_t> all;
  for (int i = 0; i < count; ++i) {
    const State state = random_state(spec, random);
    sample_noise(random, noise);
    network.forward(state.features.data(), state.present.data(), workspace, &noise, output);
    const auto bits = bits_of(output);
    all.insert(all.end(), bits.begin(), bits.end());
  }
  return all;
}

TEST(Network, GivesTheSameBitsOnEveryInstructionSet) {
  std::vector<NetworkOptions> all = option_combinations();
  all.push_back({});
  for (const NetworkOptions& options : all) {
    SCOPED_TRACE(title(options));
    const ObservationSpec spec = small_spec();
    Network network(spec, options, random_tensors(spec, options, 3));
    const auto fastest = bits_of_run(network, spec, 4);
    for (const std::string& set : Network::instruction_sets()) {
      network.use_instructions(set);
      ASSERT_EQ(bits_of_run(network, spec, 4), fastest) << set;
    }
  }
}

TEST(Network, GivesTheBitsThatItGaveOnOtherMachines) {
  const ObservationSpec spec = line_spec();
  const NetworkOptions options{
      .width = 64, .heads = 4, .feedforward = 128, .head_hidden = 64, .sigma0 = 0.5};
  const Network network(spec, options, random_tensors(spec, options, 1));
  std::uint64_t hash = kHashStart;
  for (const std::uint32_t bits : bits_of_run(network, spec, 20)) {
    for (const unsigned shift : {0U, 8U, 16U, 24U}) {
      const char byte = static_cast<char>((bits >> shift) & 0xffU);
      hash = hash_of({&byte, 1}, hash);
    }
  }
  EXPECT_EQ(hash, 4400602809284158371ULL)
      << "weights, noise or arithmetic changed: trained policies now act otherwise";
}

TEST(Network, IgnoresWhatAbsentTokensHold) {
  const ObservationSpec spec = small_spec();
  const Network network(spec, small_options(), random_tensors(spec, small_options(), 1));
  RandomStream random(2);
  Workspace workspace;
  NetworkOutput with_zeros;
  NetworkOutput with_garbage;
  for (int i = 0; i < 200; ++i) {
    State state = random_state(spec, random);
    network.forward(state.features.data(), state.present.data(), workspace, nullptr, with_zeros);
    std::size_t at = 0;
    std::size_t token = 0;
    for (const TokenGroup& group : spec.groups) {
      for (std::size_t t = 0; t < group.tokens.size(); ++t, ++token) {
        for (std::size_t f = 0; f < group.features_of(t).size(); ++f, ++at) {
          if (state.present[token] == 0) state.features[at] = f % 2 == 0 ? NAN : 1e30F;
        }
      }
    }
    network.forward(state.features.data(), state.present.data(), workspace, nullptr, with_garbage);
    ASSERT_EQ(bits_of(with_zeros), bits_of(with_garbage));
  }
}

TEST(Network, TakesAllTasksForPresent) {
  const ObservationSpec spec = small_spec();
  const Network network(spec, small_options(), random_tensors(spec, small_options(), 1));
  RandomStream random(2);
  State state = random_state(spec, random);
  Workspace workspace;
  NetworkOutput some;
  NetworkOutput none;
  std::fill(state.present.begin(), state.present.end(), std::uint8_t{0});
  network.forward(state.features.data(), state.present.data(), workspace, nullptr, none);
  const std::size_t first_task = spec.token_count() - 1 - spec.actions.size();
  state.present[first_task + 2] = 1;
  network.forward(state.features.data(), state.present.data(), workspace, nullptr, some);
  EXPECT_EQ(bits_of(some), bits_of(none));
}

TEST(Network, DoesNotDependOnTheOrderOfInterchangeableTokens) {
  const ObservationSpec spec = small_spec();
  const Network network(spec, small_options(), random_tensors(spec, small_options(), 1));
  RandomStream random(3);
  Workspace workspace;
  NetworkOutput before;
  NetworkOutput after;
  const auto per_token = static_cast<std::ptrdiff_t>(spec.groups[0].features_of(0).size());
  for (int i = 0; i < 200; ++i) {
    State state = random_state(spec, random);
    network.forward(state.features.data(), state.present.data(), workspace, nullptr, before);
    const auto first = state.features.begin();
    std::rotate(first, first + per_token, first + 3 * per_token);
    std::rotate(state.present.begin(), state.present.begin() + 1, state.present.begin() + 3);
    network.forward(state.features.data(), state.present.data(), workspace, nullptr, after);
    for (std::size_t a = 0; a < before.actions.size(); ++a) {
      ASSERT_NEAR(before.actions[a], after.actions[a], 1e-5);
    }
  }
}

TEST(Network, IgnoresNoiseThatIsZero) {
  const ObservationSpec spec = small_spec();
  const Network network(spec, small_options(), random_tensors(spec, small_options(), 1));
  RandomStream random(3);
  const State state = random_state(spec, random);
  const Noise zero = network.make_noise();
  Workspace workspace;
  NetworkOutput without;
  NetworkOutput with;
  network.forward(state.features.data(), state.present.data(), workspace, nullptr, without);
  network.forward(state.features.data(), state.present.data(), workspace, &zero, with);
  EXPECT_EQ(bits_of(without), bits_of(with));
}

TEST(Network, RunsInManyThreadsAtOnce) {
  const ObservationSpec spec = small_spec();
  const Network network(spec, small_options(), random_tensors(spec, small_options(), 1));
  const auto expected = bits_of_run(network, spec, 50);
  std::vector<std::vector<std::uint32_t>> found(4);
  std::vector<std::thread> threads;
  threads.reserve(found.size());
  for (auto& bits : found) {
    threads.emplace_back([&] { bits = bits_of_run(network, spec, 50); });
  }
  for (std::thread& thread : threads) thread.join();
  for (const auto& bits : found) EXPECT_EQ(bits, expected);
}

TEST(Network, SharesAWorkspaceBetweenNetworksOfAnySize) {
  const ObservationSpec large = line_spec();
  const ObservationSpec small = small_spec();
  const Network wide(large, {}, random_tensors(large, {}, 1));
  const Network narrow(small, small_options(), random_tensors(small, small_options(), 1));
  RandomStream random(4);
  const State large_state = random_state(large, random);
  const State small_state = random_state(small, random);
  Workspace shared;
  Workspace fresh;
  NetworkOutput first;
  NetworkOutput second;
  narrow.forward(small_state.features.data(), small_state.present.data(), fresh, nullptr, first);
  wide.forward(large_state.features.data(), large_state.present.data(), shared, nullptr, second);
  narrow.forward(small_state.features.data(), small_state.present.data(), shared, nullptr, second);
  EXPECT_EQ(bits_of(first), bits_of(second));
}

TEST(Network, SurvivesWeightsThatOverflow) {
  const ObservationSpec spec = small_spec();
  TensorMap tensors = random_tensors(spec, small_options(), 1);
  for (auto& [name, tensor] : tensors) {
    for (float& value : tensor.values) value *= 3e38F;
  }
  const Network network(spec, small_options(), tensors);
  RandomStream random(4);
  const State state = random_state(spec, random);
  Workspace workspace;
  NetworkOutput output;
  network.forward(state.features.data(), state.present.data(), workspace, nullptr, output);
  EXPECT_EQ(output.actions.size(), spec.actions.size());
}

std::string complaint(const TensorMap& tensors) {
  try {
    const Network network(small_spec(), small_options(), tensors, "agent.safetensors");
    return "";
  } catch (const ScenarioError& error) {
    return error.what();
  }
}

TEST(Network, NamesEveryTensorThatDoesNotFit) {
  TensorMap tensors = initial_tensors(small_spec(), small_options(), 1);
  tensors.erase("cross.kv.bias");
  tensors["cross.out.weight"].shape = {16, 8};
  tensors["cross.query.bias"].values.pop_back();
  tensors["blocks.1.out.bias"] = {{16}, std::vector<float>(16)};
  EXPECT_EQ(complaint(tensors),
            "agent.safetensors: error: the tensor 'cross.kv.bias' [32] is missing\n"
            "agent.safetensors: error: the tensor 'cross.query.bias' [16] has 15 numbers\n"
            "agent.safetensors: error: the tensor 'cross.out.weight' is [16, 8]: it must be "
            "[16, 16]\n"
            "agent.safetensors: error: the tensor 'blocks.1.out.bias' [16] belongs to no part of "
            "the network\n"
            "  hint: the weights belong to another line or to other options");
}

TEST(Network, RefusesASpecWithoutATaskForEachAction) {
  ObservationSpec spec = small_spec();
  spec.actions.emplace_back("one more");
  EXPECT_THROW((Network(spec, small_options(), {})), ScenarioError);
  spec.groups.clear();
  EXPECT_THROW((Network(spec, small_options(), {})), ScenarioError);
}

}  // namespace
}  // namespace linewright
