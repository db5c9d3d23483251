#include "linewright/evaluation/hall_scene.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

#include "gantt_rows.hpp"
#include "linewright/line/way_finder.hpp"

namespace linewright {
namespace {

constexpr Tick kNever = std::numeric_limits<Tick>::max();

/// The way that a worker is on, or where it stands when `departs` is never.
struct Motion {
  Pose2 from;
  Pose2 to;
  std::vector<WayPoint> path;  ///< empty: the straight line
  Tick departs = kNever;
  Tick arrives = kNever;

  [[nodiscard]] Pose2 at(Tick tick) const {
    if (tick >= arrives) return to;
    if (tick <= departs) return from;
    const double share = part(tick);
    if (!path.empty()) return pose_on(path, share);
    return {from.x_m + share * (to.x_m - from.x_m), from.y_m + share * (to.y_m - from.y_m),
            std::atan2(to.y_m - from.y_m, to.x_m - from.x_m)};
  }

  [[nodiscard]] bool moving(Tick tick) const { return tick > departs && tick < arrives; }

  /// From the pose at `tick` to the end; empty when nothing is left or it has no way.
  [[nodiscard]] std::vector<Point2> ahead(Tick tick) const {
    if (departs == kNever || tick >= arrives) return {};
    std::vector<Point2> line{at(tick).point()};
    const double share = tick <= departs ? 0.0 : part(tick);
    for (const WayPoint& point : path) {
      if (point.share > share) line.push_back(point.pose.point());
    }
    if (path.empty()) line.push_back(to.point());
    return line;
  }

 private:
  [[nodiscard]] double part(Tick tick) const {
    return static_cast<double>(tick - departs) / static_cast<double>(arrives - departs);
  }
};

/// Follows the events up to a tick.
class Stage {
 public:
  Stage(const LogDocument& log, Tick tick)
      : log_(log), motions_(log.header.workers.size()), held_in_(log.header.places.size()) {
    scene_.tick = std::min(tick, log.end.tick);
    scene_.workers.resize(log.header.workers.size());
    scene_.carriers.resize(log.header.carriers.size());
    scene_.closed.assign(log.header.zones.size(), false);
    for (const LogPlace& place : log.header.places) scene_.tokens.push_back(place.initial);
    place_everyone();
  }

  HallScene play() {
    for (const LoggedEvent& event : log_.events) {
      if (event.tick > scene_.tick) break;
      put_down_until(event.tick);
      std::visit(*this, event.what);
    }
    put_down_until(scene_.tick);
    take_poses();
    take_activities();
    return std::move(scene_);
  }

  void operator()(const LoggedDecision& decision) {
    scene_.decisions = decision.n;
    for (const LoggedRole& role : decision.crew) {
      for (const CarrierId carrier : role.carriers) leave_berth(carrier);
    }
  }
  void operator()(const LoggedGo& go) {
    const std::string& kind = kind_of(go.worker);
    set_out(go, pose_at(go.from, kind));
  }
  void operator()(const LoggedReroute& go) { set_out(go, go.pose); }
  void operator()(const LoggedBlocked& blocked) {
    motions_[blocked.worker.index()] = {.from = blocked.pose, .to = blocked.pose, .path = {}};
    scene_.workers[blocked.worker.index()].station = blocked.to;
  }
  void operator()(const LoggedZone& zone) { scene_.closed[zone.zone.index()] = zone.closed; }
  void operator()(const LoggedPickUp& up) {
    SceneCarrier& carrier = scene_.carriers[up.carrier.index()];
    if (carrier.holder) scene_.workers[carrier.holder->index()].carrier.reset();
    carrier.holder = up.worker;
    scene_.workers[up.worker.index()].carrier = up.carrier;
  }
  void operator()(const LoggedPutDown& down) {
    SceneCarrier& carrier = scene_.carriers[down.carrier.index()];
    carrier.holder.reset();
    carrier.station = down.station;
    carrier.pose = pose_at(down.station, kind_of(down.worker));
    scene_.workers[down.worker.index()].carrier.reset();
    if (down.berth) enter_berth(down.carrier, *down.berth);
  }
  void operator()(const LoggedBerth& berth) { enter_berth(berth.carrier, berth.berth); }
  void operator()(const LoggedTransfer& transfer) {
    in_hand_.emplace(transfer.until, std::pair{transfer.from, transfer.to});
  }
  void operator()(const LoggedOperationStart& start) {
    for (const LogTokens& flow : log_.header.operations[start.operation.index()].consumes) {
      add(flow.place, -flow.count);
    }
  }
  void operator()(const LoggedOperationEnd& end) {
    for (const LogTokens& flow : log_.header.operations[end.operation.index()].produces) {
      add(flow.place, flow.count);
    }
  }
  template <class Other>
  void operator()(const Other& /*event*/) {}

 private:
  [[nodiscard]] const std::string& kind_of(WorkerId worker) const {
    return log_.header.workers[worker.index()].kind;
  }

  /// Where workers of the kind stand at the station; where others do when the log does not say.
  [[nodiscard]] Pose2 pose_at(StationId station, const std::string& kind) const {
    const auto& poses = log_.header.stations[station.index()].poses;
    const auto own = poses.find(kind);
    if (own != poses.end()) return own->second;
    return poses.empty() ? Pose2{} : poses.begin()->second;
  }

