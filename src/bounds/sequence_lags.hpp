#pragma once

#include <vector>

#include "sequence.hpp"

namespace linewright::bounds {

/// How the units of the jobs of one resource follow from one another through the line, asked of the
/// net: what is delayed, and by how much after it, when a unit comes late; what never happens
/// without it.
class Lags {
 public:
  /// Cancelled, it knows less: what follows from it are bounds still.
  Lags(const LineNet& net, const Times& times, const SequenceProblem& problem,
       const CancelToken* cancel);

  /// The events that are followed: start, anchor and end of each job, and the end of the run. Their
  /// numbers 1 ... columns() are the entries of a row.
  [[nodiscard]] std::size_t entries() const { return entries_; }
  [[nodiscard]] std::size_t entry(std::size_t job, int which, int n) const;
  static constexpr int kStart = 0;
  static constexpr int kAnchor = 1;
  static constexpr int kEnd = 2;
  static constexpr std::size_t kFinal = 0;  ///< where labels keep the end of the run
  [[nodiscard]] std::size_t final_entry() const {
    return problem_.jobs.size() * 3 * static_cast<std::size_t>(columns_);
  }
  [[nodiscard]] int columns() const { return columns_; }

  /// Without any delay: of every entry.
  [[nodiscard]] Tick base(std::size_t entry) const { return base_[entry]; }
  /// Where a label keeps the entry; -1: nothing that is done delays it.
  [[nodiscard]] int kept(std::size_t entry) const { return kept_[entry]; }
  /// Without any delay: of the entries that a label keeps.
  [[nodiscard]] const std::vector<Tick>& kept_base() const { return kept_base_; }
  /// (where it is kept, lag) after unit n of the job: entry >= tick of the unit + lag.
  [[nodiscard]] const std::vector<std::pair<std::uint32_t, Tick>>& after(std::size_t job,
                                                                         int n) const {
    return rows_[job][static_cast<std::size_t>(n - 1)];
  }
  /// Units of `needed` without which unit n of the job cannot be; of the end of the run.
  [[nodiscard]] int needs(std::size_t job, int n, std::size_t needed) const {
    return needs_[needed][job][static_cast<std::size_t>(n - 1)];
  }
  [[nodiscard]] int end_needs(std::size_t needed) const { return end_needs_[needed]; }
  /// Stores from which tokens go several ways: however they were shared, so many of them must have
  /// come before what used them.
  struct Fork {
    struct Use {
      int firings = 0;  ///< of the way that unit n of a job cannot be without
      Tick lag = 0;     ///< from the last of these to the first unit that needs it
    };
    int arrivals = -1;                                ///< event
    std::size_t entry = 0;                            ///< of its first arrival
    std::vector<std::vector<std::vector<Use>>> uses;  ///< [way][job][n - 1]
  };
  [[nodiscard]] const std::vector<Fork>& forks() const { return forks_; }

  /// Whether the order can be finished with no more than these units.
  [[nodiscard]] bool can_end(const std::vector<std::int16_t>& units) const;

 private:
  [[nodiscard]] bool cancelled() const { return cancel_ != nullptr && cancel_->requested(); }
  void fill(std::vector<Tick>& row, const Times& times) const;
  void ask_delays();
  void number_kept();
  void ask_needs();
  void ask_forks();
  void ask_uses(int event, std::vector<std::vector<Fork::Use>>& uses) const;

  const LineNet& net_;
  const Times& times_;
  const SequenceProblem& problem_;
  const CancelToken* cancel_;
  int columns_;
  std::size_t entries_;
  std::vector<Tick> base_;
  std::vector<int> kept_;
  std::vector<Tick> kept_base_;
  std::vector<std::vector<std::vector<std::pair<std::uint32_t, Tick>>>> rows_;
  std::vector<std::vector<std::vector<int>>> needs_;
  std::vector<int> end_needs_;
  std::vector<Fork> forks_;
};

}  // namespace linewright::bounds
