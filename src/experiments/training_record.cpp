#include "linewright/experiments/training_record.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "linewright/base/diagnostic.hpp"
#include "linewright/base/files.hpp"
#include "linewright/scenario/values.hpp"

namespace linewright {
namespace {

constexpr std::size_t kMostBytes = std::size_t{1} << 26U;

std::vector<std::string_view> split(std::string_view text, char at) {
  std::vector<std::string_view> parts;
  while (true) {
    const std::size_t end = std::min(text.find(at), text.size());
    parts.push_back(text.substr(0, end));
    if (end == text.size()) return parts;
    text.remove_prefix(end + 1);
  }
}

std::vector<double> numbers_of(std::string_view line, std::size_t columns,
                               const std::string& where) {
  std::vector<double> numbers;
  for (const std::string_view field : split(line, ',')) {
    const auto number = loading::parse_real(field);
    if (!number) {
      throw ScenarioError(where, fmt::format("{} is no number", in_quotes(std::string(field))),
                          "the file must be a log of linewright train");
    }
    numbers.push_back(*number);
  }
  if (numbers.size() != columns) {
    throw ScenarioError(where, fmt::format("{} numbers for {} columns", numbers.size(), columns),
                        "the file must be a log of linewright train");
  }
  return numbers;
}

}  // namespace

std::optional<std::size_t> NumberTable::find(std::string_view column) const {
  const auto at = std::find(columns.begin(), columns.end(), column);
  if (at == columns.end()) return std::nullopt;
  return static_cast<std::size_t>(at - columns.begin());
}

NumberTable load_number_table(const std::string& file) {
  std::string reason;
  const auto text = read_file(file, kMostBytes, reason);
  if (!text) throw ScenarioError(file, "cannot be read: " + reason, "");
  if (text->size() > kMostBytes) {
    throw ScenarioError(file, fmt::format("is larger than {} bytes", kMostBytes), "");
  }
  NumberTable table;
  std::size_t number = 0;
  for (const std::string_view line : split(*text, '\n')) {
    ++number;
    if (number == 1) {
      for (const std::string_view column : split(line, ',')) table.columns.emplace_back(column);
    } else if (!line.empty()) {
      table.rows.push_back(
          numbers_of(line, table.columns.size(), fmt::format("{}:{}", file, number)));
    }
  }
  return table;
}

TrainingRecord load_training_record(const std::string& progress_file,
                                    const std::string& evaluations_file) {
  TrainingRecord record;
  if (std::filesystem::exists(progress_file)) record.progress = load_number_table(progress_file);
  if (std::filesystem::exists(evaluations_file)) {
    record.evaluations = load_number_table(evaluations_file);
  }
  return record;
}

std::optional<double> TrainingRecord::minutes() const {
  const auto updates = last("updates");
  return updates ? minutes_until(*updates) : std::nullopt;
}

std::optional<double> TrainingRecord::minutes_until(double updates) const {
  const auto clock = progress.find("wall_time_s");
  const auto count = progress.find("updates");
  if (!clock || !count) return std::nullopt;
  for (const std::vector<double>& row : progress.rows) {
    if (row[*count] < updates) continue;
    return (row[*clock] - progress.rows.front()[*clock]) / 60.0;
  }
  return std::nullopt;
}

std::optional<double> TrainingRecord::last(std::string_view column) const {
  const auto at = progress.find(column);
  if (!at || progress.rows.empty()) return std::nullopt;
  return progress.rows.back()[*at];
}

std::optional<double> TrainingRecord::best_makespan() const {
  const auto makespan = evaluations.find("makespan");
  const auto success = evaluations.find("success");
  if (!makespan || !success) return std::nullopt;
  std::optional<double> best;
  for (const std::vector<double>& row : evaluations.rows) {
    if (row[*success] < 1.0) continue;
    best = std::min(best.value_or(row[*makespan]), row[*makespan]);
  }
  return best;
}

std::optional<double> TrainingRecord::updates_until(double makespan) const {
  const auto column = evaluations.find("makespan");
  const auto success = evaluations.find("success");
  const auto updates = evaluations.find("updates");
  if (!column || !success || !updates) return std::nullopt;
  for (const std::vector<double>& row : evaluations.rows) {
    if (row[*success] >= 1.0 && row[*column] <= makespan) return row[*updates];
  }
  return std::nullopt;
}

}  // namespace linewright
