#pragma once

#include <map>
#include <optional>
#include <vector>

#include "line_net.hpp"

namespace linewright::bounds {

/// Where the carriers of a berth stand: at the station to which all workers drive that park there;
/// none when that is not always the same.
[[nodiscard]] std::optional<StationId> station_of_berth(const LineModel& line, PlaceId berth);

/// The longest chain of lags from one event of a task to a later one, `more` ticks longer on the
/// ways into some of them; none: it does not follow.
[[nodiscard]] std::optional<Tick> longest_lag(const EventNet& net, const TaskEvents& task, int from,
                                              int to, const std::map<int, Tick>& more = {});

/// Makes the events of one task.
class TaskNet {
 public:
  TaskNet(LineNet& net, TaskId task);
  void build();

 private:
  /// What is known of a member of the crew after the actions so far.
  struct Member {
    std::optional<StationId> stands;
    std::optional<std::size_t> holds;  ///< crew slot of the carrier it has
    Tick settling = 0;                 ///< sum of its `before` and `after` so far
    bool gone = false;
    int joined = -1;  ///< late joiners: the event before which it does nothing
  };
  /// A transfer of this task into one of its carriers.
  struct Loading {
    std::size_t slot = 0;
    std::size_t step = 0;
    std::size_t sequence = 0;
    std::size_t action = 0;
    int store = 0;
  };

  void add_sequence(std::size_t step, std::size_t sequence, std::vector<int>& last);
  void add_action(std::size_t step, std::size_t sequence, std::size_t action);
  void go(const Action& action, std::size_t slot, StationId to, Event& end);
  void fetch(const Action& action, std::size_t slot, std::size_t carrier, Event& end);
  void park(const Action& action, std::size_t slot, const ParkAction& what, const Event& end);
  void transfer(std::size_t step, std::size_t sequence, std::size_t action, Event& end);
  void from_store(const TransferAction& transfer, std::size_t begin, Event& item, Flow& flow);
  void from_carrier(const TransferAction& transfer, const Action& action, int begin, Event& item,
                    Flow& flow);
  void operate(const Action& action, const OperateAction& what, Event& end);
  [[nodiscard]] int most_items(const TransferAction& transfer) const;
  [[nodiscard]] std::optional<int> store_of(const TransferAction& transfer, bool source) const;

  LineNet& net_;
  const Task& task_;
  TaskId id_;
  TaskEvents& events_;
  std::vector<Member> members_;
  std::vector<Loading> loadings_;
};

}  // namespace linewright::bounds
