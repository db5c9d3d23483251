#include "steering.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace linewright {
namespace {

using Kind = PathSegment::Kind;

constexpr double kLook_m = 0.05;
constexpr double kZero = 1e-9;

double normal(double angle) { return std::remainder(angle, 2 * std::numbers::pi); }

void append(ReedsSheppCurve& curve, Kind kind, double amount) {
  if (std::abs(amount) > kZero) curve.pieces[curve.count++] = {kind, amount};
}

}  // namespace

Steering::Steering(const CollisionChecker& checker, const Mover& mover,
                   const PathPlannerOptions& options)
    : checker_(checker),
      radius_m_(mover.turning_radius_m),
      costs_{.reverse = options.reverse_penalty,
             .direction_change_m = options.direction_change_m,
             .arc = 1.0,
             .turn_m_per_rad = options.turn_m_per_rad},
      steering_change_m_(options.steering_change_m),
      ignores_heading_(mover.turning_radius_m <= 0.0 && mover.footprint.is_circle()) {
  if (ignores_heading_) costs_.turn_m_per_rad = 0.0;
}

double Steering::cost_m(std::span<const PathSegment> pieces) const {
  double cost = driving_cost_m(pieces, costs_);
  for (std::size_t i = 1; i < pieces.size(); ++i) {
    if (pieces[i].kind != pieces[i - 1].kind && radius_m_ > 0.0) cost += steering_change_m_;
  }
  return cost;
}

Connection Steering::connect(const Pose2& from, const Pose2& to) const {
  if (radius_m_ <= 0.0) return turn_and_go(from, to);
  Connection made;
  made.curve = cheapest_reeds_shepp(from, to, radius_m_, costs_);
  made.cost_m = cost_m(made.curve.segments());
  return made;
}

Connection Steering::reconnect(const Pose2& from, const Pose2& to, const Connection& like) const {
  if (radius_m_ <= 0.0) return turn_and_go(from, to);
  Connection made;
  made.curve = same_reeds_shepp_word(from, to, radius_m_, like.curve.word);
  made.cost_m = cost_m(made.curve.segments());
  return made;
}

Connection Steering::turn_and_go(const Pose2& from, const Pose2& to) const {
  const double metres = distance_m(from.point(), to.point());
  Connection forwards;
  if (metres <= kZero) {
    append(forwards.curve, Kind::kTurn, normal(to.heading_rad - from.heading_rad));
    forwards.cost_m = cost_m(forwards.curve.segments());
    return forwards;
  }
  const double bearing = std::atan2(to.y_m - from.y_m, to.x_m - from.x_m);
  append(forwards.curve, Kind::kTurn, normal(bearing - from.heading_rad));
  append(forwards.curve, Kind::kStraight, metres);
  append(forwards.curve, Kind::kTurn, normal(to.heading_rad - bearing));
  forwards.cost_m = cost_m(forwards.curve.segments());
  if (ignores_heading_) return forwards;  // a person does not walk backwards
  Connection backwards;
  const double away = bearing + std::numbers::pi;
  append(backwards.curve, Kind::kTurn, normal(away - from.heading_rad));
  append(backwards.curve, Kind::kStraight, -metres);
  append(backwards.curve, Kind::kTurn, normal(to.heading_rad - away));
  backwards.cost_m = cost_m(backwards.curve.segments());
  return backwards.cost_m < forwards.cost_m ? backwards : forwards;
}

bool Steering::free(const Pose2& from, std::span<const PathSegment> pieces) const {
  Pose2 at = from;
  for (const PathSegment& piece : pieces) {
    if (!piece_free(at, piece)) return false;
    at = advanced(at, piece.kind, piece.amount, radius_m_);
  }
  return true;
}

double Steering::look_ahead_m(const Pose2& at) const {
  const ClearanceMap& map = checker_.map();
  const double cell_m = map.frame().cell_m;
  const Cell cell{static_cast<std::int32_t>(std::floor(at.x_m / cell_m)),
                  static_cast<std::int32_t>(std::floor(at.y_m / cell_m))};
  if (!map.frame().contains(cell)) return 0.0;
  // From the cell's middle to blocked ones, less two half diagonals and the footprint itself.
  return (static_cast<double>(map.distance_cells(cell)) - 1.4143) * cell_m -
         checker_.footprint().circumscribed_m();
}

bool Steering::piece_free(const Pose2& from, const PathSegment& piece) const {
  if (piece.kind == Kind::kTurn && ignores_heading_) return true;
  const double size = std::abs(piece.amount);
  const double sign = piece.amount < 0.0 ? -1.0 : 1.0;
  // What counts is how far the farthest corner moves, which on an arc is more than the pose does,
  // and in a turn on the spot all there is.
  const double body_m = checker_.footprint().circumscribed_m();
  double metres = size;
  if (piece.kind == Kind::kTurn) metres = size * body_m;
  if (piece.kind == Kind::kLeft || piece.kind == Kind::kRight) {
    metres = size * (1.0 + body_m / radius_m_);
  }
  double gone = 0.0;
  while (gone < metres) {
    gone = std::min(metres, gone + kLook_m);
    const Pose2 at = advanced(from, piece.kind, sign * size * (gone / metres), radius_m_);
    const double ahead = look_ahead_m(at);
    if (ahead > 0.0) {
      gone += ahead;
    } else if (!checker_.free_exactly(at)) {
      return false;
    }
  }
  return true;
}

}  // namespace linewright
