#pragma once

#include <cstdint>
#include <memory>

#include "linewright/environment/observation_spec.hpp"
#include "linewright/simulation/simulator.hpp"

namespace linewright {

struct ObservationPlan;

/// Where an observation is written: memory of the caller, sized as its ObservationSpec says.
struct ObservationView {
  float* features = nullptr;           ///< [feature_count()]
  std::uint8_t* present = nullptr;     ///< [token_count()]
  std::uint8_t* selectable = nullptr;  ///< [actions.size()]
};

/// Turns the state of a run into numbers for the high-level agent (paper, eq. 3-4; features:
/// docs/algorithms/ebq.md). It follows from the line alone: entities, tasks, and real positions
/// scaled to the stations' bounding box. Counts saturate and times are relative, so that a larger
/// order looks like what is known from a smaller one. Immutable: serves any number of threads.
class ObservationEncoder {
 public:
  /// The simulator must outlive the encoder.
  explicit ObservationEncoder(const Simulator& simulator);
  ~ObservationEncoder();
  ObservationEncoder(ObservationEncoder&&) noexcept;
  ObservationEncoder(const ObservationEncoder&) = delete;
  ObservationEncoder& operator=(const ObservationEncoder&) = delete;
  ObservationEncoder& operator=(ObservationEncoder&&) = delete;

  [[nodiscard]] const ObservationSpec& spec() const;
  /// As of the spec, without counting.
  [[nodiscard]] std::size_t feature_count() const;
  [[nodiscard]] std::size_t token_count() const;

  /// Writes every number of the observation of `state`; allocates nothing.
  void encode(const SimulationState& state, ObservationView out) const;

 private:
  const Simulator& simulator_;
  std::unique_ptr<const ObservationPlan> plan_;
};

}  // namespace linewright
