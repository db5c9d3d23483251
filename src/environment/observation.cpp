#include "linewright/environment/observation.hpp"

#include <algorithm>
#include <limits>

#include "linewright/simulation/pending_event.hpp"
#include "observation_plan.hpp"

namespace linewright {
namespace {

using Plan = ObservationPlan;

std::size_t at(std::int32_t id) { return static_cast<std::size_t>(id); }

float ticks(Tick count) {
  constexpr float kLongest = 4.0F;
  return std::min(static_cast<float>(count) * Plan::kTickScale, kLongest);
}

/// Writes one observation; lives on the stack of one call.
class Writer {
 public:
  Writer(const Simulator& simulator, const Plan& plan, const SimulationState& state,
         ObservationView out)
      : simulator_(simulator), line_(simulator.line()), plan_(plan), state_(state), out_(out) {}

  void write() {
    std::fill_n(out_.features, plan_.feature_count, 0.0F);
    std::fill_n(out_.present, plan_.machine_token, std::uint8_t{0});
    std::fill(out_.present + plan_.machine_token, out_.present + plan_.token_count,
              std::uint8_t{1});
    write_workers();
    write_carriers();
    write_machines();
    write_places();
    write_pending();
    write_tasks();
    write_global();
  }

 private:
  /// How many of what the order asks for are not there yet, as a share of the most that counts.
  [[nodiscard]] float missing(std::int32_t count) const {
    return static_cast<float>(std::clamp(state_.order - count, 0, Plan::kMostCounted)) /
           Plan::kMostCounted;
  }

  void write_workers() {
    std::size_t kind = plan_.workers.size();
    std::size_t number = 0;
    for (std::size_t w = 0; w < state_.workers.size(); ++w) {
      const WorkerState& worker = state_.workers[w];
      if (at(worker.kind) != kind) number = 0;
      kind = at(worker.kind);
      const Plan::Workers& plan = plan_.workers[kind];
      if (number == plan.most) continue;  // more than the scenario says: not shown
      out_.present[plan.token + number] = 1;
      write_worker(plan, out_.features + plan.feature + number++ * plan.width, w);
    }
  }

  void write_worker(const Plan::Workers& plan, float* features, std::size_t w) {
    const WorkerState& worker = state_.workers[w];
    const Pose2 pose = simulator_.worker_pose(state_, WorkerId(w), state_.now);
    features[Plan::Workers::kX] = static_cast<float>((pose.x_m - plan_.x_middle) * plan_.x_scale);
    features[Plan::Workers::kY] = static_cast<float>((pose.y_m - plan_.y_middle) * plan_.y_scale);
    const std::int32_t station = plan.station[at(worker.station)];
    if (station != Plan::kNone) features[station] = 1.0F;
    features[Plan::Workers::kUnderWay] = ticks(std::max(0, worker.arrive - state_.now));
    features[Plan::Workers::kHolds] = worker.carrier >= 0 ? 1.0F : 0.0F;
    if (worker.free()) {
      features[Plan::Workers::kFree] = 1.0F;
      return;
    }
    const Execution& execution = state_.executions[at(worker.execution)];
    const Task& task = line_.tasks[at(execution.task)];
    const bool waits = worker.phase == WorkerState::Phase::kWaiting ||
                       worker.phase == WorkerState::Phase::kNone ||
                       worker.phase == WorkerState::Phase::kNoWay;
    features[Plan::Workers::kWaits] = waits ? 1.0F : 0.0F;
    features[Plan::Workers::kStep] =
        static_cast<float>(execution.step + 1) / static_cast<float>(task.steps.size());
    features[Plan::Workers::kAction] = static_cast<float>(worker.action + 1) / 4.0F;
    features[Plan::Workers::kItems] =
        static_cast<float>(std::min(worker.items, Plan::kMostCounted)) / Plan::kMostCounted;
    features[plan.tasks + at(execution.task)] = 1.0F;
  }

  void write_carriers() {
    std::size_t kind = plan_.carriers.size();
    std::size_t number = 0;
    for (const CarrierState& carrier : state_.carriers) {
      if (at(carrier.kind) != kind) number = 0;
      kind = at(carrier.kind);
      const Plan::Carriers& plan = plan_.carriers[kind];
      if (number == plan.most) continue;
      out_.present[plan.token + number] = 1;
      write_carrier(plan, out_.features + plan.feature + number++ * plan.width, carrier);
    }
  }

