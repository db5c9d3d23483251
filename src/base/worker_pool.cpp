#include "linewright/base/worker_pool.hpp"

#include <algorithm>

namespace linewright {

WorkerPool::WorkerPool(std::size_t threads) {
  const std::size_t cores = std::max(1U, std::thread::hardware_concurrency());
  const std::size_t count = threads == 0 ? cores : threads;
  failures_.resize(count);
  for (std::size_t t = 1; t < count; ++t) {
    threads_.emplace_back([this, t] { serve(t); });
  }
}

WorkerPool::~WorkerPool() {
  {
    const std::scoped_lock lock(mutex_);
    stop_ = true;
  }
  start_.notify_all();
}

void WorkerPool::run(std::size_t count, const Work& work) {
  {
    const std::scoped_lock lock(mutex_);
    count_ = count;
    work_ = &work;
    busy_ = threads_.size();
    ++round_;
  }
  start_.notify_all();
  work_on_share(0);
  std::unique_lock lock(mutex_);
  done_.wait(lock, [this] { return busy_ == 0; });
  for (std::exception_ptr& failure : failures_) {
    if (!failure) continue;
    const std::exception_ptr first = failure;
    std::fill(failures_.begin(), failures_.end(), nullptr);
    std::rethrow_exception(first);
  }
}

void WorkerPool::work_on_share(std::size_t thread) {
  const std::size_t begin = count_ * thread / size();
  const std::size_t end = count_ * (thread + 1) / size();
  try {
    if (begin < end) (*work_)(begin, end, thread);
  } catch (...) {
    failures_[thread] = std::current_exception();
  }
}

void WorkerPool::serve(std::size_t thread) {
  std::uint64_t seen = 0;
  while (true) {
    {
      std::unique_lock lock(mutex_);
      start_.wait(lock, [&] { return stop_ || round_ != seen; });
      if (stop_) return;
      seen = round_;
    }
    work_on_share(thread);
    const std::scoped_lock lock(mutex_);
    if (--busy_ == 0) done_.notify_one();
  }
}

}  // namespace linewright
