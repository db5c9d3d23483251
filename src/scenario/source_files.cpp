#include "linewright/scenario/source_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <optional>
#include <system_error>
#include <utility>
#include <vector>

#include "linewright/base/files.hpp"
#include "linewright/scenario/yaml_reader.hpp"

namespace linewright::loading {
namespace {

constexpr std::size_t kMostFiles = 8;

/// The files from the one the user named down to the one being read, and where each was named.
struct Chain {
  std::vector<std::string> identities;
  SourceMark named_at;  ///< the `extends` that led here; in the first file: the file itself
};

SourceNode broken_at(SourceMark mark) {
  SourceNode node;
  node.mark = mark;
  node.break_off();
  return node;
}

/// One name per file, however it is spelled, to recognise a cycle.
std::string identity_of(const std::string& file) {
  std::error_code error;
  const std::filesystem::path path = std::filesystem::weakly_canonical(file, error);
  return error ? file : path.string();
}

SourceNode read_chain(const std::string& file, Chain chain, Problems& problems);

/// Takes the key `extends` out of `root` and returns its value.
std::optional<SourceNode> take_extends(SourceNode& root) {
  const auto entry = std::find_if(root.entries.begin(), root.entries.end(),
                                  [](const SourceEntry& e) { return e.key == "extends"; });
  if (entry == root.entries.end()) return std::nullopt;
  SourceNode value = std::move(entry->value);
  root.entries.erase(entry);
  return value;
}

SourceNode on_base(SourceNode root, const SourceNode& extends, const std::string& file, Chain chain,
                   Problems& problems) {
  if (!extends.is_scalar() || extends.text.empty()) {
    problems.error(extends.mark, "'extends' must be the name of a file",
                   "write: extends: other.yaml");
    return root;
  }
  const std::string base_file = beside(file, extends.text);
  chain.named_at = extends.mark;
  SourceNode base = read_chain(base_file, std::move(chain), problems);
  if (base.is_broken()) return base;
  return merge(std::move(base), std::move(root), problems);
}

bool may_follow(const std::string& file, const Chain& chain, Problems& problems) {
  const std::string identity = identity_of(file);
  const auto& known = chain.identities;
  if (std::find(known.begin(), known.end(), identity) != known.end()) {
    problems.error(
        chain.named_at,
        fmt::format("'extends' leads in a circle: {} is extended already", in_quotes(file)),
        "extend a file that does not extend this one");
    return false;
  }
  if (known.size() >= kMostFiles) {
    problems.error(chain.named_at, fmt::format("more than {} files extend one another", kMostFiles),
                   "merge some of them");
    return false;
  }
  return true;
}

SourceNode read_chain(const std::string& file, Chain chain, Problems& problems) {
  if (!chain.identities.empty() && !may_follow(file, chain, problems)) {
    return broken_at(chain.named_at);
  }
  std::string reason;
  const std::optional<std::string> bytes = read_file(file, kMaxFileBytes, reason);
  if (!bytes) {
    if (chain.identities.empty()) chain.named_at = {problems.add_file(file), 0, 0};
    problems.error(chain.named_at, fmt::format("cannot read {}: {}", in_quotes(file), reason),
                   "check the name and the folder");
    return broken_at(chain.named_at);
  }
  const int number = problems.add_file(file);
  SourceNode root = read_yaml(*bytes, number, problems);
  if (!root.is_mapping()) return root;
  chain.identities.push_back(identity_of(file));
  const std::optional<SourceNode> extends = take_extends(root);
  if (!extends) return root;
  return on_base(std::move(root), *extends, file, std::move(chain), problems);
}

}  // namespace

SourceNode merge(SourceNode base, SourceNode over, Problems& problems) {
  if (!base.is_mapping() || !over.is_mapping()) return over;
  std::map<std::string, std::size_t> index;
  for (std::size_t i = 0; i < base.entries.size(); ++i) index[base.entries[i].key] = i;
  std::vector<bool> removed(base.entries.size(), false);
  std::vector<SourceEntry> added;
  for (SourceEntry& entry : over.entries) {
    const auto found = index.find(entry.key);
    if (found == index.end() && entry.value.is_null()) {
      problems.error(entry.mark, fmt::format("there is no key {} to remove", in_quotes(entry.key)),
                     "null removes a key of the extended file; write {} for an empty entry");
    } else if (found == index.end()) {
      added.push_back(std::move(entry));
    } else if (entry.value.is_null()) {
      removed[found->second] = true;
    } else {
      SourceEntry& old = base.entries[found->second];
      old.value = merge(std::move(old.value), std::move(entry.value), problems);
      old.mark = entry.mark;
    }
  }
  SourceNode merged = std::move(over);
  merged.sound = merged.sound && base.sound;
  merged.entries.clear();
  for (std::size_t i = 0; i < removed.size(); ++i) {
    if (!removed[i]) merged.entries.push_back(std::move(base.entries[i]));
  }
  std::move(added.begin(), added.end(), std::back_inserter(merged.entries));
  return merged;
}

SourceNode read_files(const std::string& file, Problems& problems) {
  return read_chain(file, {}, problems);
}

}  // namespace linewright::loading
