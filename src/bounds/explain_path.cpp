#include "explain_path.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

namespace linewright::bounds {
namespace {

/// The n-th time of an event.
struct Point {
  int event = 0;
  int n = 1;
};

std::optional<Point> counted_cause(const EventNet& net, const Times& times, Point at, Tick tick) {
  for (const Source& source : net[at.event].sources) {
    for (int n = 1; n <= times.columns(); ++n) {
      if (times.at(source.event, n) == tick) return Point{source.event, n};
    }
  }
  return std::nullopt;
}

/// What the event had to wait for; none: nothing.
std::optional<Point> cause_of(const EventNet& net, const Times& times, Point at) {
  const Tick tick = times.at(at.event, at.n);
  const Event& event = net[at.event];
  for (const Arc& arc : event.arcs) {
    const int index = arc.times * at.n + arc.plus;
    if (index < 1) continue;
    const int n = std::min((index + arc.divide - 1) / arc.divide, times.columns());
    if (times.at(arc.from, n) + arc.lag == tick) return Point{arc.from, n};
  }
  for (const Batch& batch : event.batches) {
    for (int b = (at.n + batch.most - 1) / batch.most; b <= at.n; ++b) {
      const int item = std::max(1, at.n - batch.most * (b - 1));
      if (times.at(batch.begin, b) + batch.fixed + batch.each * item == tick)
        return Point{batch.begin, b};
    }
  }
  if (const auto cause = counted_cause(net, times, at, tick)) return cause;
  if (at.n > 1 && times.at(at.event, at.n - 1) == tick) return Point{at.event, at.n - 1};
  return std::nullopt;
}

/// Whether people would name it: an operation ends, an item has been moved, a task is decided.
bool worth_telling(const LineNet& net, int event) {
  if (std::find(net.ends.begin(), net.ends.end(), event) != net.ends.end()) return true;
  return std::any_of(net.tasks.begin(), net.tasks.end(), [&](const TaskEvents& task) {
    if (task.start == event) return true;
    for (const auto& step : task.actions) {
      for (const auto& sequence : step) {
        for (const ActionEvents& action : sequence) {
          if (action.item == event) return true;
        }
      }
    }
    return false;
  });
}

}  // namespace

std::string path_text(const LineNet& net, const Times& times) {
  std::optional<Point> at;
  Tick end = 0;
  for (const auto& [store, tokens] : net.done) {
    const int arrivals = net.arrivals[static_cast<std::size_t>(store)];
    if (times.at(arrivals, tokens) < end) continue;
    end = times.at(arrivals, tokens);
    at = Point{arrivals, std::min(tokens, times.columns())};
  }
  std::vector<std::string> told;
  for (int steps = 0; at && steps < 2000; ++steps) {
    if (worth_telling(net, at->event)) {
      told.push_back(fmt::format("{} (no. {}) at {}", net.net[at->event].name, at->n,
                                 times.at(at->event, at->n)));
    }
    at = cause_of(net.net, times, *at);
  }
  std::reverse(told.begin(), told.end());
  constexpr std::size_t kMost = 60;
  if (told.size() > kMost) {
    told.erase(told.begin() + kMost / 2, told.end() - static_cast<std::ptrdiff_t>(kMost / 2));
    told.insert(told.begin() + kMost / 2, "...");
  }
  return fmt::format("{}", fmt::join(told, ", "));
}

}  // namespace linewright::bounds
