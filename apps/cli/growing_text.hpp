#pragma once

#include <cstddef>
#include <mutex>
#include <string>
#include <string_view>

namespace linewright::cli {

/// A text that grows until it is finished, such as the log of a run that is still going on. One
/// thread may write while others read.
class GrowingText {
 public:
  GrowingText() = default;
  /// A text that is finished already.
  explicit GrowingText(std::string text) : text_(std::move(text)), finished_(true) {}

  void append(std::string_view text) {
    const std::scoped_lock lock(mutex_);
    text_ += text;
  }
  void finish() {
    const std::scoped_lock lock(mutex_);
    finished_ = true;
  }

  /// The next bytes from `offset` on, at most `most` (none yet: empty). `at_end`: nothing will
  /// follow them.
  [[nodiscard]] std::string read(std::size_t offset, std::size_t most, bool& at_end) const {
    const std::scoped_lock lock(mutex_);
    std::string part = offset < text_.size() ? text_.substr(offset, most) : std::string();
    at_end = finished_ && offset + part.size() >= text_.size();
    return part;
  }

 private:
  mutable std::mutex mutex_;
  std::string text_;
  bool finished_ = false;
};

}  // namespace linewright::cli
