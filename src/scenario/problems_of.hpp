#pragma once

#include <functional>
#include <string>

#include "linewright/scenario/problems.hpp"

namespace linewright::loading {

/// For tests: everything that `action` reports, as the user would see it; empty when nothing.
inline std::string problems_of(const std::function<void(Problems&)>& action) {
  Problems problems;
  try {
    action(problems);
    problems.throw_if_any();
  } catch (const ScenarioError& e) {
    return e.what();
  }
  return {};
}

}  // namespace linewright::loading
