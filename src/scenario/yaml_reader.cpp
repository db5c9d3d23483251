#include "linewright/scenario/yaml_reader.hpp"

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/parser.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <istream>
#include <map>
#include <optional>
#include <streambuf>
#include <string>
#include <utility>

#include "linewright/base/utf8.hpp"

namespace linewright::loading {
namespace {

/// Thrown inside this file only: the document cannot be read any further.
struct Refused {
  SourceMark mark;
  std::string message;
  std::string hint;
};

SourceMark to_mark(const YAML::Mark& mark, int file) {
  if (mark.is_null()) return {file, 0, 0};
  return {file, mark.line + 1, mark.column + 1};
}

/// Reports every key that stands twice in one mapping and keeps the first of them.
void report_duplicate_keys(SourceNode& mapping, Problems& problems) {
  std::map<std::string_view, SourceMark> seen;
  std::vector<bool> twice(mapping.entries.size(), false);
  for (std::size_t i = 0; i < mapping.entries.size(); ++i) {
    const SourceEntry& entry = mapping.entries[i];
    const auto [first, is_new] = seen.try_emplace(entry.key, entry.mark);
    if (is_new) continue;
    twice[i] = true;
    problems.error(
        entry.mark, fmt::format("key {} is written twice", in_quotes(entry.key)),
        fmt::format("the first one is in line {}; keep one of them", first->second.line));
  }
  if (std::find(twice.begin(), twice.end(), true) == twice.end()) return;
  std::vector<SourceEntry> kept;
  for (std::size_t i = 0; i < twice.size(); ++i) {
    if (!twice[i]) kept.push_back(std::move(mapping.entries[i]));
  }
  mapping.entries = std::move(kept);
  mapping.sound = false;
}

/// Builds our tree from yaml-cpp's events.
class TreeBuilder : public YAML::EventHandler {
 public:
  TreeBuilder(int file, Problems& problems) : file_(file), problems_(problems) {}

  [[nodiscard]] SourceNode take_root() { return std::move(root_); }

  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}

  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    finish(new_node(SourceNode::Type::kNull, mark), anchor);
  }

  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& value) override {
    SourceNode node = new_node(SourceNode::Type::kScalar, mark);
    refuse_tag(tag, node.mark);
    count(weight_of(value), node.mark);
    node.text = value;
    node.was_quoted = tag == "!";
    finish(std::move(node), anchor);
  }

  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    const auto found = anchors_.find(anchor);
    if (found == anchors_.end()) {
      throw Refused{to_mark(mark, file_), "this alias is inside of what it stands for",
                    "write the value out"};
    }
    SourceNode copy = found->second;
    count(weight_of(copy), to_mark(mark, file_));
    if (open_.size() + depth_of(copy) > kMaxDepth) refuse_depth(to_mark(mark, file_));
    finish(std::move(copy), YAML::NullAnchor);
  }

  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value) override {
    open(SourceNode::Type::kList, mark, tag, anchor);
  }
  void OnSequenceEnd() override { close(); }

  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value) override {
    open(SourceNode::Type::kMapping, mark, tag, anchor);
  }
  void OnMapEnd() override {
    report_duplicate_keys(open_.back().node, problems_);
    close();
  }

 private:
  struct Open {
    SourceNode node;
    YAML::anchor_t anchor = YAML::NullAnchor;
    std::optional<SourceEntry> entry;  ///< mappings: the key read, its value still to come
  };

  SourceNode new_node(SourceNode::Type type, const YAML::Mark& mark) {
    SourceNode node;
    node.type = type;
    node.mark = to_mark(mark, file_);
    count(1, node.mark);
    return node;
  }

  void count(std::size_t more, SourceMark mark) {
    weight_ += more;
    if (weight_ <= kMaxWeight) return;
    throw Refused{mark,
                  fmt::format("the file has more than {} values, aliases written out", kMaxWeight),
                  "make the file smaller"};
  }

  static void refuse_tag(const std::string& tag, SourceMark mark) {
    if (tag.empty() || tag == "?" || tag == "!") return;
    throw Refused{mark, fmt::format("YAML tag {} is not allowed", in_quotes(tag)), "remove it"};
  }

  void open(SourceNode::Type type, const YAML::Mark& mark, const std::string& tag,
            YAML::anchor_t anchor) {
    SourceNode node = new_node(type, mark);
    refuse_tag(tag, node.mark);
    if (expects_key()) refuse_key(node.mark);
    if (open_.size() >= kMaxDepth) refuse_depth(node.mark);
    open_.push_back({std::move(node), anchor, std::nullopt});
  }

  void close() {
    Open closed = std::move(open_.back());
    open_.pop_back();
    finish(std::move(closed.node), closed.anchor);
  }

  void finish(SourceNode node, YAML::anchor_t anchor) {
    if (anchor != YAML::NullAnchor) {
      count(weight_of(node), node.mark);
      anchors_[anchor] = node;
    }
    if (open_.empty()) {
      root_ = std::move(node);
    } else if (open_.back().node.is_list()) {
      open_.back().node.items.push_back(std::move(node));
    } else if (expects_key()) {
      start_entry(node);
    } else {
      open_.back().entry->value = std::move(node);
      open_.back().node.entries.push_back(std::move(*open_.back().entry));
      open_.back().entry.reset();
    }
  }

  [[nodiscard]] bool expects_key() const {
    return !open_.empty() && open_.back().node.is_mapping() && !open_.back().entry.has_value();
  }

  void start_entry(const SourceNode& key) {
    if (!key.is_scalar()) refuse_key(key.mark);
    if (is_banned_word(key.text)) {
      problems_.error(key.mark,
                      fmt::format("{} is not allowed as a key: YAML 1.1 reads it as a boolean",
                                  in_quotes(key.text)),
                      "choose another name");
    }
    open_.back().entry = SourceEntry{key.text, key.mark, {}};
  }

  [[noreturn]] static void refuse_depth(SourceMark mark) {
    throw Refused{mark, fmt::format("more than {} levels of nesting", kMaxDepth),
                  "no file needs that many; count the brackets"};
  }

  [[noreturn]] static void refuse_key(SourceMark mark) {
    throw Refused{mark, "a key must be a single word", "write `key: value`"};
  }

  int file_;
  Problems& problems_;
  std::vector<Open> open_;
  std::map<YAML::anchor_t, SourceNode> anchors_;
  std::size_t weight_ = 0;
  SourceNode root_;
};

