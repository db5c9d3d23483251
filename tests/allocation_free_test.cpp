// The steady state of the simulator allocates nothing: counted by replacing operator new.

// The sanitizers replace operator new themselves, so this runs without them.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)

#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>

#include "linewright/allocation/allocator.hpp"
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

}  // namespace
}  // namespace linewright::testing

#endif
