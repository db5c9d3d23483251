#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "linewright/line/line_model.hpp"
#include "linewright/simulation/run_setup.hpp"

namespace linewright {

/// "H2R2"-like name of a crew: initials and numbers of workers, by kind.
[[nodiscard]] std::string crew_name(const LineModel& line, const std::vector<std::int32_t>& counts);
[[nodiscard]] std::string crew_name(const LineModel& line, const RunSetup& setup);
/// Of a crew whose numbers are all given; throws std::bad_optional_access for another.
[[nodiscard]] std::string crew_name(const LineModel& line, const RunOptions& crew);

/// Every crew that the line allows; the first kind varies slowest.
[[nodiscard]] std::vector<RunOptions> all_crews(const LineModel& line);

}  // namespace linewright