  void place_everyone() {
    for (std::size_t w = 0; w < motions_.size(); ++w) {
      const LogWorker& worker = log_.header.workers[w];
      const Pose2 pose = pose_at(worker.start, worker.kind);
      motions_[w] = {.from = pose, .to = pose, .path = {}};
      scene_.workers[w].station = worker.start;
    }
    const std::map<std::string, std::string> movers = movers_of_carriers();
    for (std::size_t c = 0; c < scene_.carriers.size(); ++c) {
      const LogCarrier& carrier = log_.header.carriers[c];
      const auto mover = movers.find(carrier.kind);
      SceneCarrier& placed = scene_.carriers[c];
      placed.moved_by = mover == movers.end() ? "robot" : mover->second;
      placed.station = carrier.start;
      placed.pose = pose_at(carrier.start, placed.moved_by);
    }
  }

  /// By kind of carrier, the kind of worker that moves it: the header does not say.
  [[nodiscard]] std::map<std::string, std::string> movers_of_carriers() const {
    std::map<std::string, std::string> movers;
    for (const LoggedEvent& event : log_.events) {
      const auto* up = std::get_if<LoggedPickUp>(&event.what);
      if (up == nullptr) continue;
      movers.emplace(log_.header.carriers[up->carrier.index()].kind, kind_of(up->worker));
    }
    return movers;
  }

  template <class Go>
  void set_out(const Go& go, Pose2 from) {
    motions_[go.worker.index()] = {.from = from,
                                   .to = pose_at(go.to, kind_of(go.worker)),
                                   .path = go.path,
                                   .departs = go.departs,
                                   .arrives = go.arrives};
    scene_.workers[go.worker.index()].station = go.to;
  }

  void enter_berth(CarrierId carrier, PlaceId berth) {
    held_in_[berth.index()] = carrier;
    scene_.carriers[carrier.index()].berth = berth;
  }

  void leave_berth(CarrierId carrier) {
    auto& berth = scene_.carriers[carrier.index()].berth;
    if (berth && held_in_[berth->index()] == carrier) held_in_[berth->index()].reset();
    berth.reset();
  }

  /// Items moved by hand count at their source until they are put down.
  void put_down_until(Tick tick) {
    while (!in_hand_.empty() && in_hand_.begin()->first <= tick) {
      const auto [from, to] = in_hand_.begin()->second;
      in_hand_.erase(in_hand_.begin());
      const std::string material = material_of(from, to);
      std::visit([&](const auto where) { add(where, -1, material); }, from);
      std::visit([&](const auto where) { add(where, +1, material); }, to);
    }
  }

  [[nodiscard]] std::string material_of(const LoggedTransfer::End& from,
                                        const LoggedTransfer::End& to) const {
    for (const auto& end : {from, to}) {
      if (const auto* place = std::get_if<PlaceId>(&end)) {
        return log_.header.places[place->index()].of;
      }
    }
    return scene_.carriers[std::get<CarrierId>(from).index()].of;
  }

  void add(PlaceId place, std::int64_t count, const std::string& /*material*/ = {}) {
    if (log_.header.places[place.index()].berth.empty()) {
      scene_.tokens[place.index()] += count;
    } else if (const auto& carrier = held_in_[place.index()]) {
      add(*carrier, count, log_.header.places[place.index()].of);
    }
  }
  void add(CarrierId id, std::int64_t count, const std::string& material) {
    SceneCarrier& carrier = scene_.carriers[id.index()];
    carrier.items += count;
    if (count > 0) carrier.of = material;
    if (carrier.items <= 0) carrier.of.clear();
  }

  void take_poses() {
    for (std::size_t w = 0; w < motions_.size(); ++w) {
      SceneWorker& worker = scene_.workers[w];
      worker.pose = motions_[w].at(scene_.tick);
      worker.moving = motions_[w].moving(scene_.tick);
      worker.ahead = motions_[w].ahead(scene_.tick);
    }
    for (SceneCarrier& carrier : scene_.carriers) {
      if (carrier.holder) carrier.pose = scene_.workers[carrier.holder->index()].pose;
    }
    for (std::size_t p = 0; p < scene_.tokens.size(); ++p) {
      if (log_.header.places[p].berth.empty()) continue;
      const auto& carrier = held_in_[p];
      scene_.tokens[p] = carrier ? scene_.carriers[carrier->index()].items : 0;
    }
  }

  void take_activities() {
    std::size_t budget = std::numeric_limits<std::size_t>::max();
    const auto at_tick = [&](const GanttRow& row) -> std::optional<GanttInterval> {
      for (const GanttInterval& interval : row.intervals) {
        if (interval.begin <= scene_.tick && scene_.tick < interval.end) return interval;
      }
      return std::nullopt;
    };
    const std::vector<GanttRow> workers = gantt::worker_rows(log_, budget);
    for (std::size_t w = 0; w < workers.size(); ++w) scene_.workers[w].doing = at_tick(workers[w]);
    for (const GanttRow& row : gantt::machine_rows(log_, budget)) {
      scene_.machines.push_back(at_tick(row));
    }
  }

  const LogDocument& log_;
  HallScene scene_;
  std::vector<Motion> motions_;                    ///< by worker
  std::vector<std::optional<CarrierId>> held_in_;  ///< by berth: the carrier that counts as there
  std::multimap<Tick, std::pair<LoggedTransfer::End, LoggedTransfer::End>> in_hand_;
};

}  // namespace

HallScene hall_scene(const LogDocument& log, Tick tick) { return Stage(log, tick).play(); }

}  // namespace linewright
