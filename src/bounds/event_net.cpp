#include "event_net.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <utility>

namespace linewright::bounds {
namespace {

/// Looks at one time of an event before it is left as it is (a lower bound still): only in nets in
/// which something waits for itself is one looked at so often.
constexpr std::uint32_t kMostLooks = 2000;

/// More than there are columns.
constexpr int kEach = std::numeric_limits<int>::max();

Tick plus(Tick tick, Tick lag) { return tick >= kNever - lag ? kNever : tick + lag; }

int ceil_divide(int value, int by) { return value > 0 ? (value + by - 1) / by : -(-value / by); }
int floor_divide(int value, int by) { return -ceil_divide(-value, by); }

/// Raises times until all rules hold. The times with low numbers come first: those with higher ones
/// follow from them, so that few are looked at twice.
class Settling {
 public:
  Settling(const std::vector<Event>& events, const std::vector<std::vector<Reader>>& readers,
           Times& times)
      : events_(events),
        readers_(readers),
        times_(times),
        columns_(times.columns()),
        open_(static_cast<std::size_t>(columns_) + 1),
        waiting_(events.size() * open_.size(), 0),
        looks_(events.size() * open_.size(), 0) {}

  /// To be looked at; n = 0: the event's sources are to be counted.
  void look_at(int event, int n) { look_at(event, n, n); }

  /// This time has grown.
  void grown(int event, int n) {
    if (n < columns_) look_at(event, n + 1);
    for (const Reader& reader : readers_[static_cast<std::size_t>(event)]) {
      if (reader.whole) {
        look_at(reader.event, 0, n);
        continue;
      }
      // The last column stands for all after it.
      const int last = n == columns_ ? columns_ : std::min(columns_, reader.last(n));
      for (int k = std::max(1, reader.first(n)); k <= last; ++k) look_at(reader.event, k);
    }
  }

  void run() {
    for (lowest_ = 0; lowest_ <= columns_;) {
      Bucket& bucket = open_[static_cast<std::size_t>(lowest_)];
      if (bucket.next == bucket.nodes.size()) {
        bucket.nodes.clear();
        bucket.next = 0;
        ++lowest_;
        continue;
      }
      const std::size_t node = bucket.nodes[bucket.next++];
      waiting_[node] = 0;
      const auto event = static_cast<int>(node / open_.size());
      const auto n = static_cast<int>(node % open_.size());
      // A count is looked at for each of its numbers.
      const auto numbers = static_cast<std::uint32_t>(n == 0 ? columns_ : 1);
      if (looks_[node] >= kMostLooks * numbers) continue;
      ++looks_[node];
      if (n == 0) {
        count(event);
      } else if (times_.raise(event, n, earliest(event, n))) {
        grown(event, n);
      }
    }
  }

 private:
  struct Bucket {
    std::vector<std::size_t> nodes;
    std::size_t next = 0;
  };

  void look_at(int event, int n, int column) {
    const std::size_t node =
        static_cast<std::size_t>(event) * open_.size() + static_cast<std::size_t>(n);
    if (waiting_[node] != 0) return;
    waiting_[node] = 1;
    open_[static_cast<std::size_t>(column)].nodes.push_back(node);
    lowest_ = std::min(lowest_, column);
  }

  [[nodiscard]] Tick earliest(int id, int n) const {
    const Event& event = events_[static_cast<std::size_t>(id)];
    Tick tick = n > 1 ? times_.at(id, n - 1) : 0;
    for (const Arc& arc : event.arcs) {
      const int index = arc.times * n + arc.plus;
      if (index < 1) continue;
      tick = std::max(tick, plus(times_.at(arc.from, ceil_divide(index, arc.divide)), arc.lag));
    }
    for (const Batch& batch : event.batches) {
      Tick least = kNever;
      for (int b = ceil_divide(n, batch.most); b <= n; ++b) {
        const int item = std::max(1, n - batch.most * (b - 1));
        least = std::min(least, plus(times_.at(batch.begin, b), batch.fixed + batch.each * item));
        if (item == 1) break;
      }
      tick = std::max(tick, least);
    }
    return tick;
  }

  /// Merges what the sources bring, the earliest first.
  void count(int id) {
    const Event& event = events_[static_cast<std::size_t>(id)];
    std::vector<int> next(event.sources.size(), 1);
    int counted = event.initial;
    while (counted < columns_) {
      std::size_t earliest = event.sources.size();
      Tick tick = kNever;
      for (std::size_t s = 0; s < event.sources.size(); ++s) {
        const Tick at = times_.at(event.sources[s].event, next[s]);
        if (at >= tick) continue;
        tick = at;
        earliest = s;
      }
      const int tokens =
          earliest < event.sources.size() ? event.sources[earliest].tokens : columns_;
      if (earliest < event.sources.size()) ++next[earliest];
      for (int i = 0; i < tokens && counted < columns_; ++i) {
        ++counted;
        if (times_.raise(id, counted, tick)) grown(id, counted);
      }
    }
  }

  const std::vector<Event>& events_;
  const std::vector<std::vector<Reader>>& readers_;
  Times& times_;
  int columns_;
  int lowest_ = 0;
  std::vector<Bucket> open_;           ///< by number
  std::vector<std::uint8_t> waiting_;  ///< by event and number, 0: its count
  std::vector<std::uint32_t> looks_;
};

}  // namespace

bool Times::raise(int event, int n, Tick tick) {
  Tick& known = ticks_[index(event, n)];
  if (tick <= known) return false;
  known = std::min(tick, kNever);
  return true;
}

int Reader::first(int column) const {
  if (most > 0) return column;
  if (times == 0) return 1;
  return ceil_divide((column - 1) * divide + 1 - plus, times);
}

int Reader::last(int column) const {
  if (most > 0) return column * most;
  if (times == 0) return ceil_divide(plus, divide) == column ? kEach : 0;
  return floor_divide(column * divide - plus, times);
}

int EventNet::add(Event event) {
  events_.push_back(std::move(event));
  return static_cast<int>(events_.size()) - 1;
}

void EventNet::index_readers() {
  readers_.assign(events_.size(), {});
  for (std::size_t e = 0; e < events_.size(); ++e) {
    const auto id = static_cast<int>(e);
    const auto of = [&](int from) -> auto& { return readers_[static_cast<std::size_t>(from)]; };
    for (const Arc& arc : events_[e].arcs) {
      of(arc.from).push_back(
          {.event = id, .times = arc.times, .plus = arc.plus, .divide = arc.divide});
    }
    for (const Batch& batch : events_[e].batches)
      of(batch.begin).push_back({.event = id, .most = batch.most});
    for (const Source& source : events_[e].sources)
      of(source.event).push_back({.event = id, .whole = true});
  }
}

Times EventNet::solve(int columns) const {
  Times times(events_.size(), columns);
  Settling settling(events_, readers_, times);
  for (std::size_t e = 0; e < events_.size(); ++e) {
    const auto event = static_cast<int>(e);
    if (events_[e].counts) settling.look_at(event, 0);
    for (int n = 1; n <= columns; ++n) {
      times.raise(event, n, events_[e].least);
      settling.look_at(event, n);
    }
  }
  settling.run();
  return times;
}

Times EventNet::solve(const Times& without, const std::vector<Fix>& fixes) const {
  Times times = without;
  Settling settling(events_, readers_, times);
  for (const Fix& fix : fixes) {
    for (int n = fix.first; n <= times.columns(); ++n) {
      if (times.raise(fix.event, n, fix.tick)) settling.grown(fix.event, n);
    }
  }
  settling.run();
  return times;
}

}  // namespace linewright::bounds