/// Reads the caller's bytes in place, without a copy.
class ViewBuffer : public std::streambuf {
 public:
  explicit ViewBuffer(std::string_view text) {
    char* begin = const_cast<char*>(text.data());  // streambuf's interface; it only reads
    setg(begin, begin, begin + text.size());
  }
};

/// yaml-cpp takes byte 4 for the end of the input and guesses other encodings; only text gets in.
void refuse_other_than_text(std::string_view text, int file) {
  if (text.size() > kMaxFileBytes) {
    throw Refused{{file, 0, 0},
                  fmt::format("the file is larger than {} bytes", kMaxFileBytes),
                  "is this the right file?"};
  }
  const std::size_t bad = first_not_text(text);
  if (bad == text.size()) return;
  const std::string_view before = text.substr(0, bad);
  const auto line = 1 + std::count(before.begin(), before.end(), '\n');
  const std::size_t line_start = before.rfind('\n') + 1;  // npos + 1 = 0
  throw Refused{
      {file, static_cast<int>(line), static_cast<int>(bad - line_start) + 1},
      fmt::format("byte 0x{:02x} is not allowed here", static_cast<unsigned char>(text[bad])),
      "save the file as UTF-8 text without control characters"};
}

SourceNode parse(std::string_view text, int file, Problems& problems) {
  refuse_other_than_text(text, file);
  ViewBuffer buffer(text);
  std::istream stream(&buffer);
  YAML::Parser parser(stream);
  TreeBuilder builder(file, problems);
  if (!parser.HandleNextDocument(builder)) {
    throw Refused{{file, 0, 0}, "the file is empty", "is this the right file?"};
  }
  TreeBuilder second(file, problems);
  if (parser.HandleNextDocument(second)) {
    throw Refused{second.take_root().mark, "the file holds a second YAML document",
                  "one file holds one: remove the line `---`"};
  }
  return builder.take_root();
}

}  // namespace

bool is_banned_word(std::string_view word) {
  static constexpr std::array<std::string_view, 6> kBanned = {"on", "off", "yes", "no", "y", "n"};
  if (word.size() > 3) return false;
  std::string lower(word);
  std::transform(lower.begin(), lower.end(), lower.begin(), [](char c) {
    return static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  });
  return std::find(kBanned.begin(), kBanned.end(), lower) != kBanned.end();
}

SourceNode read_yaml(std::string_view text, int file, Problems& problems) {
  SourceNode broken;
  broken.mark = {file, 0, 0};
  broken.break_off();
  try {
    return parse(text, file, problems);
  } catch (const Refused& refused) {
    problems.error(refused.mark, refused.message, refused.hint);
  } catch (const YAML::Exception& e) {
    problems.error(to_mark(e.mark, file), fmt::format("not valid YAML: {}", e.msg),
                   "often the cause is indentation, a bracket or a colon just before");
  }
  return broken;
}

}  // namespace linewright::loading
