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
  bool until_next = false;         ///< it ends when the next one begins
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
        resting_(rows.size()),
        closed_(log.header.zones.size(), false),
        changed_(log.header.zones.size()),
        carried_(rows.size()),
        holders_(log.header.carriers.size()),
        members_(log.decisions.size()) {
    for (GanttRow& row : rows) builders_.emplace_back(row, log.end.tick, budget);
    for (const LogWorker& worker : log.header.workers) stations_.push_back(worker.start);
  }

  void follow() {
    for (const LoggedEvent& event : log_.events) {
      if (event.tick != now_) changed_.assign(changed_.size(), std::nullopt);
      now_ = event.tick;
      std::visit(*this, event.what);
    }
    now_ = log_.end.tick;
    for (std::size_t w = 0; w < bindings_.size(); ++w) {
      draw_rest(WorkerId(w));
      leave(WorkerId(w));
    }
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
    set_out(go.worker, {go.departs, go.arrives, GanttKind::kTravel,
                        way(go.worker, station_name(go.from), go.to),
                        fmt::format(" · {:.1f} m", go.metres), go.to});
  }
  void operator()(const LoggedReroute& go) {
    set_out(go.worker,
            {go.departs, go.arrives, GanttKind::kTravel, way(go.worker, "", go.to) + cause(),
             fmt::format(" · {:.1f} m", go.metres), go.to});
  }
  void operator()(const LoggedBlocked& blocked) {
    set_out(blocked.worker, {now_,
                             now_,
                             GanttKind::kWaiting,
                             fmt::format("wait for a way to {}: zone {} closed",
                                         station_name(blocked.to), closed_zones()),
                             {},
                             {},
                             true});
  }
  void operator()(const LoggedZone& zone) {
    closed_[zone.zone.index()] = zone.closed;
    changed_[zone.zone.index()] = zone.closed;
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
    const std::optional<Activity> rest = draw_rest(worker);
    bindings_[worker.index()] = Binding{n, now_, stations_[worker.index()], {}};
    if (rest) add(worker, *rest);
    members_[static_cast<std::size_t>(n - 1)].push_back(worker);
  }

  void add(WorkerId worker, Activity activity) {
    if (activity.leads) stations_[worker.index()] = *activity.leads;
    if (auto& binding = bindings_[worker.index()])
      binding->activities.push_back(std::move(activity));
  }

  /// A way, or waiting for one: what the worker was on its way to ends here.
  void set_out(WorkerId worker, Activity activity) {
    auto& binding = bindings_[worker.index()];
    if (!binding) {
      draw_rest(worker);
      if (activity.leads) stations_[worker.index()] = *activity.leads;
      resting_[worker.index()] = std::move(activity);
      return;
    }
    if (!binding->activities.empty()) {
      Activity& last = binding->activities.back();
      if (last.kind == GanttKind::kTravel && last.end > now_) {
        last.end = now_;
        last.distance.clear();
      }
    }
    add(worker, std::move(activity));
  }

  /// Draws the way to rest of a worker without a task, up to now; returns what is left of it.
  std::optional<Activity> draw_rest(WorkerId worker) {
    std::optional<Activity> rest = std::exchange(resting_[worker.index()], std::nullopt);
    if (!rest) return std::nullopt;
    GanttInterval interval{rest->begin, rest->until_next ? now_ : std::min(rest->end, now_),
                           rest->kind,  {},
                           0,           "rest",
                           {},          rest->what};
    interval.text =
        fmt::format("{} · to rest · {}", log_.header.workers[worker.index()].id, rest->what);
    builders_[worker.index()].add(std::move(interval),
                                  rest->end <= now_ ? rest->distance : std::string());
    if (!rest->until_next && rest->end <= now_) return std::nullopt;
    rest->begin = now_;
    rest->distance.clear();
    return rest;
  }

  /// Draws the worker's time in its task; what lies between its activities is waiting.
  void leave(WorkerId worker) {
    auto& binding = bindings_[worker.index()];
    if (!binding) return;
    RowBuilder& row = builders_[worker.index()];
    row.skip_to(binding->since);
    StationId station = binding->station;
    for (std::size_t i = 0; i < binding->activities.size(); ++i) {
      Activity& activity = binding->activities[i];
      if (activity.until_next) {
        const bool more = i + 1 < binding->activities.size();
        activity.end = more ? binding->activities[i + 1].begin : now_;
      }
      wait(worker, std::min(activity.begin, now_), station);
      activity.end = std::min(activity.end, now_);
      draw(worker, activity);
      if (activity.leads) station = *activity.leads;
    }
    wait(worker, now_, station);
    binding.reset();
  }

  void wait(WorkerId worker, Tick until, StationId station) {
    const std::string& name = station_name(station);
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
    GanttInterval interval{activity.begin, activity.end, activity.kind, task.index(), n, {}, {},
                           activity.what};
    interval.label = log_.header.tasks[task.index()].name;
    interval.text = fmt::format("{} · {} · {}", log_.header.workers[worker.index()].id,
                                decision_title(log_, n), activity.what);
    builders_[worker.index()].add(std::move(interval), activity.distance);
  }

  /// From a station, or (`from` empty) from between two.
  [[nodiscard]] std::string way(WorkerId id, const std::string& from, StationId to) const {
    const LogWorker& worker = log_.header.workers[id.index()];
    std::string text = fmt::format("{} {}{}→ {}", worker.kind == "human" ? "walk" : "drive", from,
                                   from.empty() ? "" : " ", station_name(to));
    if (const auto& carrier = carried_[id.index()]) {
      text += " with " + log_.header.carriers[carrier->index()].id;
    }
    return text;
  }

  [[nodiscard]] const std::string& station_name(StationId id) const {
    return log_.header.stations[id.index()].name;
  }

  /// " · re-routed: zone ramp closed", when a zone has just changed.
  [[nodiscard]] std::string cause() const {
    std::string text;
    for (std::size_t zone = 0; zone < changed_.size(); ++zone) {
      if (!changed_[zone]) continue;
      text += fmt::format("{}zone {} {}", text.empty() ? " · re-routed: " : ", ",
                          log_.header.zones[zone].name, *changed_[zone] ? "closed" : "opened");
    }
    return text;
  }

  [[nodiscard]] std::string closed_zones() const {
    std::string names;
    for (std::size_t zone = 0; zone < closed_.size(); ++zone) {
      if (closed_[zone]) names += (names.empty() ? "" : ", ") + log_.header.zones[zone].name;
    }
    return names;
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
  std::vector<std::optional<Activity>> resting_;   ///< by worker without a task: its way
  std::vector<bool> closed_;                       ///< by zone
  std::vector<std::optional<bool>> changed_;       ///< by zone: to what, in this tick
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
