#include <fmt/format.h>

#include <optional>
#include <utility>

#include "gantt_rows.hpp"

namespace linewright::gantt {
namespace {

/// Something a worker does within a task, as the log announces it.
struct Activity {
  Tick begin = 0;
  Tick end = 0;
  GanttKind kind = GanttKind::kWork;
  std::string what;
  std::string distance;            ///< of a way, else empty
  std::optional<StationId> leads;  ///< where a way ends
};

/// A worker's time in one task.
struct Binding {
  std::int32_t n = 0;
  Tick since = 0;
  StationId station;  ///< where it stood then
  std::vector<Activity> activities;
};

/// Follows the events and fills the rows, one binding after the other.
class WorkerRows {
 public:
  WorkerRows(const LogDocument& log, std::vector<GanttRow>& rows, std::size_t& budget)
      : log_(log),
        bindings_(rows.size()),
        carried_(rows.size()),
        holders_(log.header.carriers.size()),
        members_(log.decisions.size()) {
    for (GanttRow& row : rows) builders_.emplace_back(row, log.end.tick, budget);
    for (const LogWorker& worker : log.header.workers) stations_.push_back(worker.start);
  }

  void follow() {
    for (const LoggedEvent& event : log_.events) {
      now_ = event.tick;
      std::visit(*this, event.what);
    }
    now_ = log_.end.tick;
    for (std::size_t w = 0; w < bindings_.size(); ++w) leave(WorkerId(w));
  }

  void operator()(const LoggedDecision& decision) {
    for (const LoggedRole& role : decision.crew) {
      for (const WorkerId worker : role.workers) bind(worker, decision.n);
    }
  }
  void operator()(const LoggedJoin& join) { bind(join.worker, join.n); }
  void operator()(const LoggedRelease& release) { leave(release.worker); }
  void operator()(const LoggedTaskEnd& end) {
    for (const WorkerId worker : members_[static_cast<std::size_t>(end.n - 1)]) {
      const auto& binding = bindings_[worker.index()];
      if (binding && binding->n == end.n) leave(worker);
    }
  }
  void operator()(const LoggedGo& go) {
    // To where it stands already: nothing moves, even if the line asks a tick for it.
    if (go.from == go.to) return;
    add(go.worker, {go.departs, go.arrives, GanttKind::kTravel, way(go),
                    fmt::format(" · {:.1f} m", go.metres), go.to});
  }
  void operator()(const LoggedTransfer& transfer) {
    add(transfer.worker, {now_,
                          transfer.until,
                          GanttKind::kWork,
                          fmt::format("move {} {} → {}", material(transfer),
                                      end_name(transfer.from), end_name(transfer.to)),
                          {},
                          {}});
  }
  void operator()(const LoggedOperationStart& start) {
    if (!start.worker) return;
    add(*start.worker, {now_,
                        start.until,
                        GanttKind::kWork,
                        "operate " + log_.header.operations[start.operation.index()].name,
                        {},
                        {}});
  }
  void operator()(const LoggedPickUp& up) {
    auto& holder = holders_[up.carrier.index()];
    if (holder) carried_[holder->index()].reset();  // handed over
    holder = up.worker;
    carried_[up.worker.index()] = up.carrier;
  }
  void operator()(const LoggedPutDown& down) {
    carried_[down.worker.index()].reset();
    holders_[down.carrier.index()].reset();
  }
  template <class Other>
  void operator()(const Other& /*event*/) {}

 private:
  void bind(WorkerId worker, std::int32_t n) {
    leave(worker);
    bindings_[worker.index()] = Binding{n, now_, stations_[worker.index()], {}};
    members_[static_cast<std::size_t>(n - 1)].push_back(worker);
  }

  void add(WorkerId worker, Activity activity) {
    if (activity.leads) stations_[worker.index()] = *activity.leads;
    if (auto& binding = bindings_[worker.index()])
      binding->activities.push_back(std::move(activity));
  }

  /// Draws the worker's time in its task; what lies between its activities is waiting.
  void leave(WorkerId worker) {
    auto& binding = bindings_[worker.index()];
    if (!binding) return;
    RowBuilder& row = builders_[worker.index()];
    row.skip_to(binding->since);
    StationId station = binding->station;
    for (Activity& activity : binding->activities) {
      wait(worker, std::min(activity.begin, now_), station);
      activity.end = std::min(activity.end, now_);
      draw(worker, activity);
      if (activity.leads) station = *activity.leads;
    }
    wait(worker, now_, station);
    binding.reset();
  }

  void wait(WorkerId worker, Tick until, StationId station) {
    const std::string& name = log_.header.stations[station.index()].name;
    draw(worker, {builders_[worker.index()].filled(),
                  until,
                  GanttKind::kWaiting,
                  "wait at " + name,
                  {},
                  {}});
  }

  void draw(WorkerId worker, const Activity& activity) {
    const std::int32_t n = bindings_[worker.index()]->n;
    const TaskId task = log_.decision(n).task;
    GanttInterval interval{activity.begin, activity.end, activity.kind, task.index(), n, {}, {}};
    interval.label = log_.header.tasks[task.index()].name;
    interval.text = fmt::format("{} · {} · {}", log_.header.workers[worker.index()].id,
                                decision_title(log_, n), activity.what);
    builders_[worker.index()].add(std::move(interval), activity.distance);
  }

  [[nodiscard]] std::string way(const LoggedGo& go) const {
    const LogWorker& worker = log_.header.workers[go.worker.index()];
    std::string text = fmt::format("{} {} → {}", worker.kind == "human" ? "walk" : "drive",
                                   log_.header.stations[go.from.index()].name,
                                   log_.header.stations[go.to.index()].name);
    if (const auto& carrier = carried_[go.worker.index()]) {
      text += " with " + log_.header.carriers[carrier->index()].id;
    }
    return text;
  }

  [[nodiscard]] std::string end_name(const LoggedTransfer::End& end) const {
    if (const auto* place = std::get_if<PlaceId>(&end))
      return log_.header.places[place->index()].name;
    return log_.header.carriers[std::get<CarrierId>(end).index()].id;
  }

  [[nodiscard]] std::string material(const LoggedTransfer& transfer) const {
    for (const auto* end : {&transfer.from, &transfer.to}) {
      if (const auto* place = std::get_if<PlaceId>(end))
        return log_.header.places[place->index()].of;
    }
    return "item";
  }

  const LogDocument& log_;
  std::vector<RowBuilder> builders_;
  std::vector<std::optional<Binding>> bindings_;
  std::vector<StationId> stations_;                ///< where each worker stands or is going
  std::vector<std::optional<CarrierId>> carried_;  ///< by worker
  std::vector<std::optional<WorkerId>> holders_;   ///< by carrier
  std::vector<std::vector<WorkerId>> members_;     ///< by decision
  Tick now_ = 0;
};

}  // namespace

std::vector<GanttRow> worker_rows(const LogDocument& log, std::size_t& budget) {
  std::vector<GanttRow> rows;
  for (const LogWorker& worker : log.header.workers) rows.push_back({worker.id, {}});
  WorkerRows(log, rows, budget).follow();
  return rows;
}

}  // namespace linewright::gantt
