#include <algorithm>

#include "task_net.hpp"

namespace linewright::bounds {
namespace {

std::size_t at(std::int32_t id) { return static_cast<std::size_t>(id); }

}  // namespace

int TaskNet::most_items(const TransferAction& transfer) const {
  if (transfer.repeat != TransferAction::kUntilBlocked) return transfer.repeat;
  int most = net_.columns;
  const auto limit = [&](CarrierKindId kind) {
    most = std::min(most, net_.line.carrier_kinds[kind.index()].capacity);
  };
  // What is in a carrier of the task when the transfer begins, or fits into it then.
  if (!transfer.source.place) limit(*task_.crew[transfer.source.slot].carrier);
  if (!transfer.destination.place) limit(*task_.crew[transfer.destination.slot].carrier);
  return most;
}

/// The store of one end; none where the material is not known.
std::optional<int> TaskNet::store_of(const TransferAction& transfer, bool source) const {
  const Endpoint& here = source ? transfer.source : transfer.destination;
  const Endpoint& there = source ? transfer.destination : transfer.source;
  if (here.place) return net_.stores.of(*here.place);
  if (!there.place) return std::nullopt;
  return net_.stores.pool(*task_.crew[here.slot].carrier,
                          net_.stores.names.by_place[there.place->index()]);
}

void TaskNet::transfer(std::size_t step, std::size_t sequence, std::size_t a, Event& end) {
  const Action& action = task_.steps[step].sequences[sequence].actions[a];
  const auto& what = std::get<TransferAction>(action.what);
  ActionEvents& events = events_.actions[step][sequence][a];
  events.most = most_items(what);
  Event item{.name = task_.name + " moves an item"};
  item.batches.push_back(
      {.begin = events.begin, .most = events.most, .fixed = action.before, .each = what.takes});
  Flow flow{.least = what.takes, .task = id_, .step = step, .sequence = sequence, .action = a};
  const std::optional<int> source = store_of(what, true);
  const std::optional<int> destination = store_of(what, false);
  if (what.source.place && source) {
    item.arcs.push_back({.from = net_.arrivals[at(*source)], .lag = what.takes});
  } else if (source) {
    from_carrier(what, action, events.begin, item, flow);
  }
  if (what.destination.place) {
    const Place& place = net_.line.places[what.destination.place->index()];
    if (!place.berth && place.capacity) {
      item.arcs.push_back({.from = net_.departures[what.destination.place->index()],
                           .lag = what.takes,
                           .plus = net_.initial(*destination) - *place.capacity});
    }
  }
  events.item = net_.net.add(std::move(item));
  if (source) {
    net_.net[net_.departures[at(*source)]].sources.push_back({events.item, 1});
    flow.takes.emplace_back(*source, 1);
  }
  if (destination) {
    net_.net[net_.arrivals[at(*destination)]].sources.push_back({events.item, 1});
    flow.gives.emplace_back(*destination, 1);
    if (!what.destination.place)
      loadings_.push_back({what.destination.slot, step, sequence, a, *destination});
  } else {  // from carrier to carrier: anything may be in it from now on
    for (int m = 0; m < net_.stores.materials; ++m) {
      const int pool = net_.stores.pool(*task_.crew[what.destination.slot].carrier, m);
      net_.net[net_.arrivals[at(pool)]].initial = net_.columns;
    }
  }
  net_.flows.push_back(std::move(flow));
  end.arcs[0].lag += what.takes * what.repeat;
  if (what.repeat > 0)
    end.arcs.push_back({.from = events.item, .lag = action.after, .times = what.repeat});
}

/// Items that come out of a carrier of the task: were in it at the decision when it stood in a
/// berth; were put in by this execution when it was empty.
void TaskNet::from_carrier(const TransferAction& transfer, const Action& action, int begin,
                           Event& item, Flow& flow) {
  const std::size_t slot = transfer.source.slot;
  const int pool = *store_of(transfer, true);
  const auto loads = std::count_if(loadings_.begin(), loadings_.end(),
                                   [&](const Loading& l) { return l.slot == slot; });
  const CarrierWanted wanted = task_.crew[slot].wanted;
  if (wanted == CarrierWanted::kBerth && loads == 0) {
    const Tick lag =
        longest_lag(net_.net, events_, events_.start, begin).value_or(0) + action.before;
    flow.least = 1 + lag + transfer.takes;
    item.arcs.push_back({.from = net_.arrivals[at(pool)], .lag = flow.least});
    return;
  }
  item.arcs.push_back({.from = net_.arrivals[at(pool)], .lag = transfer.takes});
  if (wanted != CarrierWanted::kEmpty || loads != 1) return;
  const Loading& load = *std::find_if(loadings_.begin(), loadings_.end(),
                                      [&](const Loading& l) { return l.slot == slot; });
  const ActionEvents& loading = events_.actions[load.step][load.sequence][load.action];
  const Action& loads_by = task_.steps[load.step].sequences[load.sequence].actions[load.action];
  const std::optional<Tick> lag = longest_lag(net_.net, events_, loading.end, begin);
  if (!lag) return;
  const Tick each = std::get<TransferAction>(loads_by.what).takes;
  const Tick rest = loads_by.after + *lag + action.before;
  flow.least = rest + transfer.takes;
  item.arcs.push_back({.from = loading.item, .lag = flow.least});
  item.batches.push_back({.begin = loading.begin,
                          .most = std::min(most_items(transfer), loading.most),
                          .fixed = loads_by.before + rest,
                          .each = each + transfer.takes});
}

}  // namespace linewright::bounds
