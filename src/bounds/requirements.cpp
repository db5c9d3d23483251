#include "requirements.hpp"

#include <algorithm>
#include <cmath>

namespace linewright::bounds {
namespace {

std::size_t at(int id) { return static_cast<std::size_t>(id); }

/// Stores from which tokens can go more than one way.
std::vector<int> forks(const LineNet& net) {
  std::vector<int> takers(at(net.stores.count), 0);
  for (const Flow& flow : net.flows) {
    for (const auto& taken : flow.takes) ++takers[at(taken.first)];
  }
  std::vector<int> found;
  for (int store = 0; store < net.stores.count; ++store) {
    if (takers[at(store)] > 1) found.push_back(store);
  }
  return found;
}

/// Stores where such ways meet again, and those that the end counts.
std::vector<int> joins(const LineNet& net) {
  std::vector<int> found;
  for (int store = 0; store < net.stores.count; ++store) {
    const bool counted = std::any_of(net.done.begin(), net.done.end(),
                                     [&](const auto& need) { return need.first == store; });
    if (counted || net.net[net.arrivals[at(store)]].sources.size() > 1) found.push_back(store);
  }
  return found;
}

}  // namespace

int rounded_up(double value) { return static_cast<int>(std::ceil(value - 1e-6)); }

Requirements::Requirements(const LineNet& net, int goal)
    : net_(net), goal_(goal), ways_(at(net.stores.count), kNever) {
  ways_[at(goal)] = 0;
  for (bool shorter = true; shorter;) {
    shorter = false;
    for (const Flow& flow : net.flows) {
      Tick rest = kNever;
      for (const auto& given : flow.gives) rest = std::min(rest, ways_[at(given.first)]);
      if (rest >= kNever) continue;
      for (const auto& taken : flow.takes) {
        if (flow.least + rest >= ways_[at(taken.first)]) continue;
        ways_[at(taken.first)] = flow.least + rest;
        shorter = true;
      }
    }
  }
  for (const Flow& flow : net.flows) {
    int main = -1;
    for (std::size_t g = 0; g < flow.gives.size(); ++g) {
      const Tick way = ways_[at(flow.gives[g].first)];
      if (way >= kNever) continue;
      if (main < 0 || way < ways_[at(flow.gives[at(main)].first)]) main = static_cast<int>(g);
    }
    main_give_.push_back(main);
  }
}

double Requirements::cost_of_goal(const std::function<double(std::size_t)>& cost) const {
  // Weights that are right for some flows only must be 0: the store gets more than it is given for.
  std::vector<bool> free(at(net_.stores.count), false);
  std::vector<bool> made(at(net_.stores.count), false);
  for (std::size_t f = 0; f < net_.flows.size(); ++f) {
    for (std::size_t g = 0; g < net_.flows[f].gives.size(); ++g) {
      const int store = net_.flows[f].gives[g].first;
      (static_cast<int>(g) == main_give_[f] ? made : free)[at(store)] = true;
    }
  }
  std::vector<double> weights(at(net_.stores.count), 0.0);
  // From 0 upwards each round stays below what the flows allow.
  for (int round = 0; round < 2 * net_.stores.count + 2; ++round) {
    std::vector<double> next(weights.size(), std::numeric_limits<double>::infinity());
    for (std::size_t f = 0; f < net_.flows.size(); ++f) {
      if (main_give_[f] < 0) continue;
      const auto& [store, count] = net_.flows[f].gives[at(main_give_[f])];
      double sum = cost(f);
      for (const auto& taken : net_.flows[f].takes) sum += taken.second * weights[at(taken.first)];
      next[at(store)] = std::min(next[at(store)], sum / count);
    }
    bool grown = false;
    for (int store = 0; store < net_.stores.count; ++store) {
      const bool none = !made[at(store)] || free[at(store)] || net_.initial(store) > 0 ||
                        net_.net[net_.arrivals[at(store)]].initial > 0;
      const double weight = none ? 0.0 : next[at(store)];
      grown = grown || weight > weights[at(store)] + 1e-9;
      weights[at(store)] = weight;
    }
    if (!grown) break;
  }
  return weights[at(goal_)];
}

void add_requirements(LineNet& net) {
  for (const int goal : joins(net)) {
    const Requirements requirements(net, goal);
    for (const int fork : forks(net)) {
      const Tick way = requirements.way_to_goal(fork);
      if (fork == goal || way >= kNever) continue;
      const double each = requirements.cost_of_goal([&](std::size_t f) {
        double tokens = 0.0;
        for (const auto& taken : net.flows[f].takes)
          tokens += taken.first == fork ? taken.second : 0;
        return tokens;
      });
      // `each` of them in every token that has arrived beyond those of the start.
      constexpr int kParts = 5040;
      const int parts = static_cast<int>(std::floor(each * kParts + 1e-6));
      if (parts <= 0) continue;
      net.net[net.arrivals[at(goal)]].arcs.push_back({.from = net.arrivals[at(fork)],
                                                      .lag = way,
                                                      .times = parts,
                                                      .plus = -parts * net.initial(goal),
                                                      .divide = kParts});
    }
  }
}

}  // namespace linewright::bounds
