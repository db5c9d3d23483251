#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace linewright {

/// Tokens of one kind within an observation: one per entity (paper, Sec. 3.1.2 and 3.3.5).
struct TokenGroup {
  /// How a network should encode the group's tokens.
  enum class Encoder : std::uint8_t {
    kShared,  ///< interchangeable entities (workers): one weight matrix and one bias for all
    kNamed,   ///< like entities with an identity (tasks): one weight matrix, a bias for each
    kOwn,     ///< unlike entities (machines, materials): a weight matrix and a bias for each
  };

  std::string name;  ///< a worker or carrier kind, "machines", "materials", "tasks" or "global"
  Encoder encoder = Encoder::kShared;
  std::vector<std::string> tokens;  ///< their names
  /// Names of the features: one list for all tokens, or (kOwn) one list for each.
  std::vector<std::vector<std::string>> features;

  [[nodiscard]] const std::vector<std::string>& features_of(std::size_t token) const {
    return features[encoder == Encoder::kOwn ? token : 0];
  }
  /// Numbers of all its tokens together.
  [[nodiscard]] std::size_t size() const;

  friend bool operator==(const TokenGroup&, const TokenGroup&) = default;
};

/// What an observation of a line looks like: which numbers stand where. An observation is
/// - `features`: float[feature_count()], group by group, token by token, without gaps;
/// - `present`: one byte per token, group by group: 1, or 0 for an entity that this run lacks (its
///   features are 0);
/// - `selectable`: one byte per action: 1 when it can be chosen now.
struct ObservationSpec {
  /// Version of the meaning of the features; changes whenever the same state gives other numbers.
  static constexpr int kVersion = 1;

  int version = kVersion;
  std::vector<TokenGroup> groups;  ///< "tasks" is the last but one, "global" (one token) the last
  /// The planner's choices: the tasks by number, and "wait" where the line allows it. The group
  /// "tasks" has one token for each, in this order.
  std::vector<std::string> actions;

  [[nodiscard]] std::size_t feature_count() const;
  [[nodiscard]] std::size_t token_count() const;

  friend bool operator==(const ObservationSpec&, const ObservationSpec&) = default;
};

/// The spec as JSON (compact, keys in fixed order), for the metadata of a policy file.
[[nodiscard]] std::string to_json(const ObservationSpec& spec);

/// Reads what to_json wrote. Throws ScenarioError (naming `file`) for anything else.
[[nodiscard]] ObservationSpec observation_spec_from_json(const std::string& json,
                                                         const std::string& file);

/// The first difference, in words ("the line has machine 'press', the policy has not"); empty when
/// a policy made for `policy` fits a line with `line`.
[[nodiscard]] std::string explain_mismatch(const ObservationSpec& policy,
                                           const ObservationSpec& line);

}  // namespace linewright
