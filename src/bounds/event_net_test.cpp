#include "event_net.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "linewright/base/random.hpp"

namespace linewright::bounds {
namespace {

using Table = std::vector<std::vector<Tick>>;  // by event, number - 1

int upwards(int value, int by) { return static_cast<int>(std::ceil(double(value) / by)); }

/// The rules as the header states them, each looked at until none raises anything.
class PlainNet {
 public:
  PlainNet(const EventNet& net, int columns) : net_(net), columns_(columns) {
    ticks_.assign(net.size(), std::vector<Tick>(static_cast<std::size_t>(columns), 0));
  }

  Table solve(const std::vector<Fix>& fixes) {
    for (const Fix& fix : fixes) {
      for (int n = fix.first; n <= columns_; ++n) raise(fix.event, n, fix.tick);
    }
    for (bool grown = true; grown;) {
      grown = false;
      for (int e = 0; e < static_cast<int>(net_.size()); ++e) {
        for (int n = 1; n <= columns_; ++n) grown = raise(e, n, earliest(e, n)) || grown;
        if (net_[e].counts) grown = count(e) || grown;
      }
    }
    return ticks_;
  }

 private:
  [[nodiscard]] Tick at(int event, int n) const {
    return ticks_[static_cast<std::size_t>(event)]
                 [static_cast<std::size_t>(std::min(n, columns_)) - 1];
  }

  bool raise(int event, int n, Tick tick) {
    Tick& known = ticks_[static_cast<std::size_t>(event)][static_cast<std::size_t>(n - 1)];
    const Tick before = known;
    known = std::max(known, std::min(tick, kNever));
    return known > before;
  }

  [[nodiscard]] Tick earliest(int id, int n) const {
    const Event& event = net_[id];
    Tick tick = std::max(event.least, n > 1 ? at(id, n - 1) : 0);
    for (const Arc& arc : event.arcs) {
      const int index = upwards(arc.times * n + arc.plus, arc.divide);
      if (arc.times * n + arc.plus >= 1) tick = std::max(tick, at(arc.from, index) + arc.lag);
    }
    for (const Batch& batch : event.batches) {
      Tick least = kNever;
      for (int b = upwards(n, batch.most); b <= n; ++b) {
        const int item = std::max(1, n - batch.most * (b - 1));
        least = std::min(least, at(batch.begin, b) + batch.fixed + batch.each * item);
      }
      tick = std::max(tick, least);
    }
    return tick;
  }

  bool count(int id) {
    const Event& event = net_[id];
    std::vector<Tick> tokens;
    for (const Source& source : event.sources) {
      for (int n = 1; n <= columns_; ++n)
        tokens.insert(tokens.end(), static_cast<std::size_t>(source.tokens), at(source.event, n));
    }
    std::sort(tokens.begin(), tokens.end());
    bool grown = false;
    for (int n = event.initial + 1; n <= columns_; ++n) {
      const auto index = static_cast<std::size_t>(n - event.initial - 1);
      grown = raise(id, n, index < tokens.size() ? tokens[index] : kNever) || grown;
    }
    return grown;
  }

  const EventNet& net_;
  int columns_;
  Table ticks_;
};

/// A net of all kinds of rules in which nothing waits for itself.
EventNet random_net(std::uint64_t seed) {
  auto random = RandomStream::derive(seed, "net");
  const auto below = [&](int bound) {
    return static_cast<int>(random.below(static_cast<std::uint64_t>(bound)));
  };
  EventNet net;
  const int size = 4 + below(9);
  constexpr int kFree = 3;  // events that wait for none but themselves
  for (int e = 0; e < size; ++e) {
    Event event;
    event.least = below(30);
    event.arcs.push_back({.from = e, .lag = 1 + below(20), .plus = -1 - below(2)});
    if (e >= kFree) {
      for (int a = below(3); a > 0; --a) event.arcs.push_back({.from = below(e), .lag = below(25)});
      if (below(3) == 0)
        event.arcs.push_back(
            {.from = below(kFree), .lag = 3, .times = below(5), .plus = -3 + below(5)});
      if (below(3) == 0)
        event.arcs.push_back(
            {.from = below(e), .lag = 2, .plus = -below(3), .divide = 1 + below(3)});
      // What comes later in the line makes room.
      event.arcs.push_back({.from = below(size), .lag = below(6), .plus = -1 - below(4)});
      if (below(3) == 0)
        event.batches.push_back(
            {.begin = below(e), .most = 1 + below(4), .fixed = 5, .each = below(4)});
      if (below(3) == 0) {
        event.counts = true;
        event.initial = below(3);
        for (int s = 1 + below(3); s > 0; --s)
          event.sources.push_back({.event = below(e), .tokens = 1 + below(2)});
      }
    }
    net.add(std::move(event));
  }
  net.index_readers();
  return net;
}

Table table_of(const EventNet& net, const Times& times) {
  Table table(net.size());
  for (std::size_t e = 0; e < net.size(); ++e) {
    for (int n = 1; n <= times.columns(); ++n) table[e].push_back(times.at(static_cast<int>(e), n));
  }
  return table;
}

TEST(EventNet, HasTheLeastTimesThatSatisfyAllRules) {
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    const EventNet net = random_net(seed);
    const int columns = 1 + static_cast<int>(seed % 17);
    ASSERT_EQ(table_of(net, net.solve(columns)), PlainNet(net, columns).solve({})) << seed;
  }
}

TEST(EventNet, AnswersQuestionsAsIfTheyWereRules) {
  for (std::uint64_t seed = 1; seed <= 300; ++seed) {
    const EventNet net = random_net(seed);
    const int columns = 2 + static_cast<int>(seed % 13);
    const Times times = net.solve(columns);
    const auto size = static_cast<std::uint64_t>(net.size());
    const std::vector<Fix> fixes = {
        {.event = static_cast<int>(seed % size), .first = 1 + columns / 2, .tick = kNever},
        {.event = static_cast<int>(seed / 3 % size), .first = 1, .tick = 777}};
    for (const std::vector<Fix>& asked : {std::vector{fixes[0]}, std::vector{fixes[1]}, fixes}) {
      ASSERT_EQ(table_of(net, net.solve(times, asked)), PlainNet(net, columns).solve(asked))
          << seed;
    }
  }
}

TEST(EventNet, EndsWhereSomethingWaitsForItself) {
  EventNet net;
  for (const int other : {1, 0}) {
    Event event;
    event.arcs = {{.from = other, .lag = 1}};
    net.add(std::move(event));
  }
  net.index_readers();
  EXPECT_GT(net.solve(3).at(0, 1), 1000);
}

}  // namespace
}  // namespace linewright::bounds
