#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "linewright/experiments/figures.hpp"

namespace linewright::experiments {

/// The styles of the rows of one picture: those of the book, but no two alike while there are
/// enough.
[[nodiscard]] std::vector<std::size_t> styles_for(const std::vector<std::string>& rows,
                                                  const RowStyles& book);

}  // namespace linewright::experiments
