#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "linewright/base/random.hpp"
#include "linewright/routing/reeds_shepp.hpp"
#include "ompl_planners.hpp"
#include "report.hpp"
#include "sections.hpp"

namespace linewright::bench {
namespace {

std::vector<Query> random_pairs(std::size_t count) {
  RandomStream random(7);
  const auto pose = [&] {
    return Pose2{10.0 * (2 * random.uniform() - 1), 10.0 * (2 * random.uniform() - 1),
                 std::numbers::pi * (2 * random.uniform() - 1)};
  };
  std::vector<Query> pairs;
  for (std::size_t i = 0; i < count; ++i) {
    const Pose2 from = pose();
    pairs.push_back({from, pose()});
  }
  return pairs;
}

}  // namespace

void compare_curves(bool) {
  print_title("Reeds-Shepp curves",
              "A million random pairs of poses in 20 m x 20 m, turning radius 0.8 m.");
  const std::vector<Query> pairs = random_pairs(1'000'000);
  const double per_call = 1e9 / static_cast<double>(pairs.size());
  std::vector<double> own(pairs.size());
  double start = cpu_s();
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    own[i] = reeds_shepp_m(pairs[i].start, pairs[i].goal, 0.8);
  }
  const double length_ns = (cpu_s() - start) * per_call;
  double sum = 0.0;
  start = cpu_s();
  for (const Query& pair : pairs) sum += reeds_shepp(pair.start, pair.goal, 0.8).metres();
  const double curve_ns = (cpu_s() - start) * per_call;
  std::vector<std::vector<std::string>> rows{
      {"", "ns per call"},
      {"length", fmt::format("{:.0f}", length_ns)},
      {fmt::format("curve (sum of lengths {:.3f} km)", sum / 1e3),
       fmt::format("{:.0f}", curve_ns)}};
  std::vector<double> theirs;
  start = cpu_s();
  if (ompl_lengths_m(pairs, 0.8, theirs)) {
    rows.push_back({"OMPL's length", fmt::format("{:.0f}", (cpu_s() - start) * per_call)});
    double most = 0.0;
    for (std::size_t i = 0; i < own.size(); ++i) {
      most = std::max(most, std::abs(own[i] - theirs[i]) / std::max(1.0, own[i]));
    }
    rows.push_back({"largest relative difference", fmt::format("{:.1e}", most)});
  } else {
    rows.push_back({"OMPL is not installed", ""});
  }
  print_table(rows);
}

}  // namespace linewright::bench
