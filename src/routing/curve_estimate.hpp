#pragma once

#include <cmath>
#include <vector>

#include "linewright/base/geometry.hpp"

namespace linewright {

/// Reeds-Shepp lengths to a goal near by, from a table over relative poses that is filled as it is
/// used: the non-holonomic-without-obstacles heuristic of Hybrid A*. Beyond six turning radii it
/// answers 0: there the way around obstacles tells more.
class CurveEstimate {
 public:
  /// Not used when the turning radius is 0.
  CurveEstimate(double turning_radius_m, double cell_m, int headings);

  [[nodiscard]] bool used() const { return radius_m_ > 0.0; }

  /// Sets the goal. Headings of nodes are (step + offset) * step_rad.
  void aim(const Pose2& goal, double offset, double step_rad);

  /// From a node at this place and heading step to the goal.
  [[nodiscard]] float metres(float x_m, float y_m, int heading) {
    const float dx = x_m - goal_x_;
    const float dy = y_m - goal_y_;
    const float along = (cos_ * dx + sin_ * dy) * scale_ + half_;
    float across = (cos_ * dy - sin_ * dx) * scale_;
    int turn = heading - goal_steps_;
    turn += turn < 0 ? headings_ : 0;
    if (across < 0.0F) {  // the same on the other side
      across = -across;
      turn = turn == 0 ? 0 : headings_ - turn;
    }
    if (along < 0.0F || along >= 2.0F * half_ || across >= half_) return 0.0F;
    const auto index = (static_cast<std::size_t>(across) * static_cast<std::size_t>(2 * half_) +
                        static_cast<std::size_t>(along)) *
                           static_cast<std::size_t>(headings_) +
                       static_cast<std::size_t>(turn);
    return table_[index] >= 0.0F ? table_[index] : fill(index);
  }

 private:
  [[nodiscard]] float fill(std::size_t index);

  double radius_m_;
  int headings_;
  float half_ = 0.0F;   ///< cells of the table to each side
  float scale_ = 0.0F;  ///< table cells per metre
  float goal_x_ = 0.0F;
  float goal_y_ = 0.0F;
  float cos_ = 1.0F;
  float sin_ = 0.0F;
  int goal_steps_ = 0;        ///< the goal's heading in steps, 0 ... headings - 1
  std::vector<float> table_;  ///< -1: not known yet
};

}  // namespace linewright
