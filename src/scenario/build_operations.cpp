#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "build_state.hpp"
#include "linewright/scenario/values.hpp"
#include "positions.hpp"

namespace linewright::loading {
namespace {

/// Reads one operation. Its lists mention machines and places at most once each.
class OperationBuilder {
 public:
  OperationBuilder(BuildState& state, std::int32_t id, const SourceNode& node)
      : state_(state), node_(node), title_(state.names.title(Section::kOperations, id)) {
    operation_.name = state.names.names(Section::kOperations)[static_cast<std::size_t>(id)];
  }

  Operation build() {
    operation_.takes = integer_or(node_, "takes", 0);
    operation_.recovery = integer_or(node_, "recovery", 0);
    operation_.uses = machine_uses("uses");
    operation_.claims = machine_uses("claims");
    operation_.frees = machine_uses("frees");
    operation_.consumes = token_flows("consumes");
    operation_.produces = token_flows("produces");
    operation_.when = condition_at(state_, node_, "when", title_);
    operation_.operated_by =
        reference_at<WorkerKindId>(state_, Section::kWorkers, node_, "operated_by", title_);
    return std::move(operation_);
  }

 private:
  std::vector<MachineUse> machine_uses(const char* key) {
    std::vector<MachineUse> uses;
    const SourceNode* list = node_.find(key);
    if (list == nullptr) return uses;
    for (const SourceNode& item : list->items) {
      if (item.is_scalar()) add_use(uses, item.text, item.mark, nullptr);
      for (const SourceEntry& entry : item.entries)
        add_use(uses, entry.key, entry.mark, &entry.value);
    }
    return uses;
  }

  void add_use(std::vector<MachineUse>& uses, const std::string& name, SourceMark mark,
               const SourceNode* move) {
    const auto id = reference(state_, Section::kMachines, name, mark, title_);
    if (!id) return;
    if (std::find(machines_.begin(), machines_.end(), *id) != machines_.end()) {
      state_.problems.error(mark,
                            fmt::format("{}: machine {} is listed twice", title_, in_quotes(name)),
                            "name a machine in one of uses, claims and frees");
      return;
    }
    machines_.push_back(*id);
    MachineUse use{MachineId(*id), std::nullopt, std::nullopt};
    if (move != nullptr) {
      use.from = position_at(*move, "from", *id);
      use.to = position_at(*move, "to", *id);
    }
    uses.push_back(use);
  }

  std::optional<std::int32_t> position_at(const SourceNode& move, const char* key,
                                          std::int32_t machine) {
    const SourceNode* node = move.find(key);
    if (node == nullptr) return std::nullopt;
    return position(state_, state_.line().machines[static_cast<std::size_t>(machine)], node->text,
                    node->mark, title_);
  }

  std::vector<TokenFlow> token_flows(const char* key) {
    std::vector<TokenFlow> flows;
    const SourceNode* node = node_.find(key);
    if (node == nullptr) return flows;
    add_counted(flows, *node);
    for (const SourceNode& item : node->items) {
      if (item.is_scalar()) add_flow(flows, item.text, item.mark, 1);
      add_counted(flows, item);
    }
    return flows;
  }

  void add_counted(std::vector<TokenFlow>& flows, const SourceNode& mapping) {
    for (const SourceEntry& entry : mapping.entries) {
      if (entry.value.is_broken()) continue;
      add_flow(flows, entry.key, entry.mark, integer_or(mapping, entry.key, 1));
    }
  }

  void add_flow(std::vector<TokenFlow>& flows, const std::string& name, SourceMark mark,
                std::int32_t count) {
    const auto id = reference(state_, Section::kPlaces, name, mark, title_);
    if (!id) return;
    const bool twice = std::any_of(flows.begin(), flows.end(), [&](const TokenFlow& flow) {
      return flow.place == PlaceId(*id);
    });
    if (twice) {
      state_.problems.error(mark,
                            fmt::format("{}: place {} is listed twice", title_, in_quotes(name)),
                            fmt::format("write {{{}: 2}} for two tokens", name));
      return;
    }
    flows.push_back({PlaceId(*id), count});
  }

  BuildState& state_;
  const SourceNode& node_;
  std::string title_;
  Operation operation_;
  std::vector<std::int32_t> machines_;
};

}  // namespace

void build_operations(BuildState& state) {
  state.each(Section::kOperations, [&](std::int32_t id, const SourceNode& node) {
    state.line().operations.push_back(OperationBuilder(state, id, node).build());
  });
}

}  // namespace linewright::loading
