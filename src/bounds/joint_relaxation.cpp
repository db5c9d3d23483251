#include "linewright/bounds/joint_relaxation.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "joint_model.hpp"

namespace linewright {
namespace bounds {
namespace {

std::size_t at(int id) { return static_cast<std::size_t>(id); }

}  // namespace

JointModel::JointModel(const LineNet& net, const Case& one, Tick limit)
    : net_(net), times_(one.times) {
  made.limit = limit;
  made.least_end = one.ends;
}

JointRelaxation JointModel::build() {
  number_nodes();
  mark_needed();
  add_rules();
  add_batches(*this);
  add_machines(*this);
  add_workers(*this);
  add_carriers(*this);
  add_berths(*this);
  add_decisions(*this);
  for (const auto& [store, tokens] : net_.done) {
    const int end = node(net_.arrivals[at(store)], tokens);
    if (end >= 0) made.ends.push_back(end);
  }
  return std::move(made);
}

int JointModel::node(int event, int n) const {
  if (n < 1) return JointRelaxation::kAlways;
  const int column = std::min(n, times_.columns());
  return column <= count_[at(event)] ? first_[at(event)] + column - 1 : JointRelaxation::kAbsent;
}

std::vector<int> JointModel::nodes_of(int event) const {
  std::vector<int> nodes;
  for (int n = 1; n <= count_[at(event)]; ++n) nodes.push_back(first_[at(event)] + n - 1);
  return nodes;
}

void JointModel::number_nodes() {
  for (std::size_t e = 0; e < net_.net.size(); ++e) {
    const int event = static_cast<int>(e);
    first_.push_back(static_cast<int>(made.nodes.size()));
    int count = 0;
    while (count < times_.columns() && times_.at(event, count + 1) < made.limit) {
      ++count;
      made.nodes.push_back({.name = fmt::format("{} {}", net_.net[event].name, count),
                            .least = times_.at(event, count)});
    }
    count_.push_back(count);
  }
}

/// Without a needed node the end comes at the limit or later.
void JointModel::mark_needed() {
  for (std::size_t e = 0; e < net_.net.size(); ++e) {
    const int event = static_cast<int>(e);
    for (int n = 1; n <= count_[e]; ++n) {
      const Times without =
          net_.net.solve(times_, {{.event = event, .first = n, .tick = made.limit}});
      if (net_.end_of(without) < made.limit) break;  // then no later one is needed, either
      made.nodes[at(node(event, n))].needed = true;
    }
  }
}

void JointModel::precede(int from, int to, Tick lag) {
  if (to < 0 || from == JointRelaxation::kAlways) return;
  if (from == to) return;  // beyond the columns: an occurrence cannot be told from the one before
  made.precedences.push_back({.from = from, .to = to, .lag = lag});
}

void JointModel::add_rules() {
  for (std::size_t e = 0; e < net_.net.size(); ++e) {
    const int event = static_cast<int>(e);
    for (int n = 1; n <= count_[e]; ++n) {
      if (n > 1) precede(node(event, n - 1), node(event, n), 0);
      for (const Arc& arc : net_.net[event].arcs) add_arc(event, n, arc);
      for (const bounds::Batch& batch : net_.net[event].batches) {
        if (batch.most == 1)
          precede(node(batch.begin, n), node(event, n), batch.fixed + batch.each);
      }
      if (net_.net[event].counts) add_count(event, n);
    }
  }
}

void JointModel::add_arc(int event, int n, const Arc& arc) {
  const int index = arc.times * n + arc.plus;
  if (index < 1) return;
  precede(node(arc.from, (index + arc.divide - 1) / arc.divide), node(event, n), arc.lag);
}

/// The n-th of what several sources bring: so many of one and the rest of the other. What has more
/// than two sources is left to the resources.
void JointModel::add_count(int event, int n) {
  const Event& counted = net_.net[event];
  const int brought = n - counted.initial;
  if (brought < 1 || counted.sources.empty() || counted.sources.size() > 2) return;
  const bool single = std::all_of(counted.sources.begin(), counted.sources.end(),
                                  [](const Source& source) { return source.tokens == 1; });
  if (!single || n >= times_.columns()) return;
  if (counted.sources.size() == 1) {
    precede(node(counted.sources[0].event, brought), node(event, n), 0);
    return;
  }
  JointRelaxation::Either either{.node = node(event, n)};
  for (int mine = 0; mine <= brought; ++mine) {
    const int one = node(counted.sources[0].event, mine);
    const int other = node(counted.sources[1].event, brought - mine);
    if (one == JointRelaxation::kAbsent || other == JointRelaxation::kAbsent) continue;
    std::vector<int>& option = either.options.emplace_back();
    if (one >= 0) option.push_back(one);
    if (other >= 0) option.push_back(other);
  }
  made.eithers.push_back(std::move(either));
}

}  // namespace bounds

std::vector<JointRelaxation> joint_relaxations(const LineModel& line, const RunSetup& setup,
                                               Tick limit) {
  const bounds::LineNet net(line, setup);
  std::vector<JointRelaxation> relaxations;
  for (const bounds::Case& one : bounds::cases_of(net, net.net.solve(net.columns))) {
    if (one.ends >= limit) continue;
    relaxations.push_back(bounds::JointModel(net, one, limit).build());
  }
  return relaxations;
}

}  // namespace linewright
