#include "sequence.hpp"

#include <algorithm>
#include <map>

#include "sequence_lags.hpp"

namespace linewright::bounds {
namespace {

using Units = std::vector<std::int16_t>;

/// What is known after some jobs: the least ticks that follow from when they were done.
struct Label {
  Tick free = 0;
  Tick recovery = 0;
  std::vector<Tick> releases;
};

/// Jobs done and where the resource is.
struct Key {
  Units units;
  int place = -1;
  friend bool operator<(const Key& a, const Key& b) {
    return a.units != b.units ? a.units < b.units : a.place < b.place;
  }
};

bool at_most(const Label& a, const Label& b) {
  if (a.free > b.free || a.recovery > b.recovery) return false;
  for (std::size_t e = 0; e < a.releases.size(); ++e) {
    if (a.releases[e] > b.releases[e]) return false;
  }
  return true;
}

/// A label that is no later than either.
void merge(Label& into, const Label& other) {
  into.free = std::min(into.free, other.free);
  into.recovery = std::min(into.recovery, other.recovery);
  for (std::size_t e = 0; e < into.releases.size(); ++e)
    into.releases[e] = std::min(into.releases[e], other.releases[e]);
}

class Search {
 public:
  Search(const LineNet& net, const Times& times, const SequenceProblem& problem,
         std::size_t most_states, const CancelToken* cancel)
      : problem_(problem),
        lags_(net, times, problem),
        most_states_(most_states),
        cancel_(cancel) {
    weigh_work();
  }

  std::optional<SequenceResult> run() {
    // Narrow first: whatever it finds, no label that is later can lead to the least end.
    best_ = kNever;
    sweep(kNarrow, true);
    const Tick found = best_;
    if (!sweep(kWide, false)) return std::nullopt;
    return SequenceResult{.ticks = std::min(best_, found), .states = states_};
  }

 private:
  static constexpr std::size_t kNarrow = 50;  // labels per number of units in the first sweep
  static constexpr std::size_t kWide = 12;    // labels per state before they are merged

  using Layer = std::map<Key, std::vector<Label>>;

  /// Through the states by the number of units. False: given up.
  bool sweep(std::size_t width, bool narrow) {
    layers_.clear();
    for (const int place : problem_.starts)
      add(0, {Units(problem_.jobs.size(), 0), place},
          {.free = 0, .recovery = 1, .releases = lags_.base()}, width);
    for (std::size_t number = 0; number < layers_.size(); ++number) {
      Layer layer = std::move(layers_[number]);
      if (narrow) thin(layer);
      std::size_t labels = 0;
      for (const auto& [key, list] : layer) labels += list.size();
      if (!narrow && labels > most_states_) return false;
      if (cancel_ != nullptr && cancel_->requested()) return false;
      states_ += labels;
      for (const auto& [key, list] : layer) {
        for (const Label& label : list) extend(number, key, label, width);
      }
    }
    return true;
  }

  /// Keeps the labels that promise the earliest ends.
  void thin(Layer& layer) const {
    std::vector<Tick> promises;
    for (const auto& [key, list] : layer) {
      for (const Label& label : list) promises.push_back(promise(key.units, label));
    }
    if (promises.size() <= kNarrow) return;
    std::nth_element(promises.begin(), promises.begin() + kNarrow, promises.end());
    const Tick limit = promises[kNarrow];
    for (auto& [key, list] : layer) {
      std::erase_if(list,
                    [&](const Label& label) { return promise(key.units, label) >= limit; });
    }
  }

  /// The run cannot end before this tick.
  [[nodiscard]] Tick promise(const Units& units, const Label& label) const {
    Tick work = label.free;
    Tick rest = kNever;
    for (std::size_t j = 0; j < units.size(); ++j) {
      const int missing = lags_.end_needs(j) - units[j];
      if (missing <= 0) continue;
      work += least_work_[j][static_cast<std::size_t>(missing)];
      // The last of these jobs need not be over at the end, only its first unit.
      for (const JobType::Variant& variant : problem_.jobs[j].variants)
        rest = std::min(rest, variant.anchor_to_end - variant.units.front());
    }
    const Tick end = label.releases[lags_.final_entry()];
    return rest >= kNever ? end : std::max(end, work - std::max(0, rest));
  }

  /// By job and units: the least ticks in which the resource can do them.
  void weigh_work() {
    for (const JobType& job : problem_.jobs) {
      auto& least = least_work_.emplace_back(1, 0);
      for (int units = 1; units <= lags_.columns(); ++units) {
        Tick best = kNever;
        for (int v = 1; v <= std::min(units, static_cast<int>(job.variants.size())); ++v) {
          const Tick once = job.variants[static_cast<std::size_t>(v - 1)].anchor_to_end +
                            job.before + job.least;
          best = std::min(best, once + least[static_cast<std::size_t>(units - v)]);
        }
        least.push_back(best);
      }
    }
  }

  [[nodiscard]] bool allowed(const Units& units, std::size_t j, int added) const {
    const int n = units[j] + added;
    if (n > lags_.columns()) return false;
    for (std::size_t i = 0; i < units.size(); ++i) {
      const int needed = lags_.needs(j, n, i);
      if (needed > units[i] && i != j && units[i] < lags_.columns()) return false;
    }
    for (const CountCondition& condition : problem_.conditions[j]) {
      if (!holds(condition, units)) return false;
    }
    return true;
  }

