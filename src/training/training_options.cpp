#include "linewright/training/training_options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "linewright/scenario/shape_check.hpp"
#include "linewright/scenario/source_files.hpp"
#include "linewright/scenario/yaml_reader.hpp"
#include "option_nodes.hpp"

namespace linewright {
namespace {

using loading::Problems;
using loading::SourceMark;
using loading::SourceNode;

constexpr std::size_t kDeepestKey = 4;
const std::string kWhole = "the file of options";

/// An override has no lines: everything in it is found at the override itself.
void set_mark(SourceNode& node, SourceMark mark) {
  node.mark = mark;
  for (SourceNode& item : node.items) set_mark(item, mark);
  for (loading::SourceEntry& entry : node.entries) {
    entry.mark = mark;
    set_mark(entry.value, mark);
  }
}

/// The keys of `group.key`, innermost first; empty when it has none or too many.
std::vector<std::string> keys_of(std::string_view path) {
  std::vector<std::string> keys;
  while (true) {
    const std::size_t dot = path.find('.');
    keys.emplace_back(path.substr(0, dot));
    if (keys.back().empty() || keys.size() > kDeepestKey) return {};
    if (dot == std::string_view::npos) break;
    path.remove_prefix(dot + 1);
  }
  std::reverse(keys.begin(), keys.end());
  return keys;
}

/// `group.key=value` as the tree {group: {key: value}}; broken when it was reported.
SourceNode override_tree(const std::string& text, Problems& problems) {
  const SourceMark mark{problems.add_file(fmt::format("override {}", in_quotes(text))), 0, 0};
  SourceNode node;
  node.mark = mark;
  node.break_off();
  const std::size_t equals = text.find('=');
  const std::vector<std::string> keys =
      equals == std::string::npos ? std::vector<std::string>() : keys_of(text.substr(0, equals));
  if (keys.empty()) {
    problems.error(mark, "an override must be GROUP.KEY=VALUE", "write, e.g., buffer.alpha=0.6");
    return node;
  }
  const std::string_view value = std::string_view(text).substr(equals + 1);
  SourceNode read = value.empty() ? SourceNode{} : loading::read_yaml(value, mark.file, problems);
  if (read.is_broken()) return node;
  set_mark(read, mark);
  if (read.is_null()) {
    problems.error(mark, "the override has no value", "write, e.g., buffer.alpha=0.6");
    return node;
  }
  for (const std::string& key : keys) {
    SourceNode outer;
    outer.type = SourceNode::Type::kMapping;
    outer.mark = mark;
    outer.entries.push_back({key, mark, std::move(read)});
    read = std::move(outer);
  }
  return read;
}

/// Whatever else is laid on a file that holds no mapping would hide that.
void require_mapping(SourceNode& root, Problems& problems) {
  if (root.is_mapping()) return;
  loading::check_shape(root, training_files::options_shape(), problems, kWhole);
  problems.throw_if_any();
}

/// From the tree of all files to the options.
TrainingOptions resolve(SourceNode root, const std::vector<std::string>& overrides,
                        Problems& problems) {
  for (const std::string& text : overrides) {
    SourceNode over = override_tree(text, problems);
    if (!over.is_broken()) root = loading::merge(std::move(root), std::move(over), problems);
  }
  loading::check_shape(root, training_files::options_shape(), problems, kWhole);
  problems.throw_if_any();
  TrainingOptions options = training_files::read_options(root);
  training_files::check_together(options, root, problems);
  problems.throw_if_any();
  return options;
}

}  // namespace

TrainingOptions load_training_options(const std::string& file, const std::string& preset,
                                      const std::vector<std::string>& overrides) {
  Problems problems;
  SourceNode root = loading::read_files(file, problems);
  require_mapping(root, problems);
  if (!preset.empty()) {
    SourceNode over = loading::read_files(preset, problems);
    if (!over.is_broken()) root = loading::merge(std::move(root), std::move(over), problems);
  }
  return resolve(std::move(root), overrides, problems);
}

TrainingOptions training_options_from_text(std::string_view text, const std::string& file_name,
                                           const std::vector<std::string>& overrides) {
  Problems problems;
  SourceNode root = loading::read_yaml(text, problems.add_file(file_name), problems);
  require_mapping(root, problems);
  if (const SourceNode* extends = root.find("extends")) {
    problems.error(extends->mark, "'extends' needs a file, and this text has no folder",
                   "load the options from a file");
    problems.throw_if_any();
  }
  return resolve(std::move(root), overrides, problems);
}

void check_training_options(const TrainingOptions& options) {
  static_cast<void>(training_options_from_text(to_yaml(options), "the options"));
}

std::optional<Tick> horizon_for(const RunSettings& run,
                                const std::vector<std::pair<std::string, std::int32_t>>& crew) {
  const auto has = [&](const auto& wanted) {
    return std::find(crew.begin(), crew.end(), wanted) != crew.end();
  };
  for (const HorizonRule& rule : run.horizon) {
    if (std::all_of(rule.crew.begin(), rule.crew.end(), has)) return rule.ticks;
  }
  return std::nullopt;
}

}  // namespace linewright
