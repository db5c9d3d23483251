#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <iosfwd>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "linewright/base/diagnostic.hpp"
#include "linewright/base/geometry.hpp"
#include "linewright/base/id.hpp"
#include "linewright/base/tick.hpp"
#include "linewright/line/workers.hpp"
#include "linewright/simulation/state.hpp"

// An event log (docs/formats/event_log.md) read back, without the scenario it came from. Ids index
// the lists of this document's header; they agree with the line's for machines, places, operations
// and tasks, but not for stations, which are sorted by name.

namespace linewright {

/// A kind of worker, as far as it is drawn.
struct LogKind {
  std::string name;
  double radius_m = 0.3;            ///< of a worker without footprint and outline
  std::vector<double> footprint_m;  ///< {length, width}, or empty
  std::vector<Point2> outline_m;    ///< around the pose, x forward, or empty
  std::optional<double> speed_mps;
};

struct LogWorker {
  std::string id;
  std::string kind;
  StationId start;
};

struct LogCarrier {
  std::string id;
  std::string kind;
  std::int32_t capacity = 1;
  StationId start;
};

struct LogStation {
  std::string name;
  std::map<std::string, Pose2> poses;  ///< by kind of worker
};

struct LogPlace {
  std::string name;
  std::string of;
  std::int64_t initial = 0;
  std::optional<std::int64_t> capacity;
  std::string berth;  ///< kind of carrier; empty: not a berth
  std::optional<StationId> at;
};

struct LogTokens {
  PlaceId place;
  std::int64_t count = 1;
};

/// Where a machine is and how it looks, as far as the log says.
struct LogMachineSite {
  std::optional<StationId> at;
  std::vector<std::string> positions;  ///< where it can stand
  std::vector<Point2> area_m;          ///< three corners at least, or empty
};

struct LogOperation {
  std::string name;
  Tick takes = 0;
  Tick recovery = 0;
  std::vector<MachineId> uses;
  std::vector<MachineId> claims;
  std::vector<MachineId> frees;
  std::vector<LogTokens> consumes;
  std::vector<LogTokens> produces;
};

struct LogTask {
  std::int32_t number = 0;
  std::string name;
};

struct LogRectangle {
  double x0_m = 0.0;
  double x1_m = 0.0;
  double y0_m = 0.0;
  double y1_m = 0.0;
};

struct LogObstacle {
  std::string name;
  std::vector<Point2> polygon;  ///< three corners at least
  double height_m = 1.0;
};

struct LogHall {
  LogRectangle bounds;
  std::vector<LogObstacle> obstacles;
};

struct LogZone {
  std::string name;
  std::vector<Point2> polygon;
  std::vector<std::pair<Tick, Tick>> closed;  ///< first tick, first tick in which it is open again
};

struct LogHeader {
  std::string line;
  std::string scenario_hash;
  double tick_s = 1.0;
  Tick horizon = 0;
  std::string product;
  std::int64_t quantity = 0;
  PlaceId finished_in;
  std::vector<LogKind> kinds;  ///< of workers, by name; empty: the log does not say
  std::vector<LogWorker> workers;
  std::vector<LogCarrier> carriers;
  std::vector<LogStation> stations;
  std::vector<LogPlace> places;
  std::vector<std::string> machines;
  std::vector<LogMachineSite> machine_sites;  ///< by machine
  std::vector<LogOperation> operations;
  std::vector<LogTask> tasks;
  std::vector<LogZone> zones;
  std::optional<LogHall> hall;
};

/// Who fills one role of a crew; nobody: a late joiner.
struct LoggedRole {
  std::string role;
  std::vector<WorkerId> workers;
  std::vector<CarrierId> carriers;
};

// What can happen. `n` is the number of the decision whose task it belongs to (0, where a worker
// may be in no task: it is on its way to rest).

struct LoggedDecision {
  std::int32_t n = 0;
  TaskId task;
  std::vector<LoggedRole> crew;
};
struct LoggedJoin {
  std::int32_t n = 0;
  WorkerId worker;
  std::string role;
};
struct LoggedGo {
  std::int32_t n = 0;
  WorkerId worker;
  StationId from;
  StationId to;
  Tick departs = 0;
  Tick arrives = 0;
  double metres = 0.0;
  std::vector<WayPoint> path;  ///< empty: the straight line
};
struct LoggedReroute {
  std::int32_t n = 0;
  WorkerId worker;
  Pose2 pose;
  StationId to;
  Tick departs = 0;
  Tick arrives = 0;
  double metres = 0.0;
  std::vector<WayPoint> path;
};
struct LoggedBlocked {
  WorkerId worker;
  Pose2 pose;
  StationId to;
};
struct LoggedZone {
  ZoneId zone;
  bool closed = false;
};
struct LoggedPickUp {
  std::int32_t n = 0;
  WorkerId worker;
  CarrierId carrier;
};
struct LoggedPutDown {
  std::int32_t n = 0;
  WorkerId worker;
  CarrierId carrier;
  StationId station;
  std::optional<PlaceId> berth;
};
struct LoggedBerth {
  std::int32_t n = 0;
  CarrierId carrier;
  PlaceId berth;
};
struct LoggedTransfer {
  using End = std::variant<PlaceId, CarrierId>;

