#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "build_state.hpp"
#include "limits.hpp"
#include "linewright/scenario/values.hpp"

namespace linewright::loading {
namespace {

/// `finished_in >= order`, the goal unless the file has another.
Condition default_goal(PlaceId finished_in, const std::string& place) {
  Comparison comparison;
  comparison.terms = {{{VariableKind::kPlaceCount, finished_in.value}, 1},
                      {{VariableKind::kOrder, 0}, -1}};
  comparison.relation = Relation::kGreaterEqual;
  return {{{comparison}}, place + " >= order"};
}

void build_order(BuildState& state) {
  const SourceNode* node = state.root.find("order");
  if (node == nullptr) return;
  Order& order = state.line().order;
  order.quantity = integer_or(*node, "quantity", 1);
  if (const SourceNode* product = node->find("product")) {
    order.product = product->text;
    if (const auto fault = name_fault(product->text)) {
      state.problems.error(product->mark,
                           fmt::format("the order: {} cannot be the name of a product: {}",
                                       in_quotes(product->text), *fault));
    }
  }
  const auto place =
      reference_at<PlaceId>(state, Section::kPlaces, *node, "finished_in", "the order");
  order.finished_in = place.value_or(PlaceId{});
  if (node->find("done_when") != nullptr) {
    order.done_when = condition_at(state, *node, "done_when", "the order");
    if (order.done_when.always() && state.problems.none()) {
      state.problems.error(node->find("done_when")->mark, "the order: 'done_when' has no condition",
                           "remove it, or write a condition");
    }
  } else if (place) {
    order.done_when = default_goal(*place, state.names.names(Section::kPlaces)[place->index()]);
  }
}

void build_horizon(BuildState& state) {
  const SourceNode* node = state.root.find("horizon");
  if (node == nullptr) return;
  auto& by_order = state.line().horizon.by_order;
  if (node->is_scalar()) {
    const auto ticks = static_cast<Tick>(parse_integer(node->text).value_or(1));
    by_order.emplace_back(kLargestAmount, ticks);
    return;
  }
  if (node->entries.empty()) {
    state.problems.error(node->mark, "'horizon' is empty", "write a number of ticks");
  }
  for (const SourceEntry& entry : node->entries) {
    const auto quantity = parse_integer(entry.key);
    if (!quantity || *quantity < 1 || *quantity > kLargestAmount) {
      state.problems.error(
          entry.mark, fmt::format("'horizon': {} is not an order quantity", in_quotes(entry.key)),
          "write horizon: {5: 2000, 10: 3000}");
      continue;
    }
    by_order.emplace_back(static_cast<std::int32_t>(*quantity), integer_or(*node, entry.key, 1));
  }
  std::sort(by_order.begin(), by_order.end());
}

void build_milestone(BuildState& state, std::int32_t id, const SourceNode& node) {
  struct Kind {
    const char* key;
    Section section;
    Milestone::Event event;
  };
  static constexpr std::array<Kind, 4> kKinds = {
      {{"operation", Section::kOperations, Milestone::Event::kOperationDone},
       {"place", Section::kPlaces, Milestone::Event::kTokenArrives},
       {"task_start", Section::kTasks, Milestone::Event::kTaskStart},
       {"task_end", Section::kTasks, Milestone::Event::kTaskEnd}}};
  const std::string title = state.names.title(Section::kMilestones, id);
  for (const Kind& kind : kKinds) {
    const SourceNode* named = node.find(kind.key);
    if (named == nullptr) continue;
    const auto target = reference(state, kind.section, *named, title);
    if (!target) continue;
    state.line().milestones.push_back(
        {state.names.names(Section::kMilestones)[static_cast<std::size_t>(id)], kind.event,
         *target});
  }
}

std::string line_name(BuildState& state) {
  const SourceNode* name = state.root.find("name");
  if (name == nullptr) return {};
  if (const auto fault = name_fault(name->text)) {
    state.problems.error(name->mark, fmt::format("{} cannot be the name of a line: {}",
                                                 in_quotes(name->text), *fault));
  }
  return name->text;
}

}  // namespace

void build_run(BuildState& state) {
  LineModel& line = state.line();
  line.name = line_name(state);
  line.tick_s = real_or(state.root, "tick_s", 1.0);
  line.allow_wait = boolean_or(state.root, "allow_wait", false);
  build_order(state);
  build_horizon(state);
  state.each(Section::kMilestones,
             [&](std::int32_t id, const SourceNode& node) { build_milestone(state, id, node); });
}

}  // namespace linewright::loading
