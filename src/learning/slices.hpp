#pragma once

#include <cstdint>
#include <functional>

#include "linewright/base/worker_pool.hpp"

namespace linewright::learning {

/// Computes a batch in slices of its rows, one per thread, each with a LibTorch that uses no other
/// thread: at our sizes that is nearly twice as fast on two cores as one LibTorch with two threads,
/// which has to wait for the other thread after every single operation. The slices depend on the
/// number of threads alone, so results are deterministic for it.
class SlicePool {
 public:
  /// `threads` 0: one per core. One slice where LibTorch computes on a GPU.
  explicit SlicePool(std::size_t threads);

  [[nodiscard]] std::size_t size() const { return pool_.size(); }

  using Work = std::function<void(std::size_t slice, std::int64_t first, std::int64_t rows)>;
  /// Calls `work` once per slice that has rows, all at the same time.
  void run(std::int64_t rows, const Work& work);

 private:
  WorkerPool pool_;
};

}  // namespace linewright::learning
