#include "watch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "common.hpp"
#include "linewright/evaluation/event_log_writer.hpp"

namespace linewright::cli {
namespace {

constexpr auto kFarewell = std::chrono::seconds(10);
constexpr std::chrono::milliseconds kNap(20);

}  // namespace

void add_watch_options(CLI::App& app, WatchArguments& arguments) {
  auto* watch = app.add_flag("--watch", arguments.on,
                             "Let a browser watch the run on 127.0.0.1 while it goes on");
  app.add_option("--watch-speed", arguments.ticks_per_second,
                 "Ticks per second with --watch (default: 10)")
      ->check(CLI::Range(0.1, 1e6))
      ->needs(watch)
      ->type_name("TICKS");
  add_serve_options(app, arguments.serve);
  for (const char* option : {"--port", "--no-open"}) app.get_option(option)->needs(watch);
}

Watch::Watch(const Scenario& scenario, const WatchArguments& arguments)
    : scenario_(scenario), arguments_(arguments), page_(load_page()) {}

void Watch::start(const EventLog& log) {
  const ServedLog served{.name = scenario_.line.name + ".jsonl", .text = text_, .live = true};
  text_->append(event_log_header(scenario_, log.setup));
  server_ = std::make_unique<ViewServer>(page_, std::vector{served}, arguments_.serve.port);
  report(fmt::format("watch the run at {}", server_->address()));
  thread_ = std::thread([this] { server_->run([this](std::size_t n) { return go_on(n); }); });
  open_browser(server_->address(), arguments_.serve);
  begun_ = Clock::now();
}

Watch::~Watch() {
  stopped_ = true;
  if (thread_.joinable()) thread_.join();
}

void Watch::follow(const EventLog& log, double progress,
                   const std::vector<DecisionExplanation>& explanations) {
  if (!server_) start(log);
  const std::string lines = event_log_lines(scenario_, log, sent_, progress, explanations);
  std::string_view left = lines;
  while (sent_ < log.events.size() && wait_for(log.events[sent_].tick)) {
    const std::size_t size = left.find('\n') + 1;
    text_->append(left.substr(0, size));
    left.remove_prefix(size);
    ++sent_;
  }
}

/// False when the command was interrupted before.
bool Watch::wait_for(Tick tick) {
  const auto due = begun_ + std::chrono::duration_cast<Clock::duration>(
                                std::chrono::duration<double>(tick / arguments_.ticks_per_second));
  while (!interrupted().requested()) {
    const auto now = Clock::now();
    if (now >= due) return true;
    std::this_thread::sleep_for(std::min<Clock::duration>(due - now, kNap));
  }
  return false;
}

void Watch::finish() {
  text_->finish();
  deadline_ = Clock::now() + kFarewell;
  finished_ = true;
  if (thread_.joinable()) thread_.join();
}

bool Watch::go_on(std::size_t sending) const {
  if (stopped_ || interrupted().requested()) return false;
  return !finished_ || (sending > 0 && Clock::now() < deadline_);
}

}  // namespace linewright::cli
