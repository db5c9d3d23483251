#include "event_net.hpp"

#include <algorithm>
#include <utility>

namespace linewright::bounds {
namespace {

/// Times an event is looked at on average before the rest is left as it is (a lower bound still):
/// only nets in which something waits for itself get near it.
constexpr std::size_t kMostLooks = 2000;

Tick plus(Tick tick, Tick lag) { return tick >= kNever - lag ? kNever : tick + lag; }

int ceil_divide(int value, int by) { return (value + by - 1) / by; }

}  // namespace

bool Times::raise(int event, int n, Tick tick) {
  Tick& known = ticks_[index(event, n)];
  if (tick <= known) return false;
  known = std::min(tick, kNever);
  return true;
}

int EventNet::add(Event event) {
  events_.push_back(std::move(event));
  return static_cast<int>(events_.size()) - 1;
}

void EventNet::index_readers() {
  readers_.assign(events_.size(), {});
  for (std::size_t e = 0; e < events_.size(); ++e) {
    const auto reads = [&](int from) {
      auto& readers = readers_[static_cast<std::size_t>(from)];
      if (readers.empty() || readers.back() != static_cast<int>(e))
        readers.push_back(static_cast<int>(e));
    };
    for (const Arc& arc : events_[e].arcs) reads(arc.from);
    for (const Batch& batch : events_[e].batches) reads(batch.begin);
    for (const Source& source : events_[e].sources) reads(source.event);
  }
}

Times EventNet::solve(int columns) const {
  Times times(events_.size(), columns);
  std::vector<int> open;
  for (std::size_t e = 0; e < events_.size(); ++e) {
    for (int n = 1; n <= columns; ++n) times.raise(static_cast<int>(e), n, events_[e].least);
    open.push_back(static_cast<int>(e));
  }
  settle(times, std::move(open));
  return times;
}

Times EventNet::solve(const Times& without, const std::vector<Fix>& fixes) const {
  Times times = without;
  std::vector<int> open;
  for (const Fix& fix : fixes) {
    bool grown = false;
    for (int n = fix.first; n <= times.columns(); ++n)
      grown = times.raise(fix.event, n, fix.tick) || grown;
    if (!grown) continue;
    for (const int reader : readers_[static_cast<std::size_t>(fix.event)]) open.push_back(reader);
  }
  settle(times, std::move(open));
  return times;
}

void EventNet::settle(Times& times, std::vector<int> open) const {
  std::vector<bool> waiting(events_.size(), false);
  for (const int event : open) waiting[static_cast<std::size_t>(event)] = true;
  const std::size_t most = kMostLooks * events_.size();
  for (std::size_t next = 0; next < open.size() && next < most; ++next) {
    const int event = open[next];
    waiting[static_cast<std::size_t>(event)] = false;
    if (!refresh(times, event)) continue;
    for (const int reader : readers_[static_cast<std::size_t>(event)]) {
      if (waiting[static_cast<std::size_t>(reader)]) continue;
      waiting[static_cast<std::size_t>(reader)] = true;
      open.push_back(reader);
    }
  }
}

bool EventNet::refresh(Times& times, int id) const {
  const Event& event = events_[static_cast<std::size_t>(id)];
  bool grown = event.counts && refresh_count(times, id);
  for (int n = 1; n <= times.columns(); ++n) {
    Tick tick = n > 1 ? times.at(id, n - 1) : 0;
    for (const Arc& arc : event.arcs) {
      const int index = arc.times * n + arc.plus;
      if (index < 1) continue;
      tick = std::max(tick, plus(times.at(arc.from, ceil_divide(index, arc.divide)), arc.lag));
    }
    for (const Batch& batch : event.batches) {
      Tick least = kNever;
      for (int b = ceil_divide(n, batch.most); b <= n; ++b) {
        const int item = std::max(1, n - batch.most * (b - 1));
        least = std::min(least, plus(times.at(batch.begin, b), batch.fixed + batch.each * item));
        if (item == 1) break;
      }
      tick = std::max(tick, least);
    }
    grown = times.raise(id, n, tick) || grown;
  }
  return grown;
}

bool EventNet::refresh_count(Times& times, int id) const {
  const Event& event = events_[static_cast<std::size_t>(id)];
  std::vector<int> next(event.sources.size(), 1);
  bool grown = false;
  int counted = event.initial;
  while (counted < times.columns()) {
    std::size_t earliest = event.sources.size();
    Tick tick = kNever;
    for (std::size_t s = 0; s < event.sources.size(); ++s) {
      const Tick at = times.at(event.sources[s].event, next[s]);
      if (at >= tick) continue;
      tick = at;
      earliest = s;
    }
    const int tokens =
        earliest < event.sources.size() ? event.sources[earliest].tokens : times.columns();
    if (earliest < event.sources.size()) ++next[earliest];
    for (int i = 0; i < tokens && counted < times.columns(); ++i)
      grown = times.raise(id, ++counted, tick) || grown;
  }
  return grown;
}

}  // namespace linewright::bounds
