#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "linewright/training/log_file.hpp"

namespace linewright {

/// Scalars in a TensorBoard event file: TFRecords (length, masked CRC-32C, data, masked CRC-32C) of
/// the protocol buffer tensorflow.Event, encoded by hand. TensorBoard takes files whose name
/// contains "tfevents". Failures are as in LogFile.
class TensorBoardLog {
 public:
  /// A new file, begun with the event that names the format. `wall_time_s`: seconds since 1970.
  [[nodiscard]] static TensorBoardLog create(const std::string& path, double wall_time_s);
  /// Goes on with a file that is cut back to `size`, which size() gave after a flush.
  [[nodiscard]] static TensorBoardLog reopen(const std::string& path, std::uint64_t size);

  /// One point of the curve `tag` ("train/loss"). Equal arguments give equal bytes.
  void scalar(std::string_view tag, std::int64_t step, float value, double wall_time_s);
  void flush() { file_.flush(); }
  [[nodiscard]] std::uint64_t size() const { return file_.size(); }

 private:
  explicit TensorBoardLog(LogFile file);
  void record(std::string_view event);

  LogFile file_;
};

}  // namespace linewright
