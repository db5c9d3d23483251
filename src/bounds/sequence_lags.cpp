#include "sequence_lags.hpp"

#include <algorithm>

namespace linewright::bounds {
namespace {

/// Later than anything that does not wait for it.
constexpr Tick kLate = kMaxTicks;

}  // namespace

Lags::Lags(const LineNet& net, const Times& times, const SequenceProblem& problem,
           const CancelToken* cancel)
    : net_(net),
      times_(times),
      problem_(problem),
      cancel_(cancel),
      columns_(net.columns),
      entries_(problem.jobs.size() * 3 * static_cast<std::size_t>(net.columns) + 1) {
  ask_forks();
  fill(base_, times);
  ask_delays();
  number_kept();
  ask_needs();
}

void Lags::number_kept() {
  kept_.assign(entries_, -1);
  kept_[final_entry()] = 0;
  kept_base_ = {base_[final_entry()]};
  for (auto& rows : rows_) {
    for (auto& row : rows) {
      for (auto& [entry, lag] : row) {
        if (kept_[entry] < 0) {
          kept_[entry] = static_cast<int>(kept_base_.size());
          kept_base_.push_back(base_[entry]);
        }
        entry = static_cast<std::uint32_t>(kept_[entry]);
      }
    }
  }
}

std::size_t Lags::entry(std::size_t job, int which, int n) const {
  return (job * 3 + static_cast<std::size_t>(which)) * static_cast<std::size_t>(columns_) +
         static_cast<std::size_t>(std::min(n, columns_) - 1);
}

void Lags::fill(std::vector<Tick>& row, const Times& times) const {
  row.assign(entries_, 0);
  for (std::size_t j = 0; j < problem_.jobs.size(); ++j) {
    const JobType& job = problem_.jobs[j];
    for (int n = 1; n <= columns_; ++n) {
      if (job.start >= 0) row[entry(j, kStart, n)] = times.at(job.start, n);
      row[entry(j, kAnchor, n)] = times.at(job.anchor, n);
      row[entry(j, kEnd, n)] = times.at(job.end, n);
    }
  }
  row[final_entry()] = net_.end_of(times);
  for (const Fork& fork : forks_) {
    for (int n = 1; n <= columns_; ++n)
      row[fork.entry + static_cast<std::size_t>(n - 1)] = times.at(fork.arrivals, n);
  }
}

void Lags::ask_delays() {
  std::vector<Tick> row;
  for (const JobType& job : problem_.jobs) {
    auto& rows = rows_.emplace_back();
    for (int n = 1; n <= columns_; ++n) {
      auto& lags = rows.emplace_back();
      if (cancelled()) continue;
      fill(row, net_.net.solve(times_, {{.event = job.unit, .first = n, .tick = kLate}}));
      for (std::size_t e = 0; e < entries_; ++e) {
        if (row[e] >= kLate && row[e] < kNever)
          lags.emplace_back(static_cast<std::uint32_t>(e), row[e] - kLate);
      }
    }
  }
}

void Lags::ask_needs() {
  for (const JobType& needed : problem_.jobs) {
    std::vector<std::vector<int>> needs(problem_.jobs.size(),
                                        std::vector<int>(static_cast<std::size_t>(columns_), 0));
    int end_needs = 0;
    for (int n = 1; n <= columns_ && !cancelled(); ++n) {
      const Times without =
          net_.net.solve(times_, {{.event = needed.unit, .first = n, .tick = kNever}});
      if (net_.end_of(without) >= kNever) end_needs = n;
      for (std::size_t j = 0; j < problem_.jobs.size(); ++j) {
        const JobType& job = problem_.jobs[j];
        for (int k = 1; k <= columns_; ++k) {
          const bool own = job.unit == needed.unit && k >= n;
          if (!own && without.at(job.unit, k) >= kNever)
            needs[j][static_cast<std::size_t>(k - 1)] = n;
        }
      }
    }
    needs_.push_back(std::move(needs));
    end_needs_.push_back(end_needs);
  }
}

void Lags::ask_forks() {
  for (int store = 0; store < net_.stores.count; ++store) {
    std::vector<int> ways;
    for (const Flow& flow : net_.flows) {
      for (const auto& taken : flow.takes) {
        if (taken.first != store || taken.second != 1) continue;
        ways.push_back(flow.operation ? net_.starts[flow.operation->index()]
                                      : net_.tasks[flow.task->index()]
                                            .actions[flow.step][flow.sequence][flow.action]
                                            .item);
      }
    }
    if (ways.size() < 2) continue;
    Fork fork{.arrivals = net_.arrivals[static_cast<std::size_t>(store)], .entry = entries_};
    bool used = false;
    for (const int way : ways) {
      ask_uses(way, fork.uses.emplace_back());
      for (const auto& uses : fork.uses.back()) used = used || uses.back().firings > 0;
    }
    if (!used) continue;
    entries_ += static_cast<std::size_t>(columns_);
    forks_.push_back(std::move(fork));
  }
}

void Lags::ask_uses(int event, std::vector<std::vector<Fork::Use>>& uses) const {
  uses.assign(problem_.jobs.size(), std::vector<Fork::Use>(static_cast<std::size_t>(columns_)));
  for (int n = 1; n <= columns_ && !cancelled(); ++n) {
    const Times without = net_.net.solve(times_, {{.event = event, .first = n, .tick = kNever}});
    const Times late = net_.net.solve(times_, {{.event = event, .first = n, .tick = kLate}});
    for (std::size_t j = 0; j < problem_.jobs.size(); ++j) {
      bool first = true;
      Tick lag = 0;
      for (int k = 1; k <= columns_; ++k) {
        if (times_.at(problem_.jobs[j].unit, k) >= kNever) continue;
        if (without.at(problem_.jobs[j].unit, k) < kNever) continue;
        if (first) lag = std::max(0, late.at(problem_.jobs[j].unit, k) - kLate);
        first = false;
        uses[j][static_cast<std::size_t>(k - 1)] = {n, lag};
      }
    }
  }
}

bool Lags::can_end(const std::vector<std::int16_t>& units) const {
  std::vector<Fix> fixes;
  for (std::size_t j = 0; j < problem_.jobs.size(); ++j) {
    if (units[j] < columns_)  // what is not counted further is not limited
      fixes.push_back({.event = problem_.jobs[j].unit, .first = units[j] + 1, .tick = kNever});
  }
  return net_.end_of(net_.net.solve(times_, fixes)) < kNever;
}

}  // namespace linewright::bounds
