#include <algorithm>

#include "joint_model.hpp"
#include "net_words.hpp"

namespace linewright::bounds {
namespace {

/// The stays of one machine.
class MachineStays {
 public:
  MachineStays(JointModel& model, MachineId machine)
      : model_(model), net_(model.net()), machine_(machine) {}

  void add() {
    for (std::size_t o = 0; o < net_.line.operations.size(); ++o) {
      const Operation& operation = net_.line.operations[o];
      if (const MachineUse* use = find(operation.uses, machine_)) {
        add_stays(o, o, *use, *use);
      } else if (const MachineUse* claim = find(operation.claims, machine_)) {
        if (const auto freer = freer_of(o)) {
          add_stays(o, *freer, *claim, *find(net_.line.operations[*freer].frees, machine_));
        } else {
          add_holds(o, *claim);
        }
      }
    }
    if (resource_.jobs.empty()) return;
    resource_.name = net_.line.machines[machine_.index()].name;
    add_idle();
    resource_.instants =
        instants_asking(model_, {VariableKind::kMachineFree, machine_.value}, false);
    const bool all_known =
        std::none_of(resource_.jobs.begin(), resource_.jobs.end(),
                     [](const auto& job) { return job.free == JointRelaxation::kAlways; });
    if (all_known && !net_.line.machines[machine_.index()].travel.empty()) add_travel();
    model_.made.resources.push_back(std::move(resource_));
  }

 private:
  struct Type {
    std::int32_t from = -1;   ///< position to which it travels first
    Tick work = 0;            ///< of the operation, without travel
    std::int32_t rests = -1;  ///< position in which it is left
    Tick recovery = 0;
  };

  void add_stays(std::size_t takes, std::size_t frees, const MachineUse& first,
                 const MachineUse& last) {
    const int type = static_cast<int>(types_.size());
    const Operation& freeing = net_.line.operations[frees];
    types_.push_back({.from = first.from.value_or(-1),
                      .work = net_.line.operations[takes].takes,
                      .rests = last.to     ? *last.to
                               : last.from ? *last.from
                                           : -1,
                      .recovery = freeing.recovery});
    resource_.recovery.push_back(freeing.recovery);
    const std::vector<int> starts = model_.nodes_of(net_.starts[takes]);
    for (std::size_t n = 0; n < starts.size(); ++n) {
      const int number = static_cast<int>(n) + 1;
      resource_.jobs.push_back({.take = starts[n],
                                .begin = starts[n],
                                .anchor = model_.node(net_.ends[takes], number),
                                .free = model_.node(net_.ends[frees], number),
                                .hold = net_.flows[takes].least,
                                .type = type,
                                .number = static_cast<int>(n)});
    }
  }

  /// Where it is not known which firing lets it go: at least as long as the way of the tokens from
  /// any claim to any freeing.
  void add_holds(std::size_t takes, const MachineUse& first) {
    const int type = static_cast<int>(types_.size());
    types_.push_back({.from = first.from.value_or(-1), .work = net_.line.operations[takes].takes});
    resource_.recovery.push_back(0);
    const std::vector<int> starts = model_.nodes_of(net_.starts[takes]);
    for (std::size_t n = 0; n < starts.size(); ++n) {
      resource_.jobs.push_back({.take = starts[n],
                                .begin = starts[n],
                                .anchor = model_.node(net_.ends[takes], static_cast<int>(n) + 1),
                                .free = JointRelaxation::kAlways,
                                .hold = least_hold(),
                                .type = type,
                                .number = static_cast<int>(n)});
    }
  }

