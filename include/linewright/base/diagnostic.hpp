#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace linewright {

/// One thing that is wrong with what the user gave, and what to write instead.
struct Diagnostic {
  enum class Severity { kError, kWarning };

  Severity severity = Severity::kError;
  std::string file;  ///< as the user named it; empty when there is no file
  int line = 0;      ///< 1-based; 0 = the whole file
  int column = 0;    ///< 1-based; 0 = the whole line
  std::string message;
  std::string hint;  ///< what to write instead; may be empty
};

/// `file:line:column: error: message` and, on a second line, `  hint: ...` when there is one.
[[nodiscard]] std::string to_string(const Diagnostic& diagnostic);

/// The one exception for bad user input. Carries every diagnostic found, never just the first;
/// `what()` is all of them, one after the other.
class ScenarioError : public std::runtime_error {
 public:
  explicit ScenarioError(std::vector<Diagnostic> diagnostics);
  /// For input that is not a file of ours (an option, a log): one message and what to do about it.
  ScenarioError(std::string file, std::string message, std::string hint);

  [[nodiscard]] const std::vector<Diagnostic>& diagnostics() const { return diagnostics_; }

 private:
  std::vector<Diagnostic> diagnostics_;
};

/// The candidate nearest to `name` by edit distance (ties: the earlier one), or empty when none is
/// near enough to be what was meant (more than half of the letters differ).
[[nodiscard]] std::string nearest_name(std::string_view name,
                                       const std::vector<std::string>& candidates);

/// "did you mean 'x'?" when a near name exists, else "known: a, b, c" (at most 12 names).
[[nodiscard]] std::string name_hint(std::string_view name,
                                    const std::vector<std::string>& candidates);

/// `text` in single quotes, control characters escaped, long text cut: safe to put into a message.
[[nodiscard]] std::string in_quotes(std::string_view text);

}  // namespace linewright
