#include "linewright/planning/tune_priority.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "linewright/base/random.hpp"
#include "linewright/base/worker_pool.hpp"
#include "order_runs.hpp"

namespace linewright {
namespace {

using planning::OrderRuns;
using planning::PriorityPlanner;
using Order = std::vector<TaskId>;

/// What each start gave; shorter than the starts when the order was dropped.
struct Results {
  std::vector<double> makespan;
  double sum = 0.0;
  std::size_t finished = 0;
};

/// A race is judged after a share of all starts; an order goes on while the mean of its differences
/// to the rival is below so many of its standard errors.
struct Stage {
  double share;
  double most_errors;
};
constexpr std::array<Stage, 4> kStages{{{0.04, 2.0}, {0.12, 1.0}, {0.35, 0.0}, {1.0, 0.0}}};

constexpr std::size_t kBatch = 16;  ///< orders that race side by side

class Tuner {
 public:
  Tuner(const Simulator& simulator, const TuneOptions& options)
      : runs_of_(simulator, options),
        tasks_(simulator.line().tasks.size()),
        options_(options),
        pool_(options.threads),
        random_(RandomStream::derive(options.seed, "tune search")) {
    for (std::size_t t = 0; t < pool_.size(); ++t) runners_.push_back(runs_of_.runner());
  }

  TunedPriority run() {
    Order order;
    for (std::size_t t = 0; t < tasks_; ++t) order.emplace_back(t);
    best_ = order;
    best_results_ = evaluate({order}, nullptr).front();
    note();
    Order home = order;
    Results home_results = best_results_;
    descend(home, home_results);
    while (!stopped() && order.size() > 1) {
      Order away = home;
      for (std::size_t kick = 0; kick < 3; ++kick) {
        move(away, random_.below(away.size()), random_.below(away.size()));
      }
      Results away_results = evaluate({away}, nullptr).front();
      descend(away, away_results);
      if (away_results.makespan.size() < runs_of_.count()) continue;  // stopped meanwhile
      if (away_results.sum <= home_results.sum) {
        home = std::move(away);
        home_results = std::move(away_results);
      }
    }
    return summary();
  }

 private:
  [[nodiscard]] bool cancelled() const {
    return options_.cancel != nullptr && options_.cancel->requested();
  }
  [[nodiscard]] bool stopped() const { return runs_ >= options_.most_runs || cancelled(); }

  static void move(Order& order, std::size_t from, std::size_t to) {
    const TaskId task = order[from];
    order.erase(order.begin() + static_cast<std::ptrdiff_t>(from));
    order.insert(order.begin() + static_cast<std::ptrdiff_t>(to), task);
  }

  /// To a better order that one move makes, again and again, until none is better.
  void descend(Order& order, Results& results) {
    consider(order, results);
    std::vector<Order> moved = all_moves(order);
    while (!moved.empty() && !stopped()) {
      const std::size_t count = std::min(kBatch, moved.size());
      const std::vector<Order> batch(moved.end() - static_cast<std::ptrdiff_t>(count), moved.end());
      moved.resize(moved.size() - count);
      const std::vector<Results> all = evaluate(batch, &results);
      std::optional<std::size_t> least;
      for (std::size_t i = 0; i < all.size(); ++i) {
        const bool complete = all[i].makespan.size() == runs_of_.count();
        if (complete && all[i].sum < (least ? all[*least] : results).sum) least = i;
      }
      if (!least) continue;
      order = batch[*least];
      results = all[*least];
      consider(order, results);
      moved = all_moves(order);
    }
  }

  /// Every order that moves one task, in random order.
  std::vector<Order> all_moves(const Order& order) {
    std::vector<Order> moved;
    for (std::size_t from = 0; from < order.size(); ++from) {
      for (std::size_t to = 0; to < order.size(); ++to) {
        if (to == from || to + 1 == from) continue;  // the latter: a swap that is there already
        moved.push_back(order);
        move(moved.back(), from, to);
      }
    }
    for (std::size_t i = moved.size(); i > 1; --i) std::swap(moved[i - 1], moved[random_.below(i)]);
    return moved;
  }

  void consider(const Order& order, const Results& results) {
    if (results.makespan.size() == runs_of_.count() && results.sum < best_results_.sum) {
      best_ = order;
      best_results_ = results;
    }
    note();
  }

  void note() const {
    if (options_.progress) options_.progress(summary());
  }

  [[nodiscard]] TunedPriority summary() const {
    const auto count = static_cast<double>(std::max<std::size_t>(1, best_results_.makespan.size()));
    return {.order = best_,
            .makespan = best_results_.sum / count,
            .success_rate = static_cast<double>(best_results_.finished) / count,
            .runs = runs_};
  }

  /// Runs every order; one that is clearly worse than `rival` is dropped.
  std::vector<Results> evaluate(const std::vector<Order>& orders, const Results* rival) {
    std::vector<Results> results(orders.size());
    pool_.run(orders.size(), [&](std::size_t begin, std::size_t end, std::size_t thread) {
      for (std::size_t i = begin; i < end; ++i)
        race(runners_[thread], orders[i], rival, results[i]);
    });
    for (const Results& result : results) runs_ += result.makespan.size();
    return results;
  }

  void race(OrderRuns::Runner& runner, const Order& order, const Results* rival,
            Results& results) const {
    runner.planner = PriorityPlanner(order);
    for (const Stage& stage : kStages) {
      const auto end = static_cast<std::size_t>(
          std::ceil(stage.share * static_cast<double>(runs_of_.count()) - 1e-9));
      for (std::size_t s = results.makespan.size(); s < end; ++s) {
        if (cancelled()) return;
        const OrderRuns::Result result = runs_of_.play(runner, s);
        results.makespan.push_back(result.makespan);
        results.sum += result.makespan;
        results.finished += result.finished ? 1 : 0;
      }
      if (rival != nullptr && loses(results, *rival, stage.most_errors)) return;
    }
  }

  /// Whether the differences, start by start, are too large on average.
  static bool loses(const Results& results, const Results& rival, double most_errors) {
    const std::size_t count = results.makespan.size();
    double sum = 0.0;
    double squares = 0.0;
    for (std::size_t i = 0; i < count; ++i) {
      const double difference = results.makespan[i] - rival.makespan[i];
      sum += difference;
      squares += difference * difference;
    }
    const double mean = sum / static_cast<double>(count);
    const double variance = std::max(0.0, squares / static_cast<double>(count) - mean * mean);
    return mean >= 0.0 && mean >= most_errors * std::sqrt(variance / static_cast<double>(count));
  }

  OrderRuns runs_of_;
  std::size_t tasks_;
  const TuneOptions& options_;
  WorkerPool pool_;
  RandomStream random_;
  std::vector<OrderRuns::Runner> runners_;
  Order best_;
  Results best_results_;
  std::size_t runs_ = 0;
};

}  // namespace

TunedPriority tune_priority(const Simulator& simulator, const TuneOptions& options) {
  return Tuner(simulator, options).run();
}

}  // namespace linewright
