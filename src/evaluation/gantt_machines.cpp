#include <fmt/format.h>

#include <optional>
#include <utility>

#include "gantt_rows.hpp"

namespace linewright::gantt {
namespace {

/// Why a machine that no operation works with is not free.
struct Held {
  Tick since = 0;
  std::string after;  ///< the operation that claimed it
};

/// Which task an operation belongs to, when a worker operates it.
struct Operator {
  std::optional<std::size_t> task;
  std::int32_t n = 0;
  std::string text;  ///< for the hover text
};

class MachineRows {
 public:
  MachineRows(const LogDocument& log, std::vector<GanttRow>& rows, std::size_t& budget)
      : log_(log), held_(rows.size()), decision_of_(log.header.workers.size(), 0) {
    for (GanttRow& row : rows) builders_.emplace_back(row, log.end.tick, budget);
  }

  void follow() {
    for (const LoggedEvent& event : log_.events) {
      now_ = event.tick;
      std::visit(*this, event.what);
    }
    for (std::size_t m = 0; m < held_.size(); ++m) {
      if (held_[m]) hold(MachineId(m), log_.end.tick, "after " + held_[m]->after);
    }
  }

  void operator()(const LoggedDecision& decision) {
    for (const LoggedRole& role : decision.crew) {
      for (const WorkerId worker : role.workers) decision_of_[worker.index()] = decision.n;
    }
  }
  void operator()(const LoggedJoin& join) { decision_of_[join.worker.index()] = join.n; }
  void operator()(const LoggedOperationStart& start) {
    const LogOperation& operation = log_.header.operations[start.operation.index()];
    const Operator by = operator_of(start);
    for (const MachineId machine : operation.uses) work(machine, operation, start.until, by);
    for (const MachineId machine : operation.frees) work(machine, operation, start.until, by);
    for (const MachineId machine : operation.uses) recover(machine, operation, start.until);
    for (const MachineId machine : operation.frees) recover(machine, operation, start.until);
    for (const MachineId machine : operation.claims) {
      work(machine, operation, start.until, by);
      held_[machine.index()] = Held{start.until, operation.name};
    }
  }
  template <class Other>
  void operator()(const Other& /*event*/) {}

 private:
  [[nodiscard]] Operator operator_of(const LoggedOperationStart& start) const {
    if (!start.worker) return {};
    const std::string& worker = log_.header.workers[start.worker->index()].id;
    const std::int32_t n = decision_of_[start.worker->index()];
    if (n == 0) return {{}, 0, " by " + worker};
    return {log_.decision(n).task.index(), n,
            fmt::format(" by {} · {}", worker, decision_title(log_, n))};
  }

  void work(MachineId machine, const LogOperation& operation, Tick until, const Operator& by) {
    if (const auto& held = held_[machine.index()]) {
      hold(machine, now_, fmt::format("between {} and {}", held->after, operation.name));
    }
    add(machine, {now_,
                  until,
                  GanttKind::kWorking,
                  by.task,
                  by.n,
                  operation.name,
                  operation.name + by.text,
                  {}});
  }

  void recover(MachineId machine, const LogOperation& operation, Tick from) {
    if (operation.recovery == 0) return;
    add(machine, {from,
                  from + operation.recovery,
                  GanttKind::kRecovering,
                  {},
                  0,
                  {},
                  "recovering after " + operation.name,
                  {}});
  }

  void hold(MachineId machine, Tick until, const std::string& why) {
    auto& held = held_[machine.index()];
    add(machine, {held->since, until, GanttKind::kHeld, {}, 0, {}, "held " + why, {}});
    held.reset();
  }

  void add(MachineId machine, GanttInterval interval) {
    interval.what = interval.text;
    interval.text = fmt::format("{} · {}", log_.header.machines[machine.index()], interval.text);
    builders_[machine.index()].add(std::move(interval));
  }

  const LogDocument& log_;
  std::vector<RowBuilder> builders_;
  std::vector<std::optional<Held>> held_;
  std::vector<std::int32_t> decision_of_;  ///< by worker: its latest decision, 0: none
  Tick now_ = 0;
};

}  // namespace

std::vector<GanttRow> machine_rows(const LogDocument& log, std::size_t& budget) {
  std::vector<GanttRow> rows;
  for (const std::string& machine : log.header.machines) rows.push_back({machine, {}});
  MachineRows(log, rows, budget).follow();
  return rows;
}

}  // namespace linewright::gantt