  void write_carrier(const Plan::Carriers& plan, float* features, const CarrierState& carrier) {
    features[Plan::Carriers::kFree] = carrier.free() ? 1.0F : 0.0F;
    features[Plan::Carriers::kInBerth] = carrier.berth >= 0 ? 1.0F : 0.0F;
    features[Plan::Carriers::kHeld] = carrier.holder >= 0 ? 1.0F : 0.0F;
    features[Plan::Carriers::kItems] = static_cast<float>(carrier.items) * plan.per_item;
    features[Plan::Carriers::kLeaving] = static_cast<float>(carrier.leaving) * plan.per_item;
    features[Plan::Carriers::kComing] = static_cast<float>(carrier.coming) * plan.per_item;
    const std::int16_t where =
        carrier.holder >= 0 ? state_.workers[at(carrier.holder)].station : carrier.station;
    const std::int32_t station = plan.station[at(where)];
    if (station != Plan::kNone) features[station] = 1.0F;
    if (carrier.material >= 0) features[plan.materials + at(carrier.material)] = 1.0F;
    if (carrier.execution >= 0) {
      features[plan.tasks + at(state_.executions[at(carrier.execution)].task)] = 1.0F;
    }
  }

  void write_machines() {
    for (std::size_t m = 0; m < plan_.machines.size(); ++m) {
      const Plan::MachineFeatures& plan = plan_.machines[m];
      const MachineState& machine = state_.machines[m];
      float* features = out_.features + plan.feature;
      features[Plan::MachineFeatures::kFree] = static_cast<float>(state_.values[plan.free_value]);
      features[Plan::MachineFeatures::kWorking] =
          static_cast<float>(state_.values[plan.working_value]);
      if (!plan.moves) continue;
      features[Plan::MachineFeatures::kFixed + at(machine.position)] = 1.0F;
      const auto& homing = line_.machines[m].homing;
      if (!homing || machine.taken) continue;
      const Tick takes = homing->takes[at(machine.position)];
      features[Plan::MachineFeatures::kHoming] =
          ticks(std::max(0, takes - (state_.now - machine.rest_since)));
    }
  }

  void write_places() {
    for (const Plan::PlaceFeatures& plan : plan_.places) {
      const std::int32_t count = state_.values[plan.count_value];
      const std::int32_t available = state_.values[plan.available_value];
      float* features = out_.features + plan.feature;
      features[Plan::PlaceFeatures::kCount] =
          static_cast<float>(std::min(count, plan.most)) * plan.scale;
      features[Plan::PlaceFeatures::kAvailable] =
          static_cast<float>(std::min(available, plan.most)) * plan.scale;
      if (!plan.many) continue;
      features[Plan::PlaceFeatures::kAny] = count > 0 ? 1.0F : 0.0F;
      features[Plan::PlaceFeatures::kMissing] = missing(count);
    }
  }

  /// What is under way: operations, recoveries, and the workers' current actions.
  void write_pending() {
    for (const Plan::OperationFeatures& plan : plan_.operations) {
      out_.features[plan.feature + Plan::OperationFeatures::kRunning] =
          static_cast<float>(std::min(state_.values[plan.running_value], 1));
    }
    // The last event of the list comes first: of several firings the first to end is shown.
    for (const SimulationState::Event& event : state_.events) {
      const Tick left = event.tick() - state_.now;
      const std::size_t number = number_of(event);
      if (kind_of(event) == kOperationEvent) {
        out_.features[plan_.operations[number].feature + Plan::OperationFeatures::kRemaining] =
            ticks(left);
      } else if (kind_of(event) == kRecoveryEvent) {
        const std::int32_t machine = plan_.operations[number].machine;
        if (machine == Plan::kNone) continue;
        out_.features[plan_.machines[at(machine)].feature + Plan::MachineFeatures::kRecovering] =
            ticks(left);
      } else if (kind_of(event) == kWorkerEvent) {
        write_pending_action(number, left);
      }
      if (event.operator_worker >= 0) write_pending_action(at(event.operator_worker), left);
    }
  }

  void write_pending_action(std::size_t w, Tick left) {
    const Plan::Workers& plan = plan_.workers[at(state_.workers[w].kind)];
    std::size_t number = w;
    for (std::int16_t kind = 0; kind < state_.workers[w].kind; ++kind) number -= count_of(kind);
    if (number >= plan.most) return;
    out_.features[plan.feature + number * plan.width + Plan::Workers::kPending] = ticks(left);
  }

  std::size_t count_of(std::int16_t kind) const {
    std::size_t count = 0;
    for (const WorkerState& worker : state_.workers) count += worker.kind == kind ? 1 : 0;
    return count;
  }

