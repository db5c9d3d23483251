#include "linewright/bounds/lower_bounds.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "line_net.hpp"
#include "sequence.hpp"

namespace linewright {

std::vector<Bound> lower_bounds(const LineModel& line, const RunSetup& setup,
                                const BoundOptions& options, const CancelToken* cancel) {
  const bounds::LineNet net(line, setup);
  const bounds::Times times = net.net.solve(net.columns);
  std::vector<Bound> found{{"critical_path", net.end_of(times), ""}};
  for (std::size_t m = 0; m < line.machines.size(); ++m) {
    const auto problem = bounds::machine_problem(net, MachineId(m));
    if (!problem || problem->jobs.size() < 2) continue;
    const auto best = bounds::best_sequence(net, times, *problem, options.most_states, cancel);
    if (best) found.push_back({"machine:" + line.machines[m].name, best->ticks, fmt::format("{} states", best->states)});
  }
  for (std::size_t k = 0; k < line.worker_kinds.size(); ++k) {
    const auto problem = bounds::worker_problem(net, WorkerKindId(k));
    if (!problem) continue;
    const auto best = bounds::best_sequence(net, times, *problem, options.most_states, cancel);
    if (best) found.push_back({"worker:" + line.worker_kinds[k].name, best->ticks, fmt::format("{} states", best->states)});
  }
  if (std::getenv("LW_DUMP") != nullptr) {
    for (std::size_t e = 0; e < net.net.size(); ++e) {
      std::string row;
      for (int n = 1; n <= std::min(6, net.columns); ++n)
        row += fmt::format(" {:>5}", std::min(99999, times.at(static_cast<int>(e), n)));
      std::puts(fmt::format("{:4} {:<30}{}", e, net.net[static_cast<int>(e)].name, row).c_str());
    }
  }
  std::stable_sort(found.begin(), found.end(), [](const Bound& a, const Bound& b) { return a.ticks > b.ticks; });
  return found;
}

double gap(Tick upper, Tick lower) {
  return static_cast<double>(upper - lower) / static_cast<double>(std::max(1, lower));
}

}  // namespace linewright
