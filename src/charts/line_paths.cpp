#include "line_paths.hpp"

#include <algorithm>
#include <cmath>

namespace linewright::charts {
namespace {

constexpr double kColumn = 0.5;

/// Adds what shows of the points [begin, end), which stand in one column.
void add_column(const Run& run, std::size_t begin, std::size_t end, Run& result) {
  const auto first = run.begin() + static_cast<std::ptrdiff_t>(begin);
  const auto past = run.begin() + static_cast<std::ptrdiff_t>(end);
  const auto [low, high] =
      std::minmax_element(first, past, [](Point a, Point b) { return a.y < b.y; });
  std::vector<std::ptrdiff_t> kept = {0, low - first, high - first, past - first - 1};
  std::sort(kept.begin(), kept.end());
  kept.erase(std::unique(kept.begin(), kept.end()), kept.end());
  for (const std::ptrdiff_t i : kept) result.push_back(first[i]);
}

}  // namespace

Run thinned(const Run& run) {
  Run result;
  for (std::size_t begin = 0; begin < run.size();) {
    const double column = std::floor(run[begin].x / kColumn);
    std::size_t end = begin + 1;
    while (end < run.size() && std::floor(run[end].x / kColumn) == column) ++end;
    add_column(run, begin, end, result);
    begin = end;
  }
  return result;
}

std::string path_of(const Run& run) {
  std::string path;
  for (const Point p : run) path += (path.empty() ? "M" : "L") + pair(p);
  return path;
}

void add_boxes(const Run& run, std::vector<Box>& boxes) {
  constexpr double kHalf = 2.5;
  constexpr double kLongest = 6.0;
  constexpr double kMostParts = 300.0;  // no chart is higher than what so many parts cover well
  for (std::size_t i = 0; i < run.size(); ++i) {
    const Point from = run[i == 0 ? 0 : i - 1];
    const Point to = run[i];
    const double length = std::hypot(to.x - from.x, to.y - from.y);
    const double parts = std::clamp(std::ceil(length / kLongest), 1.0, kMostParts);
    for (double part = 1.0; part <= parts; part += 1.0) {
      const double share = part / parts;
      const Point p{from.x + (to.x - from.x) * share, from.y + (to.y - from.y) * share};
      boxes.push_back({p.x - kHalf, p.y - kHalf, p.x + kHalf, p.y + kHalf});
    }
  }
}

}  // namespace linewright::charts
