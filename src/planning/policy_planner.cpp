#include "linewright/planning/policy_planner.hpp"

#include <fmt/format.h>

#include <utility>

#include "linewright/base/diagnostic.hpp"
#include "linewright/network/policy_file.hpp"

namespace linewright {

PolicyPlanner::PolicyPlanner(const Simulator& simulator, std::shared_ptr<const Network> network)
    : encoder_(simulator), network_(std::move(network)), tasks_(simulator.line().tasks.size()) {
  features_.resize(encoder_.feature_count());
  present_.resize(encoder_.token_count());
  selectable_.resize(encoder_.spec().actions.size());
}

void PolicyPlanner::reset(std::uint64_t /*seed*/) {}

Decision PolicyPlanner::decide(const SimulationState& state, const Choices& choices) {
  encoder_.encode(state, {features_.data(), present_.data(), selectable_.data()});
  network_->forward(features_.data(), present_.data(), workspace_, nullptr, output_);
  const auto may_take = [&](std::size_t a) {
    return selectable_[a] != 0 && (a < tasks_ ? choices.tasks.contains(TaskId(a)) : choices.wait);
  };
  std::optional<std::size_t> best;
  for (std::size_t a = 0; a < selectable_.size(); ++a) {
    if (may_take(a) && (!best || output_.actions[a] > output_.actions[*best])) best = a;
  }
  if (!best || *best >= tasks_) return Decision::wait();
  return {.task = TaskId(*best)};
}

std::unique_ptr<Planner> make_policy_planner(const std::string& file, const Simulator& simulator) {
  const Policy policy = load_policy(file);
  const std::string mismatch = explain_mismatch(policy.spec, ObservationEncoder(simulator).spec());
  if (!mismatch.empty()) {
    throw ScenarioError(file,
                        fmt::format("does not fit line '{}': {}", simulator.line().name, mismatch),
                        "use a policy that was trained on this line (linewright train)");
  }
  return std::make_unique<PolicyPlanner>(simulator,
                                         std::make_shared<const Network>(policy.network(file)));
}

}  // namespace linewright
