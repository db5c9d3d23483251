#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "linewright/base/diagnostic.hpp"
#include "linewright/base/worker_pool.hpp"
#include "order_runs.hpp"

namespace linewright {
namespace {

using planning::OrderRuns;

/// Shares of all starts after which orders are dropped. The starts are the same for all, so that
/// means of a few runs compare well.
constexpr std::array<double, 5> kHeats{0.01, 0.03, 0.1, 0.3, 1.0};

/// After n runs those go on whose mean is within this, divided by the root of n, of the best.
constexpr double kMargin = 0.6;

constexpr std::size_t kBlock = 4096;  ///< orders between two looks at the progress

/// Races all orders of the tasks against each other.
class AllOrders {
 public:
  AllOrders(const Simulator& simulator, const TuneOptions& options)
      : runs_(simulator, options), options_(options), pool_(options.threads) {
    for (std::size_t t = 0; t < pool_.size(); ++t) runners_.push_back(runs_.runner());
    std::vector<TaskId> order;
    for (std::size_t t = 0; t < simulator.line().tasks.size(); ++t) order.emplace_back(t);
    best_.order = order;
    do {
      entries_.push_back({.order = order});
    } while (std::next_permutation(order.begin(), order.end(), before));
  }

  TunedPriority run() {
    std::size_t done = 0;
    for (const double heat : kHeats) {
      const double share = heat * static_cast<double>(runs_.count());
      // Each crew at least once.
      const auto end = std::clamp(static_cast<std::size_t>(std::ceil(share - 1e-9)),
                                  std::min(options_.crews.size(), runs_.count()), runs_.count());
      for (std::size_t begin = 0; begin < entries_.size() && !cancelled(); begin += kBlock) {
        play(begin, std::min(begin + kBlock, entries_.size()), done, end);
        if (options_.progress) options_.progress(best_);
      }
      if (cancelled()) break;
      done = end;
      drop(done);
    }
    return best_;
  }

 private:
  struct Entry {
    std::vector<TaskId> order;
    double sum = 0.0;
    std::size_t finished = 0;
  };

  static bool before(TaskId a, TaskId b) { return a.value < b.value; }

  [[nodiscard]] bool cancelled() const {
    return options_.cancel != nullptr && options_.cancel->requested();
  }

  /// Runs some of the orders from the starts `from` ... `to` - 1.
  void play(std::size_t first, std::size_t last, std::size_t from, std::size_t to) {
    pool_.run(last - first, [&](std::size_t begin, std::size_t end, std::size_t thread) {
      OrderRuns::Runner& runner = runners_[thread];
      for (std::size_t i = first + begin; i < first + end; ++i) {
        runner.planner = planning::PriorityPlanner(entries_[i].order);
        for (std::size_t start = from; start < to; ++start) {
          const OrderRuns::Result result = runs_.play(runner, start);
          entries_[i].sum += result.makespan;
          entries_[i].finished += result.finished ? 1 : 0;
        }
      }
    });
    best_.runs += (last - first) * (to - from);
  }

  void drop(std::size_t done) {
    const auto best =
        std::min_element(entries_.begin(), entries_.end(),
                         [](const Entry& a, const Entry& b) { return a.sum < b.sum; });
    const auto count = static_cast<double>(done);
    best_.order = best->order;
    best_.makespan = best->sum / count;
    best_.success_rate = static_cast<double>(best->finished) / count;
    const double most = best->sum * (1.0 + kMargin / std::sqrt(count));
    std::erase_if(entries_, [&](const Entry& entry) { return entry.sum > most; });
  }

  OrderRuns runs_;
  const TuneOptions& options_;
  WorkerPool pool_;
  std::vector<OrderRuns::Runner> runners_;
  std::vector<Entry> entries_;
  TunedPriority best_;
};

}  // namespace

TunedPriority try_all_orders(const Simulator& simulator, const TuneOptions& options) {
  if (orders_of(simulator.line()) > kMostOrders) {
    throw ScenarioError({},
                        fmt::format("{} has {} tasks, and every order is tried of at most 9",
                                    simulator.line().name, simulator.line().tasks.size()),
                        "search instead (without --exhaustive): it takes any number of tasks");
  }
  return AllOrders(simulator, options).run();
}

std::size_t orders_of(const LineModel& line) {
  std::size_t orders = 1;
  for (std::size_t t = 2; t <= line.tasks.size(); ++t) {
    if (orders > kMostOrders) return orders;
    orders *= t;
  }
  return orders;
}

}  // namespace linewright
