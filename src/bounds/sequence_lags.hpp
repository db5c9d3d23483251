#pragma once

#include <vector>

#include "sequence.hpp"

namespace linewright::bounds {

/// How the units of the jobs of one resource follow from one another through the line, asked of the
/// net: what is delayed, and by how much after it, when a unit comes late; what never happens
/// without it.
class Lags {
 public:
  Lags(const LineNet& net, const Times& times, const SequenceProblem& problem);

  /// The events that are followed: start, anchor and end of each job, and the end of the run. Their
  /// numbers 1 ... columns() are the entries of a row.
  [[nodiscard]] std::size_t entries() const { return entries_; }
  [[nodiscard]] std::size_t entry(std::size_t job, int which, int n) const;
  static constexpr int kStart = 0;
  static constexpr int kAnchor = 1;
  static constexpr int kEnd = 2;
  [[nodiscard]] std::size_t final_entry() const { return entries_ - 1; }
  [[nodiscard]] int columns() const { return columns_; }

  /// Without any delay.
  [[nodiscard]] const std::vector<Tick>& base() const { return base_; }
  /// (entry, lag) after unit n of the job: entry >= tick of the unit + lag.
  [[nodiscard]] const std::vector<std::pair<std::uint32_t, Tick>>& after(std::size_t job,
                                                                         int n) const {
    return rows_[job][static_cast<std::size_t>(n - 1)];
  }
  /// Units of `needed` without which unit n of the job cannot be; of the end of the run.
  [[nodiscard]] int needs(std::size_t job, int n, std::size_t needed) const {
    return needs_[needed][job][static_cast<std::size_t>(n - 1)];
  }
  [[nodiscard]] int end_needs(std::size_t needed) const { return end_needs_[needed]; }
  /// Whether the order can be finished with no more than these units.
  [[nodiscard]] bool can_end(const std::vector<std::int16_t>& units) const;

 private:
  void fill(std::vector<Tick>& row, const Times& times) const;
  void ask_delays();
  void ask_needs();

  const LineNet& net_;
  const Times& times_;
  const SequenceProblem& problem_;
  int columns_;
  std::size_t entries_;
  std::vector<Tick> base_;
  std::vector<std::vector<std::vector<std::pair<std::uint32_t, Tick>>>> rows_;
  std::vector<std::vector<std::vector<int>>> needs_;
  std::vector<int> end_needs_;
};

}  // namespace linewright::bounds
