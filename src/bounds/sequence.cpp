#include "sequence.hpp"

#include <algorithm>
#include <map>

#include "sequence_lags.hpp"
#include "sequence_work.hpp"

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
        lags_(net, times, problem, cancel),
        work_(net, problem, lags_),
        most_states_(most_states),
        cancel_(cancel) {}

  /// Looks for ends below a limit, and raises it while there are none.
  SequenceResult run(Tick enough) {
    Tick proven = lags_.base(lags_.final_entry());
    while (proven < enough) {
      best_ = std::min(enough, proven + std::max(Tick{5}, proven / 50));
      const Tick limit = best_;
      if (!sweep()) break;
      proven = best_;
      if (best_ < limit) break;  // there is one: more cannot be proven
    }
    return {.ticks = proven, .states = states_};
  }

 private:
  static constexpr std::size_t kFinal = Lags::kFinal;

  using Layer = std::map<Key, std::vector<Label>>;

  /// Through the states by the number of units, without those that cannot end before `best_`.
  /// False: given up.
  bool sweep() {
    layers_.clear();
    finish(Units(problem_.jobs.size(), 0), {.releases = lags_.kept_base()});
    for (const int place : problem_.starts) {
      add(0, {Units(problem_.jobs.size(), 0), place},
          {.free = 0, .recovery = 1, .releases = lags_.kept_base()});
    }
    for (std::size_t number = 0; number < layers_.size(); ++number) {
      Layer layer = std::move(layers_[number]);
      if (layer.size() > most_states_) return false;
      const std::size_t labels = thin(layer);
      if (cancel_ != nullptr && cancel_->requested()) return false;
      states_ += labels;
      for (const auto& [key, list] : layer) {
        for (const Label& label : list) extend(number, key, label);
      }
    }
    return true;
  }

  /// Merges labels of a state where there are too many in all; returns how many are left.
  std::size_t thin(Layer& layer) const {
    std::size_t labels = 0;
    for (const auto& [key, list] : layer) labels += list.size();
    if (labels <= most_states_) return labels;
    const std::size_t width = std::max<std::size_t>(1, most_states_ / layer.size());
    labels = 0;
    for (auto& [key, list] : layer) {
      if (list.size() > width) {
        std::stable_sort(list.begin(), list.end(),
                         [](const Label& a, const Label& b) { return a.free < b.free; });
        std::vector<Label> kept(width);
        for (std::size_t i = 0; i < list.size(); ++i) {
          Label& into = kept[i * width / list.size()];
          if (into.releases.empty()) {
            into = std::move(list[i]);
          } else {
            merge(into, list[i]);
          }
        }
        list = std::move(kept);
      }
      labels += list.size();
    }
    return labels;
  }

  /// The run cannot end before this tick: some of the work that is left, and what must follow the
  /// last of it.
  [[nodiscard]] Tick promise(const Units& units, const Label& label) const {
    return std::max(label.releases[kFinal], work_.least_end(units, label.free));
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
    return relation_holds(sum, condition.relation);
  }

  void extend(std::size_t number, const Key& key, const Label& label) {
    for (std::size_t j = 0; j < problem_.jobs.size(); ++j) {
      const JobType& job = problem_.jobs[j];
      const auto most = static_cast<int>(job.variants.size());
      // Beyond the columns nothing is counted: the last execution that is may be taken as a smaller
      // one.
      const int left =
          job.supply > 0
              ? std::min({most, job.supply - key.units[j], lags_.columns() - key.units[j]})
              : most;
      for (int added = job.supply > 0 ? std::max(1, left) : 1; added <= left; ++added) {
        if (!allowed(key.units, j, added)) continue;
        take(number, key, label, j, added);
      }
    }
  }

  [[nodiscard]] Tick release_of(const Label& label, std::size_t entry) const {
    const int kept = lags_.kept(entry);
    return kept < 0 ? lags_.base(entry) : label.releases[static_cast<std::size_t>(kept)];
  }

  void take(std::size_t number, const Key& key, const Label& label, std::size_t j, int added) {
    const JobType& job = problem_.jobs[j];
    const auto most = static_cast<int>(job.variants.size());
    const JobType::Variant& variant = job.variants[static_cast<std::size_t>(added - 1)];
    // At least so many executions have been before this one.
    const int execution = most == 1 ? key.units[j] + 1 : key.units[j] / most + 1;
    const auto release = [&](int which) {
      return release_of(label, lags_.entry(j, which, execution));
    };
    const Tick from = job.start >= 0 ? release(Lags::kStart) : 0;
    Tick anchor = problem_.anchor(key.place, label.free, label.recovery, from, job);
    anchor = std::max(anchor, release(Lags::kAnchor));
    Units reached_units = key.units;
    reached_units[j] = static_cast<std::int16_t>(reached_units[j] + added);
    for (const Lags::Fork& fork : lags_.forks())
      anchor = std::max(anchor, shared(fork, reached_units, label) - variant.units.back());
    if (anchor >= best_) return;
    Label next = label;
    for (int unit = 1; unit <= added; ++unit) {
      const Tick tick = anchor + variant.units[static_cast<std::size_t>(unit - 1)];
      for (const auto& [entry, lag] : lags_.after(j, key.units[j] + unit))
        next.releases[entry] = std::max(next.releases[entry], tick + lag);
    }
    const Tick end = std::max(anchor + variant.anchor_to_end,
                              release_of(next, lags_.entry(j, Lags::kEnd, execution)));
    Key reached{std::move(reached_units), -1};
    forget(reached.units, next);
    if (next.releases[kFinal] >= best_) return;
    finish(reached.units, next);
    for (const JobEnd& way : job.ends) {
      reached.place = way.place;
      next.free = end + way.after;
      next.recovery = way.recovery;
      next.releases[kFinal] = promise(reached.units, next);
      if (next.releases[kFinal] >= best_) continue;
      settle(reached, next);
      add(number + static_cast<std::size_t>(added), reached, next);
    }
  }

  /// The tick before which the last of these units cannot be: all tokens of the fork that they and
  /// those before have used must have come.
  [[nodiscard]] Tick shared(const Lags::Fork& fork, const Units& units, const Label& label) const {
    int tokens = 0;
    Tick least_lag = kNever;
    for (const auto& way : fork.uses) {
      int firings = 0;
      Tick lag = 0;
      for (std::size_t j = 0; j < units.size(); ++j) {
        if (units[j] == 0) continue;
        const Lags::Fork::Use& use = way[j][static_cast<std::size_t>(units[j] - 1)];
        if (use.firings > firings) lag = 0;
        firings = std::max(firings, use.firings);
        if (use.firings == firings) lag = std::max(lag, use.lag);
      }
      if (firings > 0) least_lag = std::min(least_lag, lag);
      tokens += firings;
    }
    if (tokens == 0) return 0;
    const auto columns = static_cast<int>(fork.uses[0][0].size());
    const auto last = static_cast<std::size_t>(std::min(tokens, columns) - 1);
    return release_of(label, fork.entry + last) + least_lag;
  }

  /// What comes by itself before the resource can make use of it makes no difference.
  void settle(const Key& key, Label& label) const {
    for (std::size_t j = 0; j < key.units.size(); ++j) {
      const JobType& job = problem_.jobs[j];
      const auto most = static_cast<int>(job.variants.size());
      const int next = most == 1 ? key.units[j] + 1 : key.units[j] / most + 1;
      const Tick anchor = problem_.anchor(key.place, label.free, label.recovery, 0, job);
      const Tick once = job.variants[0].anchor_to_end;
      for (int n = next; n <= lags_.columns(); ++n) {
        const Tick before = (n - next) * once;
        const auto raise = [&](int which, Tick tick) {
          const int kept = lags_.kept(lags_.entry(j, which, n));
          if (kept < 0) return;
          Tick& release = label.releases[static_cast<std::size_t>(kept)];
          release = std::max(release, before + tick);
        };
        raise(Lags::kStart, label.free + label.recovery);
        raise(Lags::kAnchor, anchor);
        raise(Lags::kEnd, anchor + once);
      }
    }
  }

  /// What is behind makes no difference any more.
  void forget(const Units& units, Label& label) const {
    for (std::size_t j = 0; j < units.size(); ++j) {
      const auto most = static_cast<int>(problem_.jobs[j].variants.size());
      const int behind = most == 1 ? units[j] : units[j] / most;
      for (int n = 1; n <= std::min(behind, lags_.columns()); ++n) {
        for (int which = 0; which < 3; ++which) {
          const int kept = lags_.kept(lags_.entry(j, which, n));
          if (kept >= 0) label.releases[static_cast<std::size_t>(kept)] = 0;
        }
      }
    }
  }

  void finish(const Units& units, const Label& label) {
    for (std::size_t j = 0; j < units.size(); ++j) {
      if (units[j] < lags_.end_needs(j)) return;
    }
    auto known = ends_.find(units);
    if (known == ends_.end()) known = ends_.emplace(units, lags_.can_end(units)).first;
    if (known->second) best_ = std::min(best_, label.releases[kFinal]);
  }

  void add(std::size_t number, const Key& key, Label label) {
    if (layers_.size() <= number) layers_.resize(number + 1);
    std::vector<Label>& list = layers_[number][key];
    for (const Label& known : list) {
      if (at_most(known, label)) return;
    }
    std::erase_if(list, [&](const Label& known) { return at_most(label, known); });
    list.push_back(std::move(label));
  }

  const SequenceProblem& problem_;
  Lags lags_;
  Work work_;
  std::size_t most_states_;
  const CancelToken* cancel_;
  Tick best_ = kNever;
  std::size_t states_ = 0;
  std::vector<Layer> layers_;
  std::map<Units, bool> ends_;
};

}  // namespace

SequenceResult best_sequence(const LineNet& net, const Times& times, const SequenceProblem& problem,
                             Tick enough, std::size_t most_states, const CancelToken* cancel) {
  return Search(net, times, problem, most_states, cancel).run(enough);
}

Workload workload_of(const LineNet& net, const Times& times, const SequenceProblem& problem,
                     const CancelToken* cancel) {
  const Lags lags(net, times, problem, cancel);
  return Work(net, problem, lags).all();
}

}  // namespace linewright::bounds
