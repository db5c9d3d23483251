#pragma once

#include <atomic>
#include <chrono>
#include <cstddef>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "linewright/base/tick.hpp"
#include "linewright/planning/explain.hpp"
#include "linewright/scenario/scenario.hpp"
#include "linewright/simulation/event_log.hpp"
#include "viewing.hpp"

namespace linewright::cli {

struct WatchArguments {
  bool on = false;
  double ticks_per_second = 10.0;
  ServeArguments serve;
};

void add_watch_options(CLI::App& app, WatchArguments& arguments);

/// Lets a browser watch a run: serves the page in a thread of its own, and writes the run's log
/// there as fast as one can watch it, whatever the simulator's speed.
class Watch {
 public:
  /// Throws ScenarioError when there is no page. `scenario` and `arguments` must outlive it.
  Watch(const Scenario& scenario, const WatchArguments& arguments);
  /// Ends the server at once.
  ~Watch();
  Watch(const Watch&) = delete;
  Watch& operator=(const Watch&) = delete;

  /// Sends what is new in the log, each event when its tick has come; returns early when the
  /// command is interrupted. The first time it starts to serve, and says where; throws
  /// ScenarioError when the port cannot be used. `progress` is that of the final state, once the
  /// log has its end.
  void follow(const EventLog& log, double progress,
              const std::vector<DecisionExplanation>& explanations);

  /// The log is complete: waits until those who are watching have all of it, seconds at most.
  void finish();

 private:
  using Clock = std::chrono::steady_clock;

  void start(const EventLog& log);
  bool wait_for(Tick tick);
  [[nodiscard]] bool go_on(std::size_t sending) const;

  const Scenario& scenario_;
  const WatchArguments& arguments_;
  std::string page_;
  std::shared_ptr<GrowingText> text_ = std::make_shared<GrowingText>();
  std::unique_ptr<ViewServer> server_;
  std::size_t sent_ = 0;  ///< events
  Clock::time_point begun_;
  std::atomic<bool> stopped_ = false;
  std::atomic<bool> finished_ = false;
  Clock::time_point deadline_;  ///< set before `finished_`
  std::thread thread_;
};

}  // namespace linewright::cli
