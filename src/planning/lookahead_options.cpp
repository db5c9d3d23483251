#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <string>
#include <utility>
#include <vector>

#include "linewright/base/diagnostic.hpp"
#include "linewright/planning/lookahead.hpp"

namespace linewright {
namespace {

constexpr const char* kBudgetHint =
    "write a budget per decision first: lookahead:10ms, lookahead:1s or lookahead:200r (rollouts)";

struct Unit {
  std::string_view name;
  std::int64_t ns;  ///< 0: rollouts
};
constexpr std::array<Unit, 4> kUnits{
    {{"us", 1'000}, {"ms", 1'000'000}, {"s", 1'000'000'000}, {"r", 0}}};

[[noreturn]] void refuse(const std::string& what, const std::string& hint) {
  throw ScenarioError({}, "lookahead: " + what, hint);
}

void parse_budget(std::string_view text, LookaheadOptions& options) {
  constexpr double kMost = 1e9;  // of any unit, but not beyond what 64 bits of nanoseconds hold
  double number = 0.0;
  const auto parsed = std::from_chars(text.data(), text.data() + text.size(), number);
  const std::string_view unit(parsed.ptr, text.data() + text.size());
  const auto known = std::find_if(kUnits.begin(), kUnits.end(),
                                  [&](const Unit& candidate) { return candidate.name == unit; });
  if (parsed.ec != std::errc() || known == kUnits.end()) {
    refuse(fmt::format("{} is no budget", in_quotes(text)), kBudgetHint);
  }
  if (!(number > 0.0) || number > kMost) {
    refuse(fmt::format("a budget of {} leaves nothing to look ahead with", in_quotes(text)),
           "write one above 0, such as lookahead:1ms; for no look-ahead name the base planner");
  }
  if (known->ns > 0) {
    options.budget_ns = std::max<std::int64_t>(
        1, static_cast<std::int64_t>(number * static_cast<double>(known->ns)));
  } else {
    options.rollouts = static_cast<std::size_t>(std::max(1.0, number));
  }
}

std::size_t parse_count(std::string_view key, std::string_view text) {
  constexpr std::size_t kMost = 1024;
  std::size_t number = 0;
  const auto parsed = std::from_chars(text.data(), text.data() + text.size(), number);
  if (parsed.ec != std::errc() || parsed.ptr != text.data() + text.size() || number < 1 ||
      number > kMost) {
    refuse(fmt::format("{} is no number of {}", in_quotes(text), key),
           fmt::format("write 1 to {}", kMost));
  }
  return number;
}

bool parse_choice(std::string_view key, std::string_view text, std::string_view off,
                  std::string_view on) {
  if (text == on) return true;
  if (text == off) return false;
  refuse(fmt::format("{} is no value of '{}'", in_quotes(text), key),
         fmt::format("write {}={} or {}={}", key, on, key, off));
}

void set_option(std::string_view key, std::string_view value, LookaheadOptions& options) {
  if (key == "base") {
    if (value.empty()) refuse("the base planner is missing", "write base=first");
    if (value == "lookahead" || value.starts_with("lookahead:")) {
      refuse("the base planner cannot look ahead itself", "name a rule, a priority or a policy");
    }
    options.base = value;
  } else if (key == "agents") {
    options.free_agents = parse_choice(key, value, "allocator", "free");
  } else if (key == "wait") {
    options.wait = parse_choice(key, value, "false", "true");
  } else if (key == "chains") {
    options.chains = parse_count(key, value);
  } else {
    options.threads = parse_count(key, value);
  }
}

/// Text up to the comma behind which the next option begins: values may hold commas themselves.
std::vector<std::pair<std::string, std::string>> split_options(std::string_view text) {
  static const std::vector<std::string> known{"base", "agents", "wait", "chains", "threads"};
  std::vector<std::pair<std::string, std::string>> options;
  while (!text.empty()) {
    const std::size_t comma = std::min(text.find(','), text.size());
    const std::string_view part = text.substr(0, comma);
    const std::size_t equals = part.find('=');
    text.remove_prefix(std::min(comma + 1, text.size()));
    if (equals == std::string_view::npos) {
      if (options.empty() || options.back().first != "base") {
        refuse(fmt::format("{} is no option", in_quotes(part)),
               "write KEY=VALUE; known: base, agents, wait, chains, threads");
      }
      options.back().second += "," + std::string(part);
      continue;
    }
    const std::string key(part.substr(0, equals));
    if (std::find(known.begin(), known.end(), key) == known.end()) {
      refuse(fmt::format("unknown option {}", in_quotes(key)), name_hint(key, known));
    }
    for (const auto& earlier : options) {
      if (earlier.first == key) refuse(fmt::format("'{}' is given twice", key), "give it once");
    }
    options.emplace_back(key, part.substr(equals + 1));
  }
  return options;
}

}  // namespace

LookaheadOptions parse_lookahead(std::string_view text) {
  LookaheadOptions options;
  const std::size_t comma = std::min(text.find(','), text.size());
  if (text.empty()) refuse("the budget is missing", kBudgetHint);
  parse_budget(text.substr(0, comma), options);
  for (const auto& [key, value] : split_options(text.substr(std::min(comma + 1, text.size())))) {
    set_option(key, value, options);
  }
  return options;
}

}  // namespace linewright
