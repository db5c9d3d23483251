// The steady state of the simulator and of the network allocates nothing: counted by replacing
// operator new.

// The sanitizers replace operator new themselves, so this runs without them.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)

#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include "linewright/allocation/allocator.hpp"
#include "linewright/network/network.hpp"
#include "linewright/planning/episode.hpp"
#include "linewright/planning/planner.hpp"
#include "tests/support.hpp"

namespace {
std::atomic<std::size_t> allocations{0};
}

#pragma GCC diagnostic ignored "-Wmismatched-new-delete"  // both are replaced, by malloc and free

void* operator new(std::size_t size) {
  ++allocations;
  if (void* memory = std::malloc(size == 0 ? 1 : size)) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace linewright::testing {
namespace {

TEST(SteadyState, AllocatesNothingPerDecision) {
  const Simulator& simulator = *shipped_line("scenarios/duct_line.yaml").simulator;
  const auto planner = PlannerRegistry::make("random", simulator);
  for (const std::string& name : allocator_names()) {
    const auto allocator = make_allocator(name, simulator);
    const RunSetup setup = sample_setup(simulator.line(), crew_of({3, 3}), 1);
    SimulationState state;
    run_episode(simulator, state, setup, 1, *planner, *allocator);  // warm-up
    const std::size_t before = allocations;
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
      run_episode(simulator, state, setup, seed, *planner, *allocator);
    }
    EXPECT_EQ(allocations - before, 0U) << name;
  }
}

TEST(SteadyState, CopiesAStateIntoAnotherWithoutAllocating) {
  const Simulator& simulator = *shipped_line("scenarios/duct_line.yaml").simulator;
  SimulationState state;
  simulator.reset(state, sample_setup(simulator.line(), crew_of({3, 3}), 1));
  simulator.advance(state);
  SimulationState copy = state;
  const std::size_t before = allocations;
  for (int i = 0; i < 100; ++i) copy = state;
  EXPECT_EQ(allocations - before, 0U);
}

TEST(SteadyState, AllocatesNothingPerForwardPass) {
  using Encoder = TokenGroup::Encoder;
  ObservationSpec spec;
  spec.groups = {{"human", Encoder::kShared, {"a", "b", "c"}, {{"x", "y"}}},
                 {"tasks", Encoder::kNamed, {"cut", "glue"}, {{"open"}}},
                 {"global", Encoder::kOwn, {"global"}, {{"time"}}}};
  spec.actions = {"cut", "glue"};
  const Network network(spec, {}, initial_tensors(spec, {}, 1));
  const std::vector<float> features(spec.feature_count(), 0.5F);
  std::vector<std::uint8_t> present(spec.token_count(), 0);
  RandomStream random(1);
  Noise noise = network.make_noise();
  Workspace workspace;
  NetworkOutput output;
  network.forward(features.data(), present.data(), workspace, &noise, output);  // warm-up
  const std::size_t before = allocations;
  for (std::size_t i = 0; i < 100; ++i) {
    present[i % 3] ^= 1U;
    sample_noise(random, noise);
    network.forward(features.data(), present.data(), workspace, &noise, output);
  }
  EXPECT_EQ(allocations - before, 0U);
}

}  // namespace
}  // namespace linewright::testing

#endif
