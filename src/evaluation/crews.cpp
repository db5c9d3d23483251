#include "linewright/evaluation/crews.hpp"

#include <cctype>

namespace linewright {

std::string crew_name(const LineModel& line, const std::vector<std::int32_t>& counts) {
  std::string name;
  for (std::size_t k = 0; k < counts.size(); ++k) {
    const auto initial = static_cast<unsigned char>(line.worker_kinds[k].name[0]);
    name += static_cast<char>(std::toupper(initial));
    name += std::to_string(counts[k]);
  }
  return name;
}

std::string crew_name(const LineModel& line, const RunSetup& setup) {
  std::vector<std::int32_t> counts;
  for (const auto& starts : setup.worker_start) {
    counts.push_back(static_cast<std::int32_t>(starts.size()));
  }
  return crew_name(line, counts);
}

std::string crew_name(const LineModel& line, const RunOptions& crew) {
  std::vector<std::int32_t> counts;
  for (const auto& count : crew.workers) counts.push_back(count.value());
  return crew_name(line, counts);
}

std::vector<RunOptions> all_crews(const LineModel& line) {
  std::vector<RunOptions> crews(1);
  for (const WorkerKind& kind : line.worker_kinds) {
    std::vector<RunOptions> more;
    for (const RunOptions& crew : crews) {
      for (std::int32_t count = kind.count.min; count <= kind.count.max; ++count) {
        more.push_back(crew);
        more.back().workers.emplace_back(count);
      }
    }
    crews = std::move(more);
  }
  return crews;
}

}  // namespace linewright
