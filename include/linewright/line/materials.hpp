#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "linewright/line/line_model.hpp"

namespace linewright {

/// The kinds of material of a line, numbered in the order in which its places name them (a place
/// without `of` holds a material of its own name). CarrierState::material is such a number.
struct Materials {
  std::vector<std::string> names;
  std::vector<std::int16_t> by_place;
};

[[nodiscard]] Materials materials_of(const LineModel& line);

}  // namespace linewright