  [[nodiscard]] Tick least_hold() const {
    constexpr Tick kLate = kMaxTicks;
    std::vector<Fix> fixes;
    for (std::size_t o = 0; o < net_.line.operations.size(); ++o) {
      if (find(net_.line.operations[o].claims, machine_) != nullptr)
        fixes.push_back({.event = net_.starts[o], .first = 1, .tick = kLate});
    }
    const Times late = net_.net.solve(model_.times(), fixes);
    Tick least = kNever;
    for (std::size_t o = 0; o < net_.line.operations.size(); ++o) {
      if (find(net_.line.operations[o].frees, machine_) != nullptr)
        least = std::min(least, late.at(net_.freed[o], 1));
    }
    return least >= kNever || least < kLate ? 0 : least - kLate;
  }

  /// The operation whose n-th firing lets go what the n-th firing of `claimer` took: the only pair
  /// of the machine, or they hand a token over that nobody else touches.
  [[nodiscard]] std::optional<std::size_t> freer_of(std::size_t claimer) const {
    std::vector<std::size_t> freers;
    int claimers = 0;
    for (std::size_t o = 0; o < net_.line.operations.size(); ++o) {
      if (find(net_.line.operations[o].frees, machine_) != nullptr) freers.push_back(o);
      claimers += find(net_.line.operations[o].claims, machine_) != nullptr ? 1 : 0;
    }
    if (claimers == 1 && freers.size() == 1) return freers[0];
    for (const std::size_t freer : freers) {
      for (int store = 0; store < net_.stores.first_pool; ++store) {
        if (hands_over(claimer, freer, store)) return freer;
      }
    }
    return std::nullopt;
  }

  [[nodiscard]] bool hands_over(std::size_t claimer, std::size_t freer, int store) const {
    if (net_.initial(store) > 0) return false;
    for (std::size_t f = 0; f < net_.flows.size(); ++f) {
      const Flow& flow = net_.flows[f];
      const bool gives = flow.operation && flow.operation->index() == claimer;
      const bool takes = flow.operation && flow.operation->index() == freer;
      if (tokens_in(flow.gives, store) != (gives ? 1 : 0)) return false;
      if (tokens_in(flow.takes, store) != (takes ? 1 : 0)) return false;
    }
    return true;
  }

  /// Who asks that the machine does not work may start while it recovers.
  void add_idle() {
    JointRelaxation::Resource idle{
        .name = resource_.name + " works",
        .jobs = resource_.jobs,
        .recovery = std::vector<Tick>(types_.size(), 0),
        .instants = instants_asking(model_, {VariableKind::kMachineWorking, machine_.value}, true),
        .exclusive = false};
    if (!idle.instants.empty()) model_.made.resources.push_back(std::move(idle));
  }

  void add_travel() {
    const Machine& machine = net_.line.machines[machine_.index()];
    for (const Type& before : types_) {
      auto& row = resource_.lag.emplace_back();
      auto& ways = resource_.way.emplace_back();
      resource_.work.push_back({});
      for (const Type& next : types_) {
        const bool known = before.rests >= 0 && next.from >= 0;
        row.push_back(next.work +
                      (known ? least_setup(machine, before.rests, next.from, before.recovery)
                             : before.recovery));
        ways.push_back(next.work +
                       (known ? least_way(machine, before.rests, next.from, before.recovery) : 0));
      }
    }
  }

  /// The least travel to the target, however long it has rested.
  static Tick least_way(const Machine& machine, std::int32_t from, std::int32_t target,
                        Tick recovery) {
    const Tick homed = machine.homing
                           ? std::max(0, machine.homing->takes[static_cast<std::size_t>(from)]) +
                                 machine.homing->holds
                           : 0;
    Tick least = machine_travel(machine, from, target, recovery);
    for (Tick waited = recovery; waited <= homed; ++waited)
      least = std::min(least, machine_travel(machine, from, target, waited));
    return least;
  }

  JointModel& model_;
  const LineNet& net_;
  MachineId machine_;
  std::vector<Type> types_;
  JointRelaxation::Resource resource_;
};

}  // namespace

void add_machines(JointModel& model) {
  for (std::size_t m = 0; m < model.net().line.machines.size(); ++m)
    MachineStays(model, MachineId(m)).add();
}

}  // namespace linewright::bounds
