#include <algorithm>

#include "joint_model.hpp"
#include "linewright/line/lower_limits.hpp"

namespace linewright::bounds {
namespace {

/// The comparison says that the variable is 0 (it is never negative).
bool asks_zero(const Comparison& comparison, const Variable& variable) {
  if (comparison.terms.size() != 1 || !(comparison.terms[0].variable == variable)) return false;
  if (comparison.terms[0].coefficient != 1) return false;
  switch (comparison.relation) {
    case Relation::kEqual:
    case Relation::kLessEqual:
      return comparison.constant == 0;
    case Relation::kLess:
      return comparison.constant == -1;
    default:
      return false;
  }
}

bool asks(const Condition& condition, const Variable& variable, bool zero, std::int32_t order) {
  if (condition.any_of.size() != 1) return false;
  if (zero) {
    return std::any_of(condition.any_of[0].begin(), condition.any_of[0].end(),
                       [&](const Comparison& one) { return asks_zero(one, variable); });
  }
  const std::vector<LowerLimit> limits = lower_limits(condition, order);
  return std::any_of(limits.begin(), limits.end(),
                     [&](const LowerLimit& limit) { return limit.variable == variable; });
}

}  // namespace

std::vector<JointRelaxation::Instant> instants_asking(const JointModel& model,
                                                      const Variable& variable, bool zero) {
  const LineNet& net = model.net();
  std::vector<JointRelaxation::Instant> instants;
  for (std::size_t o = 0; o < net.line.operations.size(); ++o) {
    if (!asks(net.line.operations[o].when, variable, zero, net.setup.order)) continue;
    for (const int node : model.nodes_of(net.starts[o])) instants.push_back({node, 0});
  }
  for (std::size_t t = 0; t < net.line.tasks.size(); ++t) {
    if (!asks(net.line.tasks[t].when, variable, zero, net.setup.order)) continue;
    for (const int node : model.nodes_of(net.tasks[t].start)) instants.push_back({node, 1});
  }
  return instants;
}

}  // namespace linewright::bounds
