#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <string>
#include <string_view>
#include <vector>

#include "linewright/allocation/allocator.hpp"
#include "option_nodes.hpp"

namespace linewright::training_files {
namespace {

using loading::Problems;
using loading::SourceMark;
using loading::SourceNode;

constexpr std::size_t kLongestName = 100;

/// Reports at the key that is more likely the wrong one, or at its group, or at the file.
class TogetherCheck {
 public:
  TogetherCheck(const SourceNode& root, Problems& problems) : root_(root), problems_(problems) {}

  void require(bool holds, const char* group, const char* key, const std::string& message,
               const std::string& hint) {
    if (!holds) problems_.error(mark_of(group, key), message, hint);
  }

  void require_word(const std::string& word, const char* group, const char* key) {
    require(is_word(word), group, key,
            fmt::format("'{}.{}': {} is no name", group, key, in_quotes(word)),
            "use letters, digits, '-', '_' and '.'");
  }

 private:
  static bool is_word(std::string_view word) {
    return !word.empty() && word.size() <= kLongestName &&
           std::all_of(word.begin(), word.end(), [](char c) {
             return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-' || c == '_' ||
                    c == '.';
           });
  }
  [[nodiscard]] SourceMark mark_of(const char* group, const char* key) const {
    const SourceNode* of_group = root_.find(group);
    if (of_group == nullptr) return root_.mark;
    const SourceNode* value = of_group->find(key);
    return value != nullptr ? value->mark : of_group->mark;
  }

  const SourceNode& root_;
  Problems& problems_;
};

void check_horizon(const RunSettings& run, TogetherCheck& check) {
  for (const HorizonRule& rule : run.horizon) {
    for (const auto& [kind, count] : rule.crew) check.require_word(kind, "run", "horizon");
  }
  const auto any_crew = std::find_if(run.horizon.begin(), run.horizon.end(),
                                     [](const HorizonRule& rule) { return rule.crew.empty(); });
  check.require(any_crew == run.horizon.end() || any_crew + 1 == run.horizon.end(), "run",
                "horizon", "'run.horizon': a rule without `crew` fits all, those behind it none",
                "put the rule without `crew` last");
}

}  // namespace

void check_together(const TrainingOptions& o, const SourceNode& root, Problems& problems) {
  TogetherCheck check(root, problems);
  check.require_word(o.algorithm.name, "algorithm", "name");
  const std::vector<std::string>& allocators = allocator_names();
  check.require(
      std::find(allocators.begin(), allocators.end(), o.run.allocator) != allocators.end(), "run",
      "allocator", fmt::format("'run.allocator': unknown allocator {}", in_quotes(o.run.allocator)),
      name_hint(o.run.allocator, allocators));
  check.require(o.network.width % o.network.heads == 0, "network", "width",
                fmt::format("'network.width' ({}) must be a multiple of 'network.heads' ({})",
                            o.network.width, o.network.heads),
                "each head works on an equal share of the width");
  check.require(o.buffer.beta_start <= o.buffer.beta_end, "buffer", "beta_start",
                "'buffer.beta_start' must not be above 'buffer.beta_end'", "beta rises");
  check.require(o.buffer.copies <= o.buffer.capacity, "buffer", "copies",
                "'buffer.copies' must not be above 'buffer.capacity'",
                "the buffer must have room for one transition with all its copies");
  check.require(o.exploration.epsilon_end <= o.exploration.epsilon_start, "exploration",
                "epsilon_end", "'exploration.epsilon_end' must not be above 'epsilon_start'",
                "epsilon falls");
  check.require(o.optimizer.warmup <= o.buffer.capacity, "optimizer", "warmup",
                "'optimizer.warmup' must not be above 'buffer.capacity'",
                "the buffer would never hold that many transitions");
  check.require(o.optimizer.warmup >= o.optimizer.batch, "optimizer", "warmup",
                "'optimizer.warmup' must not be below 'optimizer.batch'",
                "the first update needs that many transitions");
  check_horizon(o.run, check);
}

}  // namespace linewright::training_files
