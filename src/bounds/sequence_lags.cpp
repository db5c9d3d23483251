#include "sequence_lags.hpp"

#include <algorithm>

namespace linewright::bounds {
namespace {

/// Later than anything that does not wait for it.
constexpr Tick kLate = kMaxTicks;

}  // namespace

Lags::Lags(const LineNet& net, const Times& times, const SequenceProblem& problem)
    : net_(net),
      times_(times),
      problem_(problem),
      columns_(net.columns),
      entries_(problem.jobs.size() * 3 * static_cast<std::size_t>(net.columns) + 1) {
  fill(base_, times);
  ask_delays();
  ask_needs();
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
}

void Lags::ask_delays() {
  std::vector<Tick> row;
  for (const JobType& job : problem_.jobs) {
    auto& rows = rows_.emplace_back();
    for (int n = 1; n <= columns_; ++n) {
      auto& lags = rows.emplace_back();
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
    for (int n = 1; n <= columns_; ++n) {
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

bool Lags::can_end(const std::vector<std::int16_t>& units) const {
  std::vector<Fix> fixes;
  for (std::size_t j = 0; j < problem_.jobs.size(); ++j) {
    if (units[j] < columns_)  // what is not counted further is not limited
      fixes.push_back({.event = problem_.jobs[j].unit, .first = units[j] + 1, .tick = kNever});
  }
  return net_.end_of(net_.net.solve(times_, fixes)) < kNever;
}

}  // namespace linewright::bounds
