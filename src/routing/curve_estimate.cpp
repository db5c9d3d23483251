#include "curve_estimate.hpp"

#include <algorithm>
#include <numbers>

#include "linewright/routing/reeds_shepp.hpp"

namespace linewright {

CurveEstimate::CurveEstimate(double turning_radius_m, double cell_m, int headings)
    : radius_m_(turning_radius_m), headings_(headings) {
  if (!used()) return;
  // Fine enough to tell curves apart; coarser than the map's cells where these are small.
  const double size_m = std::max(cell_m, radius_m_ / 4.0);
  half_ = static_cast<float>(std::ceil(6.0 * radius_m_ / size_m));
  scale_ = static_cast<float>(1.0 / size_m);
  const auto half = static_cast<std::size_t>(half_);
  table_.assign(2 * half * half * static_cast<std::size_t>(headings_), -1.0F);
}

void CurveEstimate::aim(const Pose2& goal, double offset, double step_rad) {
  goal_x_ = static_cast<float>(goal.x_m);
  goal_y_ = static_cast<float>(goal.y_m);
  cos_ = static_cast<float>(std::cos(goal.heading_rad));
  sin_ = static_cast<float>(std::sin(goal.heading_rad));
  const double steps = std::round(goal.heading_rad / step_rad - offset);
  const auto rest = static_cast<int>(std::fmod(steps, headings_));
  goal_steps_ = rest < 0 ? rest + headings_ : rest;
}

float CurveEstimate::fill(std::size_t index) {
  const auto headings = static_cast<std::size_t>(headings_);
  const auto width = static_cast<std::size_t>(2 * half_);
  const std::size_t turn = index % headings;
  const std::size_t along = index / headings % width;
  const std::size_t across = index / headings / width;
  const double size_m = 1.0 / static_cast<double>(scale_);
  const Pose2 from{(static_cast<double>(along) + 0.5 - half_) * size_m,
                   (static_cast<double>(across) + 0.5) * size_m,
                   2.0 * std::numbers::pi * static_cast<double>(turn) / headings_};
  table_[index] = static_cast<float>(reeds_shepp_m(from, {}, radius_m_));
  return table_[index];
}

}  // namespace linewright
