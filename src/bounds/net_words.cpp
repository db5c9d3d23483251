#include "net_words.hpp"

#include <algorithm>

namespace linewright::bounds {

const MachineUse* find(const std::vector<MachineUse>& uses, MachineId machine) {
  const auto found = std::find_if(uses.begin(), uses.end(),
                                  [&](const MachineUse& use) { return use.machine == machine; });
  return found == uses.end() ? nullptr : &*found;
}

int tokens_in(const std::vector<std::pair<int, int>>& flows, int store) {
  int tokens = 0;
  for (const auto& flow : flows) tokens += flow.first == store ? flow.second : 0;
  return tokens;
}

}  // namespace linewright::bounds
