#include "slices.hpp"

#include <algorithm>

#include "torch_values.hpp"

namespace linewright::learning {
namespace {

/// Fewer would give more threads something to do, and LibTorch more calls per row.
constexpr std::int64_t kRowsPerSlice = 64;

}  // namespace

SlicePool::SlicePool(std::size_t threads)
    : pool_(default_device().is_cpu() ? threads : 1), whole_(!default_device().is_cpu()) {}

std::size_t SlicePool::slices(std::int64_t rows) const {
  return whole_ ? 1 : static_cast<std::size_t>((rows + kRowsPerSlice - 1) / kRowsPerSlice);
}

void SlicePool::run(std::int64_t rows, const Work& work) {
  if (whole_) {
    work(0, 0, rows);
    return;
  }
  pool_.run(slices(rows), [&](std::size_t begin, std::size_t end, std::size_t /*thread*/) {
    torch::set_num_threads(1);  // holds for the calling thread
    for (std::size_t slice = begin; slice < end; ++slice) {
      const std::int64_t first = static_cast<std::int64_t>(slice) * kRowsPerSlice;
      work(slice, first, std::min(kRowsPerSlice, rows - first));
    }
  });
}

}  // namespace linewright::learning
