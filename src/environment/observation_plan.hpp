#pragma once

#include <cstdint>
#include <vector>

#include "linewright/environment/observation_spec.hpp"
#include "linewright/simulation/simulator.hpp"

namespace linewright {

/// Where each fact of a line's state stands in its observation: the spec and, for every entity, the
/// index of its first feature. The order of features within an entity is that of the enumerations.
struct ObservationPlan {
  explicit ObservationPlan(const Simulator& simulator);

  static constexpr std::int32_t kNone = -1;
  /// Ticks are divided by this: the length of a longer operation or way.
  static constexpr float kTickScale = 1.0F / 50.0F;
  /// Counts of places without or with a large capacity saturate here.
  static constexpr std::int32_t kMostCounted = 4;

  struct Workers {  ///< one group, of interchangeable tokens
    enum Feature { kFree, kUnderWay, kPending, kWaits, kHolds, kStep, kAction, kItems, kX, kY };
    static constexpr std::size_t kFixed = 10;  ///< then stations, then tasks
    std::size_t feature = 0;
    std::size_t width = 0;
    std::size_t token = 0;
    std::size_t most = 0;
    std::vector<std::int32_t> station;  ///< by station: offset of its flag
    std::size_t tasks = 0;              ///< offset of the tasks' flags
  };
  struct Carriers {
    enum Feature { kFree, kInBerth, kHeld, kItems, kLeaving, kComing };
    static constexpr std::size_t kFixed = 6;  ///< then stations, then materials, then tasks
    std::size_t feature = 0;
    std::size_t width = 0;
    std::size_t token = 0;
    std::size_t most = 0;
    std::vector<std::int32_t> station;
    std::size_t materials = 0;
    std::size_t tasks = 0;
    float per_item = 1.0F;
  };
  struct MachineFeatures {
    enum Feature { kFree, kWorking, kRecovering, kHoming };
    static constexpr std::size_t kFixed = 4;  ///< then positions, then operations
    std::size_t feature = 0;
    std::size_t free_value = 0;  ///< indices into SimulationState::values
    std::size_t working_value = 0;
    bool moves = false;
  };
  struct PlaceFeatures {
    /// A place for one item: kCount and kAvailable only.
    enum Feature { kCount, kAvailable, kAny, kMissing };
    std::size_t feature = 0;
    std::size_t count_value = 0;
    std::size_t available_value = 0;
    std::size_t promised_room = 0;
    float scale = 1.0F;
    std::int32_t most = 1;
    bool many = false;
  };
  struct OperationFeatures {
    enum Feature { kRunning, kRemaining };
    std::size_t feature = 0;
    std::size_t running_value = 0;
    std::int32_t machine = kNone;  ///< whose recovery its recovery is
  };
  /// A worker that the task's crew needs at the start, and the first station it goes to.
  struct FirstWay {
    std::size_t kind = 0;
    std::int32_t carrier_slot = kNone;  ///< whom it fetches before
    StationId station;
    bool goes = false;  ///< `station` is set
  };
  struct TaskFeatures {
    enum Feature { kSelectable, kRunning, kMissing, kSince, kStep, kJoiner };
    static constexpr std::size_t kFixed = 6;  ///< then per worker kind: needed, ticks away
    std::size_t feature = 0;
    std::size_t running_value = 0;
    std::size_t done_value = 0;
    std::vector<FirstWay> ways;
  };
  struct GlobalFeatures {
    enum Feature { kTimeLeft, kMissing };
    static constexpr std::size_t kFixed = 2;  ///< then per worker kind: there, free
    std::size_t feature = 0;
    std::size_t finished_value = 0;
    std::vector<float> per_worker;  ///< by kind: 1 / most
  };

  ObservationSpec spec;
  std::size_t feature_count = 0;
  std::size_t token_count = 0;
  std::vector<Workers> workers;
  std::vector<Carriers> carriers;
  std::vector<MachineFeatures> machines;
  std::vector<PlaceFeatures> places;
  std::vector<OperationFeatures> operations;
  std::vector<TaskFeatures> tasks;
  GlobalFeatures global;
  std::size_t machine_token = 0;
  std::size_t machine_tokens_end = 0;  ///< from here on all tokens are always present
  // Positions, scaled to -1 ... 1.
  double x_middle = 0.0, y_middle = 0.0, x_scale = 1.0, y_scale = 1.0;

 private:
  void add_workers(const LineModel& line);
  void add_carriers(const LineModel& line);
  void add_machines(const Simulator& simulator);
  void add_materials(const Simulator& simulator);
  void add_tasks(const Simulator& simulator);
  void add_global(const Simulator& simulator);
  void add_operation(const Simulator& simulator, std::size_t operation, std::size_t feature,
                     std::vector<std::string>& names);
  void scale_positions(const LineModel& line);
  TokenGroup& add_group(std::string name, TokenGroup::Encoder encoder);
};

}  // namespace linewright
