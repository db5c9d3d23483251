#pragma once

#include <memory>
#include <string>

#include "linewright/environment/observation.hpp"
#include "linewright/network/network.hpp"
#include "linewright/planning/planner.hpp"

namespace linewright {

/// A learned policy at work (paper, Sec. 3.3): of the tasks that may be chosen the one with the
/// largest Q value (or logit), without any exploration. Ties: the lowest task number. No LibTorch.
class PolicyPlanner final : public Planner {
 public:
  /// The simulator must outlive it; the network must be made for observations of its line.
  PolicyPlanner(const Simulator& simulator, std::shared_ptr<const Network> network);

  void reset(std::uint64_t seed) override;
  [[nodiscard]] Decision decide(const SimulationState& state, const Choices& choices) override;

 private:
  ObservationEncoder encoder_;
  std::shared_ptr<const Network> network_;
  std::size_t tasks_;
  Workspace workspace_;
  NetworkOutput output_;
  std::vector<float> features_;
  std::vector<std::uint8_t> present_;
  std::vector<std::uint8_t> selectable_;
};

/// The planner of a policy file. Throws ScenarioError when the file is no policy, or one made for
/// a line with other entities or tasks than the simulator's.
[[nodiscard]] std::unique_ptr<Planner> make_policy_planner(const std::string& file,
                                                           const Simulator& simulator);

}  // namespace linewright
