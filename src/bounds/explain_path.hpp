#pragma once

#include <string>

#include "line_net.hpp"

namespace linewright::bounds {

/// The chain of events that makes the end of the run no earlier, in words: "feed 1 ends at 57,
/// ...".
[[nodiscard]] std::string path_text(const LineNet& net, const Times& times);

}  // namespace linewright::bounds
