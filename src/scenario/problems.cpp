#include "problems.hpp"

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

std::string in_quotes(std::string_view text) {
  constexpr std::size_t kLongest = 60;
  std::size_t length = std::min(text.size(), kLongest);
  // Never cut inside a UTF-8 sequence: continuation bytes start with the bits 10.
  while (length < text.size() && length > 0 &&
         (static_cast<unsigned char>(text[length]) >> 6) == 2) {
    --length;
  }
  std::string result = "'";
  for (const char c : text.substr(0, length)) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x20 || byte == 0x7f) {
      result += fmt::format("\\x{:02x}", byte);
    } else {
      result += c;
    }
  }
  if (length < text.size()) result += "...";
  return result + "'";
}

}  // namespace linewright::loading
