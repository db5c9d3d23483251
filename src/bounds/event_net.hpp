#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "linewright/base/tick.hpp"

namespace linewright::bounds {

/// What can never happen. Far beyond every horizon, and room to add to it.
inline constexpr Tick kNever = 10 * kMaxTicks;

/// x(n) >= from(ceil((times * n + plus) / divide)) + lag; no constraint where that index is < 1.
struct Arc {
  int from = 0;
  Tick lag = 0;
  int times = 1;
  int plus = 0;
  int divide = 1;
};

/// The k-th item comes in some batch b >= ceil(k / most), as its item max(1, k - most * (b - 1)) or
/// a later one, which takes `fixed` + `each` per item from begin(b): x(k) >= the least of these.
struct Batch {
  int begin = 0;
  int most = 1;
  Tick fixed = 0;
  Tick each = 0;
};

/// Something that brings `tokens` of what is counted each time it happens.
struct Source {
  int event = 0;
  int tokens = 1;
};

/// Something that happens again and again; x(n) is the least tick in which it can have happened n
/// times, whoever plans and allocates.
struct Event {
  std::string name;
  Tick least = 0;  ///< x(n) >= least
  std::vector<Arc> arcs;
  std::vector<Batch> batches;
  bool counts = false;  ///< it happens when one of its sources does, or at tick 0
  int initial = 0;      ///< with `counts`: times it has happened at tick 0
  std::vector<Source> sources;
};

/// x(n) >= tick for all n >= first: a question asked of the net.
struct Fix {
  int event = 0;
  int first = 1;
  Tick tick = 0;
};

/// The least ticks by event and number: row-major, `columns` per event.
class Times {
 public:
  Times() = default;
  Times(std::size_t events, int columns)
      : columns_(columns), ticks_(events * static_cast<std::size_t>(columns), 0) {}

  /// Of the n-th time, n >= 1; beyond the columns, that of the last one: a lower bound still.
  [[nodiscard]] Tick at(int event, int n) const { return ticks_[index(event, n)]; }
  /// Returns whether it has grown.
  bool raise(int event, int n, Tick tick);
  [[nodiscard]] int columns() const { return columns_; }

 private:
  [[nodiscard]] std::size_t index(int event, int n) const {
    const int column = n < columns_ ? n : columns_;
    return static_cast<std::size_t>(event) * static_cast<std::size_t>(columns_) +
           static_cast<std::size_t>(column - 1);
  }
  int columns_ = 0;
  std::vector<Tick> ticks_;
};

/// Which times of an event have to be looked at again when one of another has grown.
struct Reader {
  int event = 0;
  bool whole = false;  ///< all of them: it counts the other
  /// x(n) reads the column c where first(c) <= n <= last(c): an arc, or a batch.
  int times = 1;
  int plus = 0;
  int divide = 1;
  int most = 0;  ///< above 0: a batch of at most so many

  [[nodiscard]] int first(int column) const;
  [[nodiscard]] int last(int column) const;
};

/// Events and what each of them has to wait for: a timed event graph with choices, in which nobody
/// competes for anything. Every rule holds in every run, so the least times that satisfy all of
/// them are lower bounds of those of every run.
class EventNet {
 public:
  int add(Event event);
  [[nodiscard]] Event& operator[](int event) { return events_[static_cast<std::size_t>(event)]; }
  [[nodiscard]] const Event& operator[](int event) const {
    return events_[static_cast<std::size_t>(event)];
  }
  [[nodiscard]] std::size_t size() const { return events_.size(); }

  /// To be called when the net is complete.
  void index_readers();

  /// The least times, counting each event up to `columns` times.
  [[nodiscard]] Times solve(int columns) const;
  /// The same with further rules, from the times without them.
  [[nodiscard]] Times solve(const Times& without, const std::vector<Fix>& fixes) const;

 private:
  std::vector<Event> events_;
  std::vector<std::vector<Reader>> readers_;
};

}  // namespace linewright::bounds
