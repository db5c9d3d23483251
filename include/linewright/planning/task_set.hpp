#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>

#include "linewright/base/id.hpp"
#include "linewright/simulation/state.hpp"

namespace linewright {

/// A set of the tasks of a line: a bit each, without memory of its own on the heap. Task ids must
/// be below kMostTasks, which every scenario keeps to.
class TaskSet {
 public:
  static constexpr std::size_t kMostTasks = 1024;

  TaskSet() = default;

  /// The tasks that are selectable in `state`, of the first `tasks` ones (those of its line).
  static TaskSet selectable(const SimulationState& state, std::size_t tasks) {
    TaskSet set;
    for (std::size_t word = 0; word * 64 < tasks; ++word) {
      const std::size_t left = tasks - word * 64;
      const std::uint64_t mask = left >= 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << left) - 1;
      set.words_[word] = state.selectable[word] & mask;
    }
    return set;
  }

  [[nodiscard]] bool contains(TaskId task) const {
    return ((words_[task.index() / 64] >> (task.index() % 64)) & 1U) != 0;
  }
  void insert(TaskId task) { words_[task.index() / 64] |= bit(task); }
  void erase(TaskId task) { words_[task.index() / 64] &= ~bit(task); }

  [[nodiscard]] bool empty() const {
    for (const std::uint64_t word : words_) {
      if (word != 0) return false;
    }
    return true;
  }
  [[nodiscard]] std::size_t size() const {
    std::size_t count = 0;
    for (const std::uint64_t word : words_) count += static_cast<std::size_t>(std::popcount(word));
    return count;
  }

  /// Calls `visit(TaskId)` for every task in it, in order of their ids.
  template <class Visit>
  void each(Visit&& visit) const {
    for (std::size_t word = 0; word < words_.size(); ++word) {
      for (std::uint64_t bits = words_[word]; bits != 0; bits &= bits - 1) {
        visit(TaskId(word * 64 + static_cast<std::size_t>(std::countr_zero(bits))));
      }
    }
  }

  friend bool operator==(const TaskSet&, const TaskSet&) = default;

 private:
  static std::uint64_t bit(TaskId task) { return std::uint64_t{1} << (task.index() % 64); }

  std::array<std::uint64_t, kMostTasks / 64> words_{};
};

}  // namespace linewright
