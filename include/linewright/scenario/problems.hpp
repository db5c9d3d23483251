#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "linewright/base/diagnostic.hpp"

namespace linewright::loading {

/// A spot in one of the files that make up a scenario. `line` 0 means the whole file.
struct SourceMark {
  int file = 0;  ///< index of Problems::add_file
  int line = 0;
  int column = 0;
};

/// Collects everything that is wrong, so that the user sees it all at once.
class Problems {
 public:
  /// More than anybody reads; keeps a hostile file from filling the memory with messages.
  static constexpr std::size_t kMostKept = 100;
  static constexpr std::size_t kMostHints = 20;

  /// Registers a file and returns its number for SourceMark.
  int add_file(std::string name);
  [[nodiscard]] const std::string& file_name(int file) const;

  void error(SourceMark mark, std::string message, std::string hint = {});

  /// name_hint() for a message. Comparing with every name takes time, so only the first messages
  /// get one; `candidates` is a list of names or makes one.
  template <class Candidates>
  [[nodiscard]] std::string hint(std::string_view name, const Candidates& candidates) const {
    if (found_.size() >= kMostHints) return {};
    if constexpr (std::is_invocable_v<Candidates>) {
      return name_hint(name, candidates());
    } else {
      return name_hint(name, candidates);
    }
  }

  [[nodiscard]] std::size_t count() const { return count_; }
  [[nodiscard]] bool none() const { return count_ == 0; }

  /// Throws ScenarioError with all problems in the order of the files' lines; nothing without any.
  void throw_if_any() const;

 private:
  struct Found {
    SourceMark mark;
    std::string message;
    std::string hint;
  };
  [[nodiscard]] Diagnostic diagnostic(const Found& found) const;

  std::vector<std::string> files_;
  std::vector<Found> found_;
  std::size_t count_ = 0;  ///< also those that are not kept any more
};

}  // namespace linewright::loading
