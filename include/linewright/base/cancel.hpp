#pragma once

#include <atomic>

namespace linewright {

/// Asks long work to stop at the next safe point. Set from any thread or from a signal handler; the
/// work returns what it has. Once requested it stays requested.
class CancelToken {
 public:
  void request() noexcept { requested_.store(true, std::memory_order_relaxed); }
  [[nodiscard]] bool requested() const noexcept {
    return requested_.load(std::memory_order_relaxed);
  }

 private:
  std::atomic<bool> requested_{false};
};

}  // namespace linewright
