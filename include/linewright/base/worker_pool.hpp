#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace linewright {

/// Threads that wait for work which is cut into equal shares. The caller's thread takes part, so a
/// pool of one has no thread of its own.
class WorkerPool {
 public:
  /// A range of items, and the number of the thread that works on it (0 ... size() - 1).
  using Work = std::function<void(std::size_t begin, std::size_t end, std::size_t thread)>;

  /// `threads` 0: one per core.
  explicit WorkerPool(std::size_t threads);
  ~WorkerPool();
  WorkerPool(const WorkerPool&) = delete;
  WorkerPool& operator=(const WorkerPool&) = delete;

  [[nodiscard]] std::size_t size() const { return threads_.size() + 1; }

  /// Calls `work` once per thread with its share of the items 0 ... count - 1, the same share every
  /// time, and returns when all are done. Throws what a share threw (of several, the first
  /// thread's). Not to be called from within `work`.
  void run(std::size_t count, const Work& work);

 private:
  void serve(std::size_t thread);
  void work_on_share(std::size_t thread);

  std::mutex mutex_;
  std::condition_variable start_;
  std::condition_variable done_;
  std::uint64_t round_ = 0;
  std::size_t busy_ = 0;
  bool stop_ = false;
  std::size_t count_ = 0;
  const Work* work_ = nullptr;
  std::vector<std::exception_ptr> failures_;
  std::vector<std::jthread> threads_;
};

}  // namespace linewright
