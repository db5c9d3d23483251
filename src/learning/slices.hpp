#pragma once

#include <cstdint>
#include <functional>

#include "linewright/base/worker_pool.hpp"

namespace linewright::learning {

/// Computes a batch in slices of its rows, each by a LibTorch that uses no other thread: at our
/// sizes that is nearly twice as fast on two cores as one LibTorch with two threads, which has to
/// wait for the other thread after every single operation. Where a batch is cut depends on its size
/// alone, so that sums over slices in their order are the same for any number of threads.
class SlicePool {
 public:
  /// `threads` 0: one per core. Where LibTorch computes on a GPU a batch is one slice.
  explicit SlicePool(std::size_t threads);

  /// Slices of a batch with so many rows.
  [[nodiscard]] std::size_t slices(std::int64_t rows) const;

  using Work = std::function<void(std::size_t slice, std::int64_t first, std::int64_t rows)>;
  /// Calls `work` once per slice, for several at the same time.
  void run(std::int64_t rows, const Work& work);

 private:
  WorkerPool pool_;
  bool whole_;  ///< never cut
};

}  // namespace linewright::learning
