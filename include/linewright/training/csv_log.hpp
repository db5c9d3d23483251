#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "linewright/training/log_file.hpp"

namespace linewright {

/// A table of numbers as comma-separated values: one line of column names, then one line per row.
/// Failures are as in LogFile.
class CsvLog {
 public:
  /// A new file with its header. `columns` are words without commas, quotes and line ends; throws
  /// std::invalid_argument otherwise.
  [[nodiscard]] static CsvLog create(const std::string& path,
                                     const std::vector<std::string>& columns);
  /// Goes on with a file that is cut back to `size`. ScenarioError when it has other columns.
  [[nodiscard]] static CsvLog reopen(const std::string& path,
                                     const std::vector<std::string>& columns, std::uint64_t size);

  /// One number per column (std::invalid_argument otherwise), in the shortest form that reads back
  /// to the same bits; one that is not finite leaves its cell empty.
  void row(std::span<const double> values);
  void flush() { file_.flush(); }
  [[nodiscard]] std::uint64_t size() const { return file_.size(); }

 private:
  CsvLog(LogFile file, std::size_t columns);

  LogFile file_;
  std::size_t columns_;
};

}  // namespace linewright
