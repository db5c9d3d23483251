#include "couplings.hpp"

#include <algorithm>

#include "net_words.hpp"

namespace linewright::bounds {
namespace {

/// Stores that hold a token exactly while the machine is held between two operations: what claims
/// it puts one into one of them, what frees it takes one out, nothing else touches them. Empty:
/// there are no such stores.
std::vector<int> holding_stores(const LineNet& net, MachineId machine) {
  std::vector<int> stores;
  for (int store = 0; store < net.stores.first_pool; ++store) {
    if (net.initial(store) > 0) continue;
    bool claimed = false;
    const bool right = std::all_of(net.flows.begin(), net.flows.end(), [&](const Flow& flow) {
      const int given = tokens_in(flow.gives, store);
      const int taken = tokens_in(flow.takes, store);
      if (given == 0 && taken == 0) return true;
      if (!flow.operation) return false;
      const Operation& operation = net.line.operations[flow.operation->index()];
      claimed = claimed || given > 0;
      return given == (find(operation.claims, machine) != nullptr && given > 0 ? 1 : 0) &&
             taken == (find(operation.frees, machine) != nullptr && taken > 0 ? 1 : 0);
    });
    if (right && claimed) stores.push_back(store);
  }
  // Each claim in exactly one of them, each freeing out of exactly one.
  for (const Flow& flow : net.flows) {
    if (!flow.operation) continue;
    const Operation& operation = net.line.operations[flow.operation->index()];
    int given = 0;
    int taken = 0;
    for (const int store : stores) {
      given += tokens_in(flow.gives, store);
      taken += tokens_in(flow.takes, store);
    }
    if (given != (find(operation.claims, machine) != nullptr ? 1 : 0) ||
        taken != (find(operation.frees, machine) != nullptr ? 1 : 0)) {
      return {};
    }
  }
  return stores;
}

std::int32_t position_after(const MachineUse& use) {
  return use.to ? *use.to : use.from ? *use.from : -1;
}

/// A machine that `o` has at its end comes to rest: at once, or when what it claimed it for frees
/// it.
std::vector<Rest> rests_after(const LineNet& net, std::size_t o, MachineId machine,
                              const std::vector<int>& stores) {
  const Operation& first = net.line.operations[o];
  for (const auto* left : {&first.uses, &first.frees}) {
    if (const MachineUse* use = find(*left, machine))
      return {{position_after(*use), 0, first.recovery}};
  }
  std::vector<Rest> rests;
  for (const Flow& flow : net.flows) {
    if (!flow.operation) continue;
    const bool next = std::any_of(stores.begin(), stores.end(), [&](int store) {
      return tokens_in(flow.takes, store) > 0 && tokens_in(net.flows[o].gives, store) > 0;
    });
    if (!next) continue;
    const Operation& operation = net.line.operations[flow.operation->index()];
    rests.push_back(
        {position_after(*find(operation.frees, machine)), flow.least, operation.recovery});
  }
  return rests;
}

}  // namespace

std::vector<MachineJob> jobs_of(const LineNet& net, MachineId machine) {
  std::vector<MachineJob> jobs;
  const std::vector<int> stores = holding_stores(net, machine);
  for (std::size_t o = 0; o < net.line.operations.size(); ++o) {
    const Operation& operation = net.line.operations[o];
    const MachineUse* claim = find(operation.claims, machine);
    const MachineUse* use = claim != nullptr ? claim : find(operation.uses, machine);
    if (use == nullptr) continue;
    if (claim != nullptr && stores.empty()) return {};
    jobs.push_back({.operation = o,
                    .from = use->from.value_or(-1),
                    .work = operation.takes,
                    .rests = rests_after(net, o, machine, stores)});
  }
  return jobs;
}

Tick setup_between(const LineNet& net, MachineId machine, const std::vector<MachineJob>& jobs,
                   const Rest& rest, std::int32_t target) {
  const Machine& moves = net.line.machines[machine.index()];
  const auto direct = [&](const Rest& from) {
    if (target < 0 || from.position < 0) return from.recovery;
    return least_setup(moves, from.position, target, from.recovery);
  };
  Tick best = direct(rest);
  for (const MachineJob& job : jobs) {  // another job on the way may leave it in a better place
    const Tick least = net.flows[job.operation].least;
    for (const Rest& after : job.rests)
      best = std::min(best, rest.recovery + least + after.ticks + direct(after));
  }
  return best;
}

namespace {

/// What takes `machine` and `other` has to wait until what freed `machine` has let `other` go, too,
/// and until that has come from there.
void couple(LineNet& net, MachineId machine, MachineId other) {
  const std::vector<MachineJob> jobs = jobs_of(net, other);
  if (jobs.empty()) return;
  std::vector<std::size_t> freeing;
  for (std::size_t o = 0; o < net.line.operations.size(); ++o) {
    const Operation& operation = net.line.operations[o];
    if (find(operation.frees, machine) == nullptr && find(operation.uses, machine) == nullptr)
      continue;
    const bool claims = find(operation.claims, other) != nullptr;
    if (!claims) return;
    freeing.push_back(o);
  }
  for (const MachineJob& job : jobs) {
    const Operation& operation = net.line.operations[job.operation];
    if (find(operation.claims, machine) == nullptr && find(operation.uses, machine) == nullptr)
      continue;
    const int free = net.net.add({.name = operation.name + " may start", .counts = true});
    const int there = net.net.add({.name = operation.name + " may begin", .counts = true});
    for (const std::size_t f : freeing) {
      const auto freed = std::find_if(jobs.begin(), jobs.end(),
                                      [&](const MachineJob& j) { return j.operation == f; });
      Tick held = kNever;
      Tick ready = kNever;
      for (const Rest& rest : freed->rests) {
        held = std::min(held, rest.ticks + rest.recovery);
        ready = std::min(ready, rest.ticks + setup_between(net, other, jobs, rest, job.from));
      }
      for (const auto& [event, lag] : {std::pair(free, held), std::pair(there, ready)}) {
        const int after = net.net.add({.name = operation.name + " after"});
        net.net[after].arcs.push_back({.from = net.ends[f], .lag = lag});
        net.net[event].sources.push_back({after, 1});
      }
    }
    net.net[net.starts[job.operation]].arcs.push_back({.from = free, .plus = -1});
    net.net[net.ends[job.operation]].arcs.push_back(
        {.from = there, .lag = operation.takes, .plus = -1});
  }
}

}  // namespace

void add_couplings(LineNet& net) {
  for (std::size_t m = 0; m < net.line.machines.size(); ++m) {
    for (std::size_t g = 0; g < net.line.machines.size(); ++g) {
      if (m != g) couple(net, MachineId(m), MachineId(g));
    }
  }
}

}  // namespace linewright::bounds
