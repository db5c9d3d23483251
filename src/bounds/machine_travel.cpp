#include <algorithm>
#include <array>

#include "line_net.hpp"

namespace linewright::bounds {
namespace {

std::size_t at(std::int32_t id) { return static_cast<std::size_t>(id); }

/// (homing ticks to go, position), ascending.
std::vector<std::pair<Tick, std::int32_t>> homing_points(const Machine& machine) {
  std::vector<std::pair<Tick, std::int32_t>> points{{0, machine.homing->home}};
  for (std::size_t p = 0; p < machine.positions.size(); ++p) {
    if (machine.homing->takes[p] > 0)
      points.emplace_back(machine.homing->takes[p], static_cast<std::int32_t>(p));
  }
  std::sort(points.begin(), points.end());
  return points;
}

}  // namespace

Tick machine_travel(const Machine& machine, std::int32_t from, std::int32_t target, Tick waited) {
  const auto& travel = machine.travel[at(target)];
  const Tick standing = std::max(0, travel[at(from)]);
  if (!machine.homing || machine.homing->takes[at(from)] <= 0 || waited < machine.homing->holds)
    return standing;
  const Tick to_go = std::max(0, machine.homing->takes[at(from)] - waited);
  const auto points = homing_points(machine);
  const auto upper = std::find_if(points.begin(), points.end(),
                                  [&](const auto& point) { return point.first >= to_go; });
  const std::int64_t high = travel[at(upper->second)];
  if (upper->first == to_go || high < 0) return static_cast<Tick>(std::max<std::int64_t>(0, high));
  const auto lower = std::prev(upper);
  const std::int64_t low = travel[at(lower->second)];
  if (low < 0) return standing;
  const std::int64_t span = upper->first - lower->first;
  const std::int64_t weight = to_go - lower->first;
  return static_cast<Tick>((low * (span - weight) + high * weight) / span);
}

Tick least_setup(const Machine& machine, std::int32_t from, std::int32_t target, Tick held) {
  if (machine.travel.empty()) return held;
  Tick best = held + machine_travel(machine, from, target, held);
  const Tick homed =
      machine.homing ? std::max(0, machine.homing->takes[at(from)]) + machine.homing->holds : 0;
  for (Tick waited = held; waited <= homed; ++waited)
    best = std::min(best, waited + machine_travel(machine, from, target, waited));
  return best;
}

std::vector<std::int32_t> rest_positions(const LineModel& line, MachineId machine) {
  std::vector<std::int32_t> positions{line.machines[machine.index()].start};
  bool unmoved = false;  // some operation lets it go where the one that claimed it left it
  std::vector<std::int32_t> claimed;
  for (const Operation& operation : line.operations) {
    for (const auto* list : {&operation.uses, &operation.frees, &operation.claims}) {
      for (const MachineUse& use : *list) {
        if (use.machine != machine) continue;
        const auto stands = use.to ? use.to : use.from;
        if (!stands) {
          unmoved = unmoved || list == &operation.frees;
        } else {
          (list == &operation.claims ? claimed : positions).push_back(*stands);
        }
      }
    }
  }
  if (unmoved) positions.insert(positions.end(), claimed.begin(), claimed.end());
  std::sort(positions.begin(), positions.end());
  positions.erase(std::unique(positions.begin(), positions.end()), positions.end());
  return positions;
}

Tick least_travel(const LineModel& line, const Operation& operation) {
  Tick longest = 0;
  for (const auto* list : {&operation.uses, &operation.claims, &operation.frees}) {
    for (const MachineUse& use : *list) {
      if (!use.from) continue;
      const Machine& machine = line.machines[use.machine.index()];
      std::vector<std::int32_t> from = rest_positions(line, use.machine);
      if (list == &operation.frees) {  // it stands where the operation that claimed it left it
        for (std::size_t p = 0; p < machine.positions.size(); ++p)
          from.push_back(static_cast<std::int32_t>(p));
      }
      Tick least = kMaxTicks;
      for (const std::int32_t position : from) {
        const Tick homed = machine.homing ? std::max(0, machine.homing->takes[at(position)]) +
                                                machine.homing->holds
                                          : 0;
        for (Tick waited = 0; waited <= homed; ++waited)
          least = std::min(least, machine_travel(machine, position, *use.from, waited));
      }
      longest = std::max(longest, least);
    }
  }
  return longest;
}

}  // namespace linewright::bounds
