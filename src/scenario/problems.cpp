#include "linewright/scenario/problems.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>
#include <utility>

namespace linewright::loading {
int Problems::add_file(std::string name) {
  files_.push_back(std::move(name));
  return static_cast<int>(files_.size()) - 1;
}

const std::string& Problems::file_name(int file) const {
  return files_[static_cast<std::size_t>(file)];
}

void Problems::error(SourceMark mark, std::string message, std::string hint) {
  ++count_;
  if (found_.size() < kMostKept) found_.push_back({mark, std::move(message), std::move(hint)});
}

Diagnostic Problems::diagnostic(const Found& found) const {
  return {.severity = Diagnostic::Severity::kError,
          .file = file_name(found.mark.file),
          .line = found.mark.line,
          .column = found.mark.column,
          .message = found.message,
          .hint = found.hint};
}

void Problems::throw_if_any() const {
  if (none()) return;
  const auto position = [](const Found& found) {
    return std::tie(found.mark.file, found.mark.line, found.mark.column);
  };
  std::vector<Found> sorted = found_;
  std::stable_sort(sorted.begin(), sorted.end(),
                   [&](const Found& a, const Found& b) { return position(a) < position(b); });
  std::vector<Diagnostic> diagnostics;
  diagnostics.reserve(sorted.size() + 1);
  for (const Found& found : sorted) diagnostics.push_back(diagnostic(found));
  if (count_ > found_.size()) {
    diagnostics.push_back({.severity = Diagnostic::Severity::kError,
                           .file = file_name(0),
                           .line = 0,
                           .column = 0,
                           .message = fmt::format("{} more problems", count_ - found_.size()),
                           .hint = "put right those above first"});
  }
  throw ScenarioError(std::move(diagnostics));
}

}  // namespace linewright::loading
