#include "linewright/scenario/source_node.hpp"

#include <algorithm>
#include <utility>

#include "linewright/base/hash.hpp"

namespace linewright::loading {
namespace {

class Fnv1a {
 public:
  void add(std::string_view bytes) { hash_ = hash_of(bytes, hash_); }
  /// A text behind its kind and length, so that no two different trees read the same.
  void add_text(char kind, std::string_view text) {
    add({&kind, 1});
    add(std::to_string(text.size()));
    add(":");
    add(text);
  }
  [[nodiscard]] std::uint64_t value() const { return hash_; }

 private:
  std::uint64_t hash_ = kHashStart;
};

void hash_node(const SourceNode& node, Fnv1a& hash) {
  switch (node.type) {
    case SourceNode::Type::kScalar:
      hash.add_text('s', node.text);
      break;
    case SourceNode::Type::kList:
      hash.add("[");
      for (const SourceNode& item : node.items) hash_node(item, hash);
      hash.add("]");
      break;
    case SourceNode::Type::kMapping:
      hash.add("{");
      for (const SourceEntry& entry : node.entries) {
        hash.add_text('k', entry.key);
        hash_node(entry.value, hash);
      }
      hash.add("}");
      break;
    case SourceNode::Type::kNull:
    case SourceNode::Type::kBroken:
      hash.add("~");
      break;
  }
}

}  // namespace

const SourceNode* SourceNode::find(std::string_view key) const {
  const auto entry = std::find_if(entries.begin(), entries.end(),
                                  [&](const SourceEntry& e) { return e.key == key; });
  if (entry == entries.end() || entry->value.is_broken()) return nullptr;
  return &entry->value;
}

SourceNode* SourceNode::find(std::string_view key) {
  return const_cast<SourceNode*>(std::as_const(*this).find(key));
}

void SourceNode::break_off() {
  type = Type::kBroken;
  sound = false;
  text.clear();
  items.clear();
  entries.clear();
}

std::size_t weight_of(std::string_view text) { return text.size() / 32; }

std::size_t weight_of(const SourceNode& node) {
  std::size_t weight = 1 + weight_of(node.text);
  for (const SourceNode& item : node.items) weight += weight_of(item);
  for (const SourceEntry& entry : node.entries)
    weight += weight_of(entry.key) + weight_of(entry.value);
  return weight;
}

std::size_t depth_of(const SourceNode& node) {
  std::size_t deepest = 0;
  for (const SourceNode& item : node.items) deepest = std::max(deepest, depth_of(item));
  for (const SourceEntry& entry : node.entries) deepest = std::max(deepest, depth_of(entry.value));
  return deepest + 1;
}

std::uint64_t content_hash(const SourceNode& root) {
  Fnv1a hash;
  hash_node(root, hash);
  return hash.value();
}

}  // namespace linewright::loading
