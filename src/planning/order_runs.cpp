#include "order_runs.hpp"

#include "linewright/base/random.hpp"
#include "linewright/planning/episode.hpp"

namespace linewright::planning {

OrderRuns::OrderRuns(const Simulator& simulator, const TuneOptions& options)
    : simulator_(simulator), allocator_(options.allocator) {
  for (std::size_t s = 0; s < options.starts; ++s) {
    for (const RunOptions& crew : options.crews) {
      const std::uint64_t seed = RandomStream::derive(options.seed, "tune start", s).next();
      starts_.push_back({.setup = sample_setup(simulator.line(), crew, seed), .seed = seed});
    }
  }
}

OrderRuns::Runner OrderRuns::runner() const {
  return {.allocator = make_allocator(allocator_, simulator_), .state = {}};
}

OrderRuns::Result OrderRuns::play(Runner& runner, std::size_t start) const {
  const auto& [setup, seed] = starts_[start];
  run_episode(simulator_, runner.state, setup, seed, runner.planner, *runner.allocator);
  const bool finished = runner.state.status == RunStatus::kFinished;
  return {.makespan = finished ? runner.state.now : 2.0 * static_cast<double>(setup.horizon),
          .finished = finished};
}

}  // namespace linewright::planning
