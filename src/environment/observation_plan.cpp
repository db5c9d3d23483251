#include "observation_plan.hpp"

#include <algorithm>
#include <limits>
#include <utility>
#include <variant>

#include "linewright/line/materials.hpp"

namespace linewright {
namespace {

using Names = std::vector<std::string>;

void append(Names& names, const std::string& prefix, const Names& more) {
  for (const std::string& name : more) names.push_back(prefix + name);
}

Names task_names(const LineModel& line) {
  Names names;
  for (const Task& task : line.tasks) names.push_back(task.name);
  return names;
}

/// Flags for the stations where workers of the kind can be; fills in each one's offset.
Names station_flags(const LineModel& line, std::size_t kind, std::size_t first,
                    std::vector<std::int32_t>& offsets) {
  Names names;
  offsets.assign(line.stations.size(), ObservationPlan::kNone);
  for (std::size_t s = 0; s < line.stations.size(); ++s) {
    if (!line.stations[s].poses[kind]) continue;
    offsets[s] = static_cast<std::int32_t>(first + names.size());
    names.push_back(line.stations[s].name);
  }
  return names;
}

std::string numbered(const std::string& name, std::size_t i) {
  return name + "_" + std::to_string(i + 1);
}

/// The machine that an operation is shown with.
const MachineUse* machine_of(const Operation& operation) {
  for (const auto* list : {&operation.uses, &operation.claims, &operation.frees}) {
    if (!list->empty()) return &list->front();
  }
  return nullptr;
}

/// The place whose material an operation without machines is shown with.
std::size_t place_of(const Operation& operation) {
  const auto& flows = operation.produces.empty() ? operation.consumes : operation.produces;
  return flows.empty() ? 0 : flows.front().place.index();
}

/// Who is needed at the start of the task and where each goes first.
std::vector<ObservationPlan::FirstWay> first_ways(const Task& task) {
  std::vector<ObservationPlan::FirstWay> ways;
  for (std::size_t slot = 0; slot < task.crew.size(); ++slot) {
    if (!task.crew[slot].worker || task.crew[slot].join_late) continue;
    ObservationPlan::FirstWay way{.kind = task.crew[slot].worker->index()};
    for (const Step& step : task.steps) {
      for (const ActorSequence& sequence : step.sequences) {
        if (sequence.slot != slot || way.goes) continue;
        for (const Action& action : sequence.actions) {
          const auto* go = std::get_if<GoAction>(&action.what);
          const auto* fetch = std::get_if<FetchAction>(&action.what);
          if (fetch != nullptr && !way.goes) {
            way.carrier_slot = static_cast<std::int32_t>(fetch->carrier_slot);
          }
          if (go != nullptr && !way.goes) {
            way.station = go->station;
            way.goes = true;
          }
        }
      }
    }
    ways.push_back(way);
  }
  return ways;
}

}  // namespace

TokenGroup& ObservationPlan::add_group(std::string name, TokenGroup::Encoder encoder) {
  spec.groups.push_back({.name = std::move(name), .encoder = encoder});
  return spec.groups.back();
}

ObservationPlan::ObservationPlan(const Simulator& simulator) {
  const LineModel& line = simulator.line();
  add_workers(line);
  add_carriers(line);
  machine_token = token_count;
  operations.resize(line.operations.size());
  add_machines(simulator);
  add_materials(simulator);
  add_tasks(simulator);
  add_global(simulator);
  scale_positions(line);
}

void ObservationPlan::add_workers(const LineModel& line) {
  for (std::size_t k = 0; k < line.worker_kinds.size(); ++k) {
    const WorkerKind& kind = line.worker_kinds[k];
    TokenGroup& group = add_group(kind.name, TokenGroup::Encoder::kShared);
    Workers plan;
    Names names{"free", "under_way", "pending", "waits", "holds_carrier",
                "step", "action",    "items",   "x",     "y"};
    append(names, "at.", station_flags(line, k, Workers::kFixed, plan.station));
    plan.tasks = names.size();
    append(names, "does.", task_names(line));
    plan.feature = feature_count;
    plan.token = token_count;
    plan.width = names.size();
    plan.most = static_cast<std::size_t>(kind.count.max);
    for (std::size_t i = 0; i < plan.most; ++i) group.tokens.push_back(numbered(kind.name, i));
    group.features = {std::move(names)};
    feature_count += plan.width * plan.most;
    token_count += plan.most;
    workers.push_back(std::move(plan));
  }
}

void ObservationPlan::add_carriers(const LineModel& line) {
  for (const CarrierKind& kind : line.carrier_kinds) {
    TokenGroup& group = add_group(kind.name, TokenGroup::Encoder::kShared);
    Carriers plan;
    Names names{"free", "in_berth", "held", "items", "leaving", "coming"};
    append(names, "at.",
           station_flags(line, kind.moved_by.index(), Carriers::kFixed, plan.station));
    plan.materials = names.size();
    append(names, "has.", materials_of(line).names);
    plan.tasks = names.size();
    append(names, "in.", task_names(line));
    plan.feature = feature_count;
    plan.token = token_count;
    plan.width = names.size();
    const CountRange count =
        kind.count_as ? line.worker_kinds[kind.count_as->index()].count : kind.count;
    plan.most = static_cast<std::size_t>(count.max);
    plan.per_item = 1.0F / static_cast<float>(std::max(1, kind.capacity));
    for (std::size_t i = 0; i < plan.most; ++i) group.tokens.push_back(numbered(kind.name, i));
    group.features = {std::move(names)};
    feature_count += plan.width * plan.most;
    token_count += plan.most;
    carriers.push_back(std::move(plan));
  }
}

void ObservationPlan::add_operation(const Simulator& simulator, std::size_t operation,
                                    std::size_t feature, Names& names) {
  const std::string& name = simulator.line().operations[operation].name;
  const auto id = static_cast<std::int32_t>(operation);
  operations[operation].feature = feature;
  operations[operation].running_value = simulator.index_of({VariableKind::kOperationRunning, id});
  names.push_back(name + ".running");
  names.push_back(name + ".remaining");
}

void ObservationPlan::add_machines(const Simulator& simulator) {
  const LineModel& line = simulator.line();
  if (line.machines.empty()) return;
  TokenGroup& group = add_group("machines", TokenGroup::Encoder::kOwn);
  for (std::size_t m = 0; m < line.machines.size(); ++m) {
    const auto id = static_cast<std::int32_t>(m);
    MachineFeatures plan{
        .feature = feature_count,
        .free_value = simulator.index_of({VariableKind::kMachineFree, id}),
        .working_value = simulator.index_of({VariableKind::kMachineWorking, id}),
        .moves = !line.machines[m].positions.empty(),
    };
    Names names{"free", "working", "recovering", "homing"};
    append(names, "at.", line.machines[m].positions);
    for (std::size_t o = 0; o < line.operations.size(); ++o) {
      const MachineUse* use = machine_of(line.operations[o]);
      if (use == nullptr || use->machine.index() != m) continue;
      operations[o].machine = id;
      add_operation(simulator, o, feature_count + names.size(), names);
    }
    feature_count += names.size();
    ++token_count;
    group.tokens.push_back(line.machines[m].name);
    group.features.push_back(std::move(names));
    machines.push_back(plan);
  }
}

void ObservationPlan::add_materials(const Simulator& simulator) {
  const LineModel& line = simulator.line();
  const Materials materials = materials_of(line);
  if (materials.names.empty()) return;
  TokenGroup& group = add_group("materials", TokenGroup::Encoder::kOwn);
  places.resize(line.places.size());
  for (std::size_t m = 0; m < materials.names.size(); ++m) {
    Names names;
    for (std::size_t p = 0; p < line.places.size(); ++p) {
      if (materials.by_place[p] != static_cast<std::int16_t>(m)) continue;
      const Place& place = line.places[p];
      const auto id = static_cast<std::int32_t>(p);
      PlaceFeatures& plan = places[p];
      plan.feature = feature_count + names.size();
      plan.count_value = simulator.index_of({VariableKind::kPlaceCount, id});
      plan.available_value = simulator.index_of({VariableKind::kPlaceAvailable, id});
      plan.many = !place.capacity || *place.capacity > 1;
      if (plan.many) plan.most = std::min(place.capacity.value_or(kMostCounted), kMostCounted);
      plan.scale = 1.0F / static_cast<float>(plan.most);
      append(names, place.name + ".", {"count", "available"});
      if (plan.many) append(names, place.name + ".", {"any", "missing"});
    }
    for (std::size_t o = 0; o < line.operations.size(); ++o) {
      const Operation& operation = line.operations[o];
      if (machine_of(operation) != nullptr) continue;
      if (materials.by_place[place_of(operation)] != static_cast<std::int16_t>(m)) continue;
      add_operation(simulator, o, feature_count + names.size(), names);
    }
    feature_count += names.size();
    ++token_count;
    group.tokens.push_back(materials.names[m]);
    group.features.push_back(std::move(names));
  }
}

void ObservationPlan::add_tasks(const Simulator& simulator) {
  const LineModel& line = simulator.line();
  TokenGroup& group = add_group("tasks", TokenGroup::Encoder::kNamed);
  Names names{"selectable", "running", "missing", "since", "step", "joiner_missing"};
  for (const WorkerKind& kind : line.worker_kinds) {
    names.push_back("needs." + kind.name);
    names.push_back("way_of." + kind.name);
  }
  const std::size_t width = names.size();
  group.features = {std::move(names)};
  for (std::size_t t = 0; t < line.tasks.size(); ++t) {
    const auto id = static_cast<std::int32_t>(t);
    tasks.push_back({.feature = feature_count,
                     .running_value = simulator.index_of({VariableKind::kTaskRunning, id}),
                     .done_value = simulator.index_of({VariableKind::kTaskDone, id}),
                     .ways = first_ways(line.tasks[t])});
    group.tokens.push_back(line.tasks[t].name);
    spec.actions.push_back(line.tasks[t].name);
    feature_count += width;
    ++token_count;
  }
  if (!line.allow_wait) return;
  group.tokens.emplace_back("wait");  // no task is called so: it would be a name of the format
  spec.actions.emplace_back("wait");
  tasks.push_back({.feature = feature_count});
  feature_count += width;
  ++token_count;
}

void ObservationPlan::add_global(const Simulator& simulator) {
  const LineModel& line = simulator.line();
  global.finished_value =
      simulator.index_of({VariableKind::kPlaceCount, line.order.finished_in.value});
  TokenGroup& group = add_group("global", TokenGroup::Encoder::kOwn);
  Names names{"time_left", "missing"};
  for (const WorkerKind& kind : line.worker_kinds) {
    names.push_back(kind.name + ".there");
    names.push_back(kind.name + ".free");
    global.per_worker.push_back(1.0F / static_cast<float>(std::max(1, kind.count.max)));
  }
  global.feature = feature_count;
  feature_count += names.size();
  ++token_count;
  group.tokens.emplace_back("global");
  group.features.push_back(std::move(names));
}

void ObservationPlan::scale_positions(const LineModel& line) {
  double low_x = std::numeric_limits<double>::infinity();
  double low_y = low_x;
  double high_x = -low_x;
  double high_y = -low_x;
  for (const Station& station : line.stations) {
    for (const auto& pose : station.poses) {
      if (!pose) continue;
      low_x = std::min(low_x, pose->x_m);
      high_x = std::max(high_x, pose->x_m);
      low_y = std::min(low_y, pose->y_m);
      high_y = std::max(high_y, pose->y_m);
    }
  }
  if (!(low_x <= high_x)) return;
  x_middle = (low_x + high_x) / 2.0;
  y_middle = (low_y + high_y) / 2.0;
  x_scale = 2.0 / std::max(1.0, high_x - low_x);
  y_scale = 2.0 / std::max(1.0, high_y - low_y);
}

}  // namespace linewright
