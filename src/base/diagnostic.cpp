#include "linewright/base/diagnostic.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <utility>

namespace linewright {
namespace {

std::string join(const std::vector<Diagnostic>& diagnostics) {
  std::string text;
  for (const Diagnostic& diagnostic : diagnostics) {
    if (!text.empty()) text += '\n';
    text += to_string(diagnostic);
  }
  return text;
}

std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i + 1);
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t substituted = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = std::exchange(row[j + 1], std::min({row[j + 1] + 1, row[j] + 1, substituted}));
    }
  }
  return row.back();
}

}  // namespace

std::string to_string(const Diagnostic& d) {
  std::string where = d.file;
  if (d.line > 0) where += fmt::format(":{}", d.line);
  if (d.line > 0 && d.column > 0) where += fmt::format(":{}", d.column);
  if (!where.empty()) where += ": ";
  const char* severity = d.severity == Diagnostic::Severity::kError ? "error" : "warning";
  std::string text = fmt::format("{}{}: {}", where, severity, d.message);
  if (!d.hint.empty()) text += fmt::format("\n  hint: {}", d.hint);
  return text;
}

ScenarioError::ScenarioError(std::vector<Diagnostic> diagnostics)
    : std::runtime_error(join(diagnostics)), diagnostics_(std::move(diagnostics)) {}

ScenarioError::ScenarioError(std::string file, std::string message, std::string hint)
    : ScenarioError(std::vector<Diagnostic>{{.severity = Diagnostic::Severity::kError,
                                             .file = std::move(file),
                                             .line = 0,
                                             .column = 0,
                                             .message = std::move(message),
                                             .hint = std::move(hint)}}) {}

std::string nearest_name(std::string_view name, const std::vector<std::string>& candidates) {
  // Names longer than this are not typing errors of anything; comparing them only costs time.
  constexpr std::size_t kLongestName = 200;
  if (name.size() > kLongestName) return {};
  std::string best;
  std::size_t best_distance = name.size() / 2 + 1;
  for (const std::string& candidate : candidates) {
    if (candidate.size() > kLongestName) continue;
    const std::size_t distance = edit_distance(name, candidate);
    if (distance < best_distance && distance * 2 <= std::max(name.size(), candidate.size())) {
      best_distance = distance;
      best = candidate;
    }
  }
  return best;
}

std::string name_hint(std::string_view name, const std::vector<std::string>& candidates) {
  if (candidates.empty()) return {};
  const std::string nearest = nearest_name(name, candidates);
  if (!nearest.empty()) return fmt::format("did you mean '{}'?", nearest);
  constexpr std::size_t kMostNames = 12;
  std::string list;
  for (std::size_t i = 0; i < std::min(kMostNames, candidates.size()); ++i) {
    list += (i == 0 ? "" : ", ") + candidates[i];
  }
  return fmt::format("known: {}{}", list, candidates.size() > kMostNames ? ", ..." : "");
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

}  // namespace linewright
