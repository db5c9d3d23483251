#pragma once

#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "linewright/line/line_model.hpp"
#include "linewright/simulation/state.hpp"

namespace linewright {

/// values[variable] must lie in [low, high].
struct RangeCheck {
  std::int32_t variable = 0;
  std::int32_t low = std::numeric_limits<std::int32_t>::min();
  std::int32_t high = std::numeric_limits<std::int32_t>::max();
};

/// A condition as the simulator evaluates it: all of `checks`, and, when `rest` has clauses, one of
/// them completely (comparisons that are no simple range of one variable).
struct CompiledCondition {
  struct Comparison {
    std::vector<std::pair<std::int32_t, std::int32_t>> terms;  ///< (variable, coefficient)
    std::int32_t constant = 0;
    Relation relation = Relation::kGreater;
  };

  std::vector<RangeCheck> checks;
  std::vector<std::vector<Comparison>> rest;

  [[nodiscard]] bool holds(const std::vector<std::int32_t>& values) const;
  /// Every variable it reads.
  [[nodiscard]] std::vector<std::int32_t> variables() const;
};

/// Where the values of an entity stand in SimulationState::values: one block per kind of entity.
struct ValueLayout {
  // Offsets within a place's block of four.
  static constexpr std::int32_t kCount = 0;
  static constexpr std::int32_t kAvailable = 1;
  static constexpr std::int32_t kRoom = 2;
  static constexpr std::int32_t kOccupied = 3;
  // Within a berth's extra block of two.
  static constexpr std::int32_t kBerthOpen = 0;   ///< 1: neither occupied nor promised
  static constexpr std::int32_t kBerthReady = 1;  ///< 1: its carrier can be taken by a task
  // Within a machine's block of three.
  static constexpr std::int32_t kFree = 0;
  static constexpr std::int32_t kWorking = 1;
  static constexpr std::int32_t kHeld = 2;  ///< 1: held by a claim, between two operations
  // Within a carrier kind's block of two.
  static constexpr std::int32_t kFreeCarriers = 0;
  static constexpr std::int32_t kFreeEmptyCarriers = 1;

  std::int32_t berths = 0;
  std::int32_t machines = 0;
  std::int32_t operations = 0;  ///< running, done
  std::int32_t tasks = 0;       ///< running, done
  std::int32_t workers = 0;     ///< free, by kind
  std::int32_t carriers = 0;
  std::int32_t order = 0;
  std::int32_t size = 0;

  [[nodiscard]] static std::int32_t place(std::int32_t id, std::int32_t what) {
    return id * 4 + what;
  }
  [[nodiscard]] std::int32_t berth(std::int32_t id, std::int32_t what) const {
    return berths + id * 2 + what;
  }
  [[nodiscard]] std::int32_t machine(std::int32_t id, std::int32_t what) const {
    return machines + id * 3 + what;
  }
  [[nodiscard]] std::int32_t operation_running(std::int32_t id) const {
    return operations + id * 2;
  }
  [[nodiscard]] std::int32_t task_running(std::int32_t id) const { return tasks + id * 2; }
  [[nodiscard]] std::int32_t worker_free(std::int32_t kind) const { return workers + kind; }
  [[nodiscard]] std::int32_t carrier(std::int32_t kind, std::int32_t what) const {
    return carriers + kind * 2 + what;
  }
  [[nodiscard]] std::int32_t index(Variable variable) const;
};

struct CompiledOperation {
  CompiledCondition enabled;
  bool by_worker = false;
};

struct CompiledTask {
  CompiledCondition selectable;
  std::vector<std::int32_t> park_berths;  ///< berths its steps park a carrier in
  /// [step][crew slot]: index of the slot's sequence in the step, or -1.
  std::vector<std::vector<std::int16_t>> sequence_of;
};

struct CompiledMachine {
  /// (homing ticks to go, position), ascending: the points between which travel is interpolated.
  std::vector<std::pair<Tick, std::int32_t>> homing_points;
};

/// The line, laid out for the inner loop. Built once per Simulator, read by all its runs.
struct CompiledLine {
  explicit CompiledLine(const LineModel& line);

  const LineModel& line;
  ValueLayout layout;
  std::vector<CompiledOperation> operations;
  std::vector<CompiledTask> tasks;
  std::vector<CompiledMachine> machines;
  CompiledCondition done;
  std::vector<std::int16_t> place_material;  ///< by place
  std::size_t operation_words = 1;           ///< words of a bit set of operations
  std::size_t task_words = 1;                ///< words of a bit set of tasks and done_when
  /// Bit sets by variable: what to look at again when its value changes.
  std::vector<std::uint64_t> operations_reading;
  std::vector<std::uint64_t> tasks_reading;
  /// By variable: whether the future can depend on its value (counts of things done: only if read).
  std::vector<bool> matters;
  /// Milestones by what triggers them.
  std::vector<std::vector<std::int32_t>> operation_milestones;
  std::vector<std::vector<std::int32_t>> task_start_milestones;
  std::vector<std::vector<std::int32_t>> task_end_milestones;
  std::vector<std::vector<std::int32_t>> place_milestones;
  std::size_t most_executions = 0;
  bool has_side_events = false;  ///< zones or resting: events without which nothing else would stop

  [[nodiscard]] std::size_t done_bit() const { return tasks.size(); }
  [[nodiscard]] CompiledCondition compile(const Condition& condition) const;

  /// Ticks that the machine needs to `target` when it is called at `now`.
  [[nodiscard]] Tick travel(MachineId machine, std::int32_t target, const MachineState& state,
                            Tick now) const;

 private:
  void lay_out();
  void compile_operations();
  void compile_tasks();
  void compile_machines();
  void index_readers();
  void index_milestones();
};

}  // namespace linewright