  void write_tasks() {
    for (std::size_t t = 0; t < line_.tasks.size(); ++t) {
      const Plan::TaskFeatures& plan = plan_.tasks[t];
      float* features = out_.features + plan.feature;
      const bool selectable = state_.is_selectable(TaskId(t));
      out_.selectable[t] = selectable ? 1 : 0;
      features[Plan::TaskFeatures::kSelectable] = selectable ? 1.0F : 0.0F;
      features[Plan::TaskFeatures::kRunning] =
          static_cast<float>(state_.values[plan.running_value]);
      features[Plan::TaskFeatures::kMissing] = missing(state_.values[plan.done_value]);
      if (selectable) write_ways(plan, t);
    }
    for (const Execution& execution : state_.executions) {
      if (execution.task < 0) continue;
      float* features = out_.features + plan_.tasks[at(execution.task)].feature;
      features[Plan::TaskFeatures::kSince] = ticks(state_.now - execution.started);
      features[Plan::TaskFeatures::kStep] =
          static_cast<float>(execution.step + 1) /
          static_cast<float>(line_.tasks[at(execution.task)].steps.size());
      features[Plan::TaskFeatures::kJoiner] = execution.missing != 0 ? 1.0F : 0.0F;
    }
    if (plan_.tasks.size() > line_.tasks.size()) {
      const bool possible = !state_.events.empty();
      out_.selectable[line_.tasks.size()] = possible ? 1 : 0;
      out_.features[plan_.tasks.back().feature] = possible ? 1.0F : 0.0F;
    }
  }

  /// How far the nearest free ones are from where the task's crew goes first.
  void write_ways(const Plan::TaskFeatures& plan, std::size_t task) {
    for (const Plan::FirstWay& way : plan.ways) {
      float* features = out_.features + plan.feature + Plan::TaskFeatures::kFixed + 2 * way.kind;
      features[0] = 1.0F;
      if (way.goes || way.carrier_slot != Plan::kNone) features[1] = ticks(nearest(way, task));
    }
  }

  [[nodiscard]] Tick nearest(const Plan::FirstWay& way, std::size_t task) const {
    Tick least = std::numeric_limits<Tick>::max();
    for (std::size_t w = 0; w < state_.workers.size(); ++w) {
      if (!state_.workers[w].free() || at(state_.workers[w].kind) != way.kind) continue;
      least = std::min(least, way.carrier_slot == Plan::kNone ? way_ticks(w, way.station)
                                                              : way_with_carrier(way, w, task));
    }
    return least;
  }

  [[nodiscard]] Tick way_ticks(std::size_t worker, StationId to) const {
    const Tick known = simulator_.route_from_worker(state_, WorkerId(worker), to).ticks;
    return known < 0 ? std::numeric_limits<Tick>::max() : known;
  }

  [[nodiscard]] Tick way_with_carrier(const Plan::FirstWay& way, std::size_t worker,
                                      std::size_t task) const {
    Tick least = std::numeric_limits<Tick>::max();
    const CrewSlot& slot = line_.tasks[task].crew[at(way.carrier_slot)];
    for (std::size_t c = 0; c < state_.carriers.size(); ++c) {
      if (!simulator_.carrier_fits(state_, slot, CarrierId(c))) continue;
      const StationId there(std::int32_t{state_.carriers[c].station});
      const Tick to_carrier = way_ticks(worker, there);
      const Tick on = way.goes ? line_.travel[way.kind].leg(there, way.station).ticks : 0;
      if (to_carrier == std::numeric_limits<Tick>::max() || on < 0) continue;
      least = std::min(least, to_carrier + on);
    }
    return least;
  }

  void write_global() {
    float* features = out_.features + plan_.global.feature;
    features[Plan::GlobalFeatures::kTimeLeft] = ticks(state_.horizon - state_.now);
    features[Plan::GlobalFeatures::kMissing] = missing(state_.values[plan_.global.finished_value]);
    for (const WorkerState& worker : state_.workers) {
      const float share = plan_.global.per_worker[at(worker.kind)];
      float* of_kind = features + Plan::GlobalFeatures::kFixed + 2 * at(worker.kind);
      of_kind[0] += share;
      if (worker.free()) of_kind[1] += share;
    }
  }

  const Simulator& simulator_;
  const LineModel& line_;
  const Plan& plan_;
  const SimulationState& state_;
  ObservationView out_;
};

}  // namespace

ObservationEncoder::ObservationEncoder(const Simulator& simulator)
    : simulator_(simulator), plan_(std::make_unique<ObservationPlan>(simulator)) {}
ObservationEncoder::~ObservationEncoder() = default;
ObservationEncoder::ObservationEncoder(ObservationEncoder&&) noexcept = default;

const ObservationSpec& ObservationEncoder::spec() const { return plan_->spec; }
std::size_t ObservationEncoder::feature_count() const { return plan_->feature_count; }
std::size_t ObservationEncoder::token_count() const { return plan_->token_count; }

void ObservationEncoder::encode(const SimulationState& state, ObservationView out) const {
  Writer(simulator_, *plan_, state, out).write();
}

}  // namespace linewright
