#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "build_state.hpp"

namespace linewright::loading {

/// The index of the machine's position `name`; reports when it has none of that name.
[[nodiscard]] std::optional<std::int32_t> position(BuildState& state, const Machine& machine,
                                                   const std::string& name, SourceMark mark,
                                                   const std::string& title);

}  // namespace linewright::loading
