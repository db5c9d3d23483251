#include "linewright/training/csv_log.hpp"

#include <fmt/format.h>

#include <cmath>
#include <stdexcept>
#include <utility>

#include "linewright/base/diagnostic.hpp"
#include "linewright/base/files.hpp"

namespace linewright {
namespace {

std::string header_of(const std::vector<std::string>& columns) {
  std::string header;
  for (const std::string& column : columns) {
    if (column.empty() || column.find_first_of(",\"\r\n") != std::string::npos) {
      throw std::invalid_argument("a column's name must be a word");
    }
    header += (header.empty() ? "" : ",") + column;
  }
  return header + "\n";
}

}  // namespace

CsvLog::CsvLog(LogFile file, std::size_t columns) : file_(std::move(file)), columns_(columns) {}

CsvLog CsvLog::create(const std::string& path, const std::vector<std::string>& columns) {
  const std::string header = header_of(columns);
  CsvLog log(LogFile::create(path), columns.size());
  log.file_.append(header);
  log.flush();
  return log;
}

CsvLog CsvLog::reopen(const std::string& path, const std::vector<std::string>& columns,
                      std::uint64_t size) {
  const std::string header = header_of(columns);
  std::string reason;
  const auto start = read_file(path, header.size(), reason);
  if (!start) throw ScenarioError(path, "cannot be read: " + reason, "start the run anew");
  if (size < header.size() || !start->starts_with(header)) {
    throw ScenarioError(path, "does not begin with the columns of this run",
                        "the file was changed; start the run anew");
  }
  return {LogFile::reopen(path, size), columns.size()};
}

void CsvLog::row(std::span<const double> values) {
  if (values.size() != columns_) throw std::invalid_argument("a row has one number per column");
  std::string line;
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (i > 0) line += ',';
    if (std::isfinite(values[i])) line += fmt::format("{}", values[i]);
  }
  file_.append(line + "\n");
}

}  // namespace linewright