  [[nodiscard]] bool holds(const CountCondition& condition, const Units& units) const {
    std::int64_t sum = condition.constant;
    for (const auto& [job, coefficient] : condition.terms) {
      if (units[job] >= lags_.columns()) return true;  // no longer counted
      sum += std::int64_t{coefficient} * units[job];
    }
    switch (condition.relation) {
      case Relation::kEqual:
        return sum == 0;
      case Relation::kNotEqual:
        return sum != 0;
      case Relation::kLess:
        return sum < 0;
      case Relation::kLessEqual:
        return sum <= 0;
      case Relation::kGreater:
        return sum > 0;
      case Relation::kGreaterEqual:
        return sum >= 0;
    }
    return true;
  }

  void extend(std::size_t number, const Key& key, const Label& label, std::size_t width) {
    for (std::size_t j = 0; j < problem_.jobs.size(); ++j) {
      const auto most = static_cast<int>(problem_.jobs[j].variants.size());
      for (int added = 1; added <= most; ++added) {
        if (!allowed(key.units, j, added)) continue;
        take(number, key, label, j, added, width);
      }
    }
  }

  void take(std::size_t number, const Key& key, const Label& label, std::size_t j, int added,
            std::size_t width) {
    const JobType& job = problem_.jobs[j];
    const auto most = static_cast<int>(job.variants.size());
    const JobType::Variant& variant = job.variants[static_cast<std::size_t>(added - 1)];
    // At least so many executions have been before this one.
    const int execution = most == 1 ? key.units[j] + 1 : key.units[j] / most + 1;
    const auto release = [&](int which) {
      return label.releases[lags_.entry(j, which, execution)];
    };
    const Tick from = job.start >= 0 ? release(Lags::kStart) : 0;
    Tick anchor = problem_.anchor(key.place, label.free, label.recovery, from, job);
    anchor = std::max(anchor, release(Lags::kAnchor));
    if (anchor >= best_) return;
    Label next = label;
    for (int unit = 1; unit <= added; ++unit) {
      const Tick tick = anchor + variant.units[static_cast<std::size_t>(unit - 1)];
      for (const auto& [entry, lag] : lags_.after(j, key.units[j] + unit))
        next.releases[entry] = std::max(next.releases[entry], tick + lag);
    }
    const Tick end = std::max(anchor + variant.anchor_to_end,
                              next.releases[lags_.entry(j, Lags::kEnd, execution)]);
    Key reached{key.units, -1};
    reached.units[j] = static_cast<std::int16_t>(reached.units[j] + added);
    forget(reached.units, next);
    if (next.releases[lags_.final_entry()] >= best_) return;
    finish(reached.units, next);
    for (const JobEnd& way : job.ends) {
      reached.place = way.place;
      next.free = end + way.after;
      next.recovery = way.recovery;
      if (promise(reached.units, next) >= best_) continue;
      add(number + static_cast<std::size_t>(added), reached, next, width);
    }
  }

  /// What is behind makes no difference any more.
  void forget(const Units& units, Label& label) const {
    for (std::size_t j = 0; j < units.size(); ++j) {
      const auto most = static_cast<int>(problem_.jobs[j].variants.size());
      const int behind = most == 1 ? units[j] : units[j] / most;
      for (int n = 1; n <= std::min(behind, lags_.columns()); ++n) {
        for (int which = 0; which < 3; ++which) label.releases[lags_.entry(j, which, n)] = 0;
      }
    }
  }

  void finish(const Units& units, const Label& label) {
    for (std::size_t j = 0; j < units.size(); ++j) {
      if (units[j] < lags_.end_needs(j)) return;
    }
    auto known = ends_.find(units);
    if (known == ends_.end()) known = ends_.emplace(units, lags_.can_end(units)).first;
    if (known->second) best_ = std::min(best_, label.releases[lags_.final_entry()]);
  }

  void add(std::size_t number, const Key& key, Label label, std::size_t width) {
    if (layers_.size() <= number) layers_.resize(number + 1);
    std::vector<Label>& list = layers_[number][key];
    for (const Label& known : list) {
      if (at_most(known, label)) return;
    }
    std::erase_if(list, [&](const Label& known) { return at_most(label, known); });
    if (list.size() >= width) {
      merge(label, list.back());
      list.pop_back();
    }
    list.push_back(std::move(label));
  }

  const SequenceProblem& problem_;
  Lags lags_;
  std::size_t most_states_;
  const CancelToken* cancel_;
  Tick best_ = kNever;
  std::size_t states_ = 0;
  std::vector<Layer> layers_;
  std::map<Units, bool> ends_;
  std::vector<std::vector<Tick>> least_work_;
};

}  // namespace

std::optional<SequenceResult> best_sequence(const LineNet& net, const Times& times,
                                            const SequenceProblem& problem,
                                            std::size_t most_states, const CancelToken* cancel) {
  return Search(net, times, problem, most_states, cancel).run();
}

}  // namespace linewright::bounds