  std::int32_t n = 0;
  WorkerId worker;
  End from;
  End to;
  Tick until = 0;
};
struct LoggedOperationStart {
  OperationId operation;
  Tick until = 0;
  std::optional<WorkerId> worker;
};
struct LoggedOperationEnd {
  OperationId operation;
};
struct LoggedRecoveryEnd {
  OperationId operation;
};
struct LoggedRelease {
  std::int32_t n = 0;
  WorkerId worker;
};
struct LoggedTaskEnd {
  std::int32_t n = 0;
  TaskId task;
};
struct LoggedMilestone {
  std::string name;
};

struct LoggedEvent {
  using What = std::variant<LoggedDecision, LoggedJoin, LoggedGo, LoggedPickUp, LoggedPutDown,
                            LoggedBerth, LoggedTransfer, LoggedOperationStart, LoggedOperationEnd,
                            LoggedRecoveryEnd, LoggedRelease, LoggedTaskEnd, LoggedMilestone,
                            LoggedReroute, LoggedBlocked, LoggedZone>;

  Tick tick = 0;
  What what;
};

/// How the run ended.
struct LoggedEnd {
  Tick tick = 0;
  RunStatus status = RunStatus::kFinished;  ///< kFinished, kDeadlock or kHorizon; of a log that is
                                            ///< cut off kRunning
  std::optional<Tick> makespan;
  double progress = 0.0;  ///< 0 ... 1
};

/// One run. Every id is valid, ticks never run backwards, decisions are numbered 1, 2, 3, ... and
/// every `n` is that of an earlier decision; a zone closes only when open and opens when closed.
/// Ends of ways, transfers and operations are not before their beginning; they may lie beyond the
/// end of the run.
struct LogDocument {
  LogHeader header;
  std::vector<LoggedEvent> events;
  LoggedEnd end;
  std::vector<std::size_t> decisions;  ///< index into events; decision n is decisions[n - 1]
  std::optional<Diagnostic> cut_off;   ///< where and how the log breaks off; none: it is complete

  [[nodiscard]] const LoggedDecision& decision(std::int32_t n) const {
    return std::get<LoggedDecision>(events[decisions[static_cast<std::size_t>(n - 1)]].what);
  }
};

/// Longest line and deepest nesting that are read; real logs stay far below.
inline constexpr std::size_t kLongestLogLine = 16U << 20U;
inline constexpr int kDeepestLogNesting = 64;

/// What to do with a log that breaks off before its end: a run that was stopped, or goes on.
enum class CutOffLog {
  kRefuse,  ///< throw ScenarioError
  kAccept,  ///< read what is there: LogDocument::cut_off is set, and `end` is the last event's tick
};

/// Reads a log; `file_name` is for messages. Throws ScenarioError naming file and line when the
/// input is not a complete log of this format. Keys it does not know are ignored.
[[nodiscard]] LogDocument read_event_log(std::istream& stream, const std::string& file_name,
                                         CutOffLog cut_off = CutOffLog::kRefuse);

/// Opens and reads the file. Throws ScenarioError, also when it cannot be read.
[[nodiscard]] LogDocument load_event_log(const std::string& file,
                                         CutOffLog cut_off = CutOffLog::kRefuse);

}  // namespace linewright
