#include "linewright/bounds/lower_bounds.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>

#include "cases.hpp"
#include "line_net.hpp"
#include "sequence.hpp"

namespace linewright {

std::vector<Bound> lower_bounds(const LineModel& line, const RunSetup& setup,
                                const BoundOptions& options, const CancelToken* cancel) {
  const bounds::LineNet net(line, setup);
  const bounds::Times times = net.net.solve(net.columns);
  const auto cases = bounds::cases_of(net, times);
  std::vector<Bound> found;
  Tick over = 5000;
  for (const auto& c : cases) {
    if (c.ends >= over) break;
    std::string text;
    Tick best = c.ends;
    text += fmt::format("path {} ", c.ends);
  for (std::size_t m = 0; m < line.machines.size(); ++m) {
    if (best >= over) continue;
    const auto problem = bounds::machine_problem(net, MachineId(m));
    if (!problem || problem->jobs.size() < 2) continue;
    const auto r = bounds::best_sequence(net, c.times, *problem, over, options.most_states, cancel);
    { text += fmt::format("{} {} ({}) ", line.machines[m].name, r.ticks, r.states); best = std::max(best, r.ticks); }
  }
  for (std::size_t k = 0; k < line.worker_kinds.size(); ++k) {
    if (best >= over) continue;
    const auto problem = bounds::worker_problem(net, WorkerKindId(k));
    if (!problem) continue;
    const auto r = bounds::best_sequence(net, c.times, *problem, over, options.most_states, cancel);
    { text += fmt::format("{} {} ({}) ", line.worker_kinds[k].name, r.ticks, r.states); best = std::max(best, r.ticks); }
  }
    over = std::min(over, best);
    found.push_back({"case", best, text});
  }
  std::stable_sort(found.begin(), found.end(), [](const Bound& a, const Bound& b) { return a.ticks < b.ticks; });
  return found;
}

double gap(Tick upper, Tick lower) {
  return static_cast<double>(upper - lower) / static_cast<double>(std::max(1, lower));
}

}  // namespace linewright
