#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>

#include "linewright/base/diagnostic.hpp"
#include "linewright/environment/observation_spec.hpp"

namespace linewright {
namespace {

using Names = std::vector<std::string>;

bool holds(const Names& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// The first name that one has and the other has not, or two that stand in another order. A name is
/// called "{what} 'name'{owner}".
std::string difference(const Names& policy, const Names& line, const std::string& what,
                       const std::string& owner = "") {
  for (const std::string& name : line) {
    if (holds(policy, name)) continue;
    return fmt::format("the line has {} {}{}, the policy has not", what, in_quotes(name), owner);
  }
  for (const std::string& name : policy) {
    if (holds(line, name)) continue;
    return fmt::format("the policy has {} {}{}, the line has not", what, in_quotes(name), owner);
  }
  for (std::size_t i = 0; i < std::min(line.size(), policy.size()); ++i) {
    if (policy[i] == line[i]) continue;
    return fmt::format("{} {}{} is {} on the line, {} for the policy", what, i + 1, owner,
                       in_quotes(line[i]), in_quotes(policy[i]));
  }
  if (policy.size() == line.size()) return {};
  return fmt::format("the line has a {}{} twice, or the policy has", what, owner);
}

/// "machine" for a token of the group "machines".
std::string noun_of(const TokenGroup& group) {
  if (group.name == "machines" || group.name == "materials" || group.name == "tasks") {
    return group.name.substr(0, group.name.size() - 1);
  }
  return group.name;
}

const char* words(TokenGroup::Encoder encoder) {
  constexpr std::array kWords = {"interchangeable", "alike but named", "each of its own kind"};
  return kWords.at(static_cast<std::size_t>(encoder));
}

/// Names of interchangeable tokens are no matter, only how many there are.
std::string token_difference(const TokenGroup& policy, const TokenGroup& line) {
  if (line.encoder != TokenGroup::Encoder::kShared) {
    return difference(policy.tokens, line.tokens, noun_of(line));
  }
  if (policy.tokens.size() == line.tokens.size()) return {};
  return fmt::format("the line has room for {} of {}, the policy for {}", line.tokens.size(),
                     in_quotes(line.name), policy.tokens.size());
}

std::string group_difference(const TokenGroup& policy, const TokenGroup& line) {
  if (policy.encoder != line.encoder) {
    return fmt::format("{} are {} on the line and {} for the policy", in_quotes(line.name),
                       words(line.encoder), words(policy.encoder));
  }
  std::string found = token_difference(policy, line);
  if (!found.empty()) return found;
  for (std::size_t i = 0; i < std::min(policy.features.size(), line.features.size()); ++i) {
    const bool own = line.encoder == TokenGroup::Encoder::kOwn && i < line.tokens.size();
    const std::string owner =
        own ? noun_of(line) + " " + in_quotes(line.tokens[i]) : in_quotes(line.name);
    found = difference(policy.features[i], line.features[i], "number", " of " + owner);
    if (!found.empty()) return found;
  }
  return policy.features.size() == line.features.size()
             ? ""
             : fmt::format("{} have other lists of numbers", in_quotes(line.name));
}

Names names_of(const std::vector<TokenGroup>& groups) {
  Names names;
  for (const TokenGroup& group : groups) names.push_back(group.name);
  return names;
}

}  // namespace

std::string explain_mismatch(const ObservationSpec& policy, const ObservationSpec& line) {
  if (policy.version != line.version) {
    return fmt::format("observations are of version {} for the policy, of version {} for the line",
                       policy.version, line.version);
  }
  std::string found = difference(names_of(policy.groups), names_of(line.groups), "group");
  if (!found.empty()) return found;
  for (std::size_t i = 0; i < line.groups.size(); ++i) {
    found = group_difference(policy.groups[i], line.groups[i]);
    if (!found.empty()) return found;
  }
  return difference(policy.actions, line.actions, "action");
}

}  // namespace linewright
