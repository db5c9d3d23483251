#include "cases.hpp"

#include <algorithm>

namespace linewright::bounds {
namespace {

constexpr std::size_t kMostCases = 64;

/// The ways out of a store, as the events that take a token each; empty: it is no fork.
std::vector<int> ways_of(const LineNet& net, int store) {
  std::vector<int> ways;
  for (const Flow& flow : net.flows) {
    for (const auto& taken : flow.takes) {
      if (taken.first != store) continue;
      if (taken.second != 1) return {};
      ways.push_back(
          flow.operation
              ? net.starts[flow.operation->index()]
              : net.tasks[flow.task->index()].actions[flow.step][flow.sequence][flow.action].item);
    }
  }
  if (ways.size() < 2) ways.clear();
  return ways;
}

/// Tokens that can ever come into the store; none: more than are counted.
std::optional<int> most_tokens(const LineNet& net, const Times& times, int store) {
  const int arrivals = net.arrivals[static_cast<std::size_t>(store)];
  for (int n = 1; n <= times.columns(); ++n) {
    if (times.at(arrivals, n) >= kNever) return n - 1;
  }
  return std::nullopt;
}

/// All ways to share `tokens` among the ways from `way` on.
void share(const LineNet& net, const Times& times, const std::vector<int>& ways, std::size_t way,
           int tokens, std::vector<Case>& found) {
  if (found.size() > kMostCases) return;
  const bool last = way + 1 == ways.size();
  for (int mine = last ? tokens : 0; mine <= tokens; ++mine) {
    Times limited = net.net.solve(times, {{.event = ways[way], .first = mine + 1, .tick = kNever}});
    const Tick ends = net.end_of(limited);
    if (ends >= kNever) continue;
    if (last) {
      found.push_back({std::move(limited), ends});
    } else {
      share(net, limited, ways, way + 1, tokens - mine, found);
    }
  }
}

}  // namespace

std::vector<Case> cases_of(const LineNet& net, const Times& times) {
  std::vector<Case> cases{{times, net.end_of(times)}};
  for (int store = 0; store < net.stores.count; ++store) {
    const std::vector<int> ways = ways_of(net, store);
    const std::optional<int> tokens = most_tokens(net, times, store);
    if (ways.empty() || !tokens) continue;
    std::vector<Case> finer;
    for (const Case& one : cases) share(net, one.times, ways, 0, *tokens, finer);
    // None: the order cannot be finished at all.
    if (!finer.empty() && finer.size() <= kMostCases) cases = std::move(finer);
  }
  std::stable_sort(cases.begin(), cases.end(),
                   [](const Case& a, const Case& b) { return a.ends < b.ends; });
  return cases;
}

}  // namespace linewright::bounds
