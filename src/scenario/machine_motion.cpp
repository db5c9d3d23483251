#include "machine_motion.hpp"

#include <algorithm>
#include <cstddef>

namespace linewright::loading {
namespace {

const MachineUse* find_use(const std::vector<MachineUse>& uses, MachineId machine) {
  const auto found = std::find_if(uses.begin(), uses.end(),
                                  [&](const MachineUse& use) { return use.machine == machine; });
  return found == uses.end() ? nullptr : &*found;
}

/// Adds to `ends` where the machine stands after `use` when it began at one of `starts`. True when
/// that is news.
bool follow(const MachineUse* use, const std::vector<bool>& starts, std::vector<bool>& ends) {
  if (use == nullptr) return false;
  bool changed = false;
  for (std::size_t i = 0; i < starts.size(); ++i) {
    if (!starts[i]) continue;
    const auto end =
        static_cast<std::size_t>(use->to.value_or(use->from.value_or(static_cast<int>(i))));
    changed = changed || !ends[end];
    ends[end] = true;
  }
  return changed;
}

bool drive_home(const Machine& machine, std::vector<bool>& idle) {
  if (!machine.homing) return false;
  const auto home = static_cast<std::size_t>(machine.homing->home);
  if (idle[home]) return false;
  for (std::size_t i = 0; i < idle.size(); ++i) {
    if (idle[i] && machine.homing->takes[i] >= 0) idle[home] = true;
  }
  return idle[home];
}

}  // namespace

MachineMotion machine_motion(const LineModel& line, MachineId id) {
  const Machine& machine = line.machines[id.index()];
  MachineMotion motion{std::vector<bool>(machine.positions.size(), false),
                       std::vector<bool>(machine.positions.size(), false)};
  if (machine.positions.empty()) return motion;
  motion.idle[static_cast<std::size_t>(machine.start)] = true;
  bool changed = true;
  while (changed) {
    changed = drive_home(machine, motion.idle);
    for (const Operation& operation : line.operations) {
      changed |= follow(find_use(operation.uses, id), motion.idle, motion.idle);
      changed |= follow(find_use(operation.claims, id), motion.idle, motion.held);
      changed |= follow(find_use(operation.frees, id), motion.held, motion.idle);
    }
  }
  return motion;
}

std::vector<bool> called_from(const Machine& machine, const MachineMotion& motion) {
  std::vector<bool> positions = motion.idle;
  if (!machine.homing) return positions;
  Tick longest = -1;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    if (motion.idle[i]) longest = std::max(longest, machine.homing->takes[i]);
  }
  for (std::size_t i = 0; i < positions.size(); ++i) {
    const Tick takes = machine.homing->takes[i];
    if (takes >= 0 && takes <= longest) positions[i] = true;
  }
  return positions;
}

}  // namespace linewright::loading
