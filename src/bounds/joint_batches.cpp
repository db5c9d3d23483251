#include <algorithm>

#include "joint_model.hpp"
#include "linewright/line/lower_limits.hpp"
#include "transfers.hpp"

namespace linewright::bounds {
namespace {

std::size_t at(std::int32_t id) { return static_cast<std::size_t>(id); }

/// Adds the transfers of one task that move as much as they can.
class TaskBatches {
 public:
  TaskBatches(JointModel& model, std::size_t task)
      : model_(model),
        net_(model.net()),
        task_(net_.line.tasks[task]),
        events_(net_.tasks[task]),
        loaded_(task_.crew.size(), -1) {}

  void add() {
    // With several executions at once the n-th events need not belong to one execution.
    if (task_.max_running != 1) return;
    for (std::size_t step = 0; step < events_.actions.size(); ++step) {
      for (std::size_t s = 0; s < events_.actions[step].size(); ++s) {
        for (std::size_t a = 0; a < events_.actions[step][s].size(); ++a) {
          const Action& action = task_.steps[step].sequences[s].actions[a];
          const auto* transfer = std::get_if<TransferAction>(&action.what);
          if (transfer == nullptr || transfer->repeat != TransferAction::kUntilBlocked) continue;
          add_transfer(action, *transfer, events_.actions[step][s][a]);
        }
      }
    }
  }

 private:
  void add_transfer(const Action& action, const TransferAction& transfer,
                    const ActionEvents& events) {
    JointRelaxation::Batch batch{.items = model_.nodes_of(events.item),
                                 .decided = model_.nodes_of(events_.start),
                                 .begins = model_.nodes_of(events.begin),
                                 .ends = model_.nodes_of(events.end),
                                 .most = events.most,
                                 .before = action.before,
                                 .takes = transfer.takes,
                                 .after = action.after};
    // The last column stands for all that follow.
    if (static_cast<int>(batch.items.size()) >= model_.columns()) return;
    if (transfer.source.place) {
      const bool loaded = !transfer.destination.place && loaded_[transfer.destination.slot] != -1;
      batch.full = !loaded && supply_loaded(net_, task_, transfer, events.item);
      batch.some = batch.full && asks_for_one(*transfer.source.place);
    } else {
      from_carrier(transfer, events.item, batch);
    }
    if (transfer.destination.place) {
      empties(*transfer.destination.place, events.item, batch);
    } else {
      loaded_[transfer.destination.slot] = loaded_[transfer.destination.slot] == -1
                                               ? static_cast<int>(model_.made.batches.size())
                                               : kSeveral;
    }
    model_.made.batches.push_back(std::move(batch));
  }

  /// The task is chosen only while something lies there.
  [[nodiscard]] bool asks_for_one(PlaceId place) const {
    const std::vector<LowerLimit> limits = lower_limits(task_.when, net_.setup.order);
    return std::any_of(limits.begin(), limits.end(), [&](const LowerLimit& limit) {
      return limit.variable.index == place.value &&
             (limit.variable.kind == VariableKind::kPlaceCount ||
              limit.variable.kind == VariableKind::kPlaceAvailable);
    });
  }

  void from_carrier(const TransferAction& transfer, int item, JointRelaxation::Batch& batch) const {
    const std::size_t slot = transfer.source.slot;
    const CarrierWanted wanted = task_.crew[slot].wanted;
    if (wanted == CarrierWanted::kEmpty && loaded_[slot] >= 0) {
      batch.loaded_by = loaded_[slot];
    } else if (wanted == CarrierWanted::kBerth && loaded_[slot] == -1) {
      const auto pool = pool_of(item);
      if (!pool) return;
      const bool blocked = !transfer.destination.place ||
                           net_.line.places[transfer.destination.place->index()].capacity;
      batch.some = !blocked && asks_for_one(task_.crew[slot].berth);
      for (std::size_t k = 0; k < batch.items.size(); ++k)
        batch.before_decision.push_back(
            model_.node(net_.arrivals[at(*pool)], static_cast<int>(k) + 1));
    }
  }

  /// The store from which the item comes.
  [[nodiscard]] std::optional<int> pool_of(int item) const {
    for (const Flow& flow : net_.flows) {
      if (!flow.task || flow.takes.size() != 1) continue;
      const auto& actions = net_.tasks[flow.task->index()].actions;
      if (actions[flow.step][flow.sequence][flow.action].item == item) return flow.takes[0].first;
    }
    return std::nullopt;
  }

  /// The task is chosen only while no more than so many tokens lie in the place that it alone
  /// fills.
  void empties(PlaceId place, int item, JointRelaxation::Batch& batch) const {
    const auto most = most_when_chosen(net_, task_, place, item);
    if (!most) return;
    for (std::size_t k = 0; k < batch.items.size(); ++k) {
      const int leaves = static_cast<int>(k) + 1 + net_.initial(place.value) - *most;
      batch.before_next_decision.push_back(model_.node(net_.departures[place.index()], leaves));
    }
  }

  static constexpr int kSeveral = -2;

  JointModel& model_;
  const LineNet& net_;
  const Task& task_;
  const TaskEvents& events_;
  std::vector<int> loaded_;  ///< by crew slot: the batch that loads this carrier; -1: none
};

}  // namespace

void add_batches(JointModel& model) {
  for (std::size_t t = 0; t < model.net().line.tasks.size(); ++t) TaskBatches(model, t).add();
}

}  // namespace linewright::bounds
