#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <limits>
#include <set>
#include <string>
#include <utility>

#include "linewright/base/diagnostic.hpp"
#include "linewright/environment/json_text.hpp"
#include "linewright/environment/observation_spec.hpp"

namespace linewright {
namespace {

using Json = nlohmann::json;
using OrderedJson = nlohmann::ordered_json;

constexpr const char* kTitle = "the observation's description";
/// Far above any line; whoever runs on the spec takes memory for it.
constexpr std::size_t kMostTokens = 4096;
constexpr std::size_t kMostFeatures = 1U << 20U;
constexpr std::array<const char*, 3> kEncoderNames = {"shared", "named", "own"};

OrderedJson json_of(const TokenGroup& group) {
  OrderedJson json;
  json["name"] = group.name;
  json["encoder"] = kEncoderNames.at(static_cast<std::size_t>(group.encoder));
  json["tokens"] = group.tokens;
  json["features"] = group.features;
  return json;
}

TokenGroup::Encoder encoder_of(const JsonFields& fields) {
  const std::string& name = fields.text("encoder");
  for (std::size_t i = 0; i < kEncoderNames.size(); ++i) {
    if (name == kEncoderNames[i]) return static_cast<TokenGroup::Encoder>(i);
  }
  fields.wrong("encoder", "'shared', 'named' or 'own'");
}

void check_distinct(const std::vector<std::string>& names, const std::string& what,
                    const JsonFields& fields) {
  std::set<std::string> known;
  for (const std::string& name : names) {
    if (!known.insert(name).second) {
      fields.fail(fmt::format("has the {} {} twice", what, in_quotes(name)));
    }
  }
}

TokenGroup read_group(const Json& json, std::size_t number, const std::string& file) {
  const JsonFields fields(json, fmt::format("group {} of {}", number + 1, kTitle), file);
  fields.allow_only({"name", "encoder", "tokens", "features"});
  TokenGroup group;
  group.name = fields.text("name");
  group.encoder = encoder_of(fields);
  group.tokens = fields.texts("tokens");
  check_distinct(group.tokens, "token", fields);
  for (const Json& list : fields.list("features")) {
    group.features.push_back(texts_of(list, "an entry of 'features'", fields));
    check_distinct(group.features.back(), "feature", fields);
  }
  const bool own = group.encoder == TokenGroup::Encoder::kOwn;
  const std::size_t wanted = own ? group.tokens.size() : 1;
  if (group.features.size() != wanted) {
    fields.fail(fmt::format("has {} lists of features: it needs {}", group.features.size(),
                            own ? "one for each token" : "one for all tokens"));
  }
  return group;
}

void check_size(const ObservationSpec& spec, const JsonFields& fields) {
  if (spec.token_count() > kMostTokens) {
    fields.fail(fmt::format("has more than {} tokens", kMostTokens));
  }
  if (spec.feature_count() > kMostFeatures) {
    fields.fail(fmt::format("has more than {} numbers", kMostFeatures));
  }
}

void check_groups(const ObservationSpec& spec, const JsonFields& fields) {
  std::vector<std::string> names;
  for (const TokenGroup& group : spec.groups) names.push_back(group.name);
  check_distinct(names, "group", fields);
  const std::size_t count = spec.groups.size();
  if (count < 2 || names[count - 1] != "global" || spec.groups[count - 1].tokens.size() != 1) {
    fields.fail("must end with the group 'global' of one token");
  }
  if (names[count - 2] != "tasks" || spec.groups[count - 2].tokens != spec.actions) {
    fields.fail("must have the group 'tasks', with a token for each action, last but one");
  }
  if (spec.actions.empty()) fields.fail("has no action");
}

void check_version(const JsonFields& fields, const std::string& file) {
  const std::int64_t version = fields.integer("version", 0, std::numeric_limits<int>::max());
  if (version == ObservationSpec::kVersion) return;
  throw ScenarioError(file,
                      fmt::format("observations are of version {} there, of version {} here",
                                  version, ObservationSpec::kVersion),
                      "train the policy again with this version of Linewright");
}

}  // namespace

std::string to_json(const ObservationSpec& spec) {
  OrderedJson json;
  json["version"] = spec.version;
  json["groups"] = OrderedJson::array();
  for (const TokenGroup& group : spec.groups) json["groups"].push_back(json_of(group));
  json["actions"] = spec.actions;
  return json.dump(-1, ' ', false, OrderedJson::error_handler_t::replace);
}

ObservationSpec observation_spec_from_json(const std::string& json, const std::string& file) {
  constexpr int kDeepest = 5;  // spec, groups, group, features, list
  const Json parsed = parse_json(json, file, kTitle, kDeepest);
  const JsonFields fields(parsed, kTitle, file);
  check_version(fields, file);  // other versions may have other keys
  fields.allow_only({"version", "groups", "actions"});
  ObservationSpec spec;
  for (const Json& group : fields.list("groups")) {
    spec.groups.push_back(read_group(group, spec.groups.size(), file));
  }
  spec.actions = fields.texts("actions");
  check_distinct(spec.actions, "action", fields);
  check_size(spec, fields);
  check_groups(spec, fields);
  return spec;
}

}  // namespace linewright
