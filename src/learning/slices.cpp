#include "slices.hpp"

#include "torch_values.hpp"

namespace linewright::learning {

SlicePool::SlicePool(std::size_t threads) : pool_(default_device().is_cpu() ? threads : 1) {}

void SlicePool::run(std::int64_t rows, const Work& work) {
  const bool alone = pool_.size() > 1;
  pool_.run(
      static_cast<std::size_t>(rows), [&](std::size_t begin, std::size_t end, std::size_t thread) {
        if (alone) torch::set_num_threads(1);  // holds for the calling thread
        work(thread, static_cast<std::int64_t>(begin), static_cast<std::int64_t>(end - begin));
      });
}

}  // namespace linewright::learning
