#include "moves.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "linewright/map/row_spans.hpp"

namespace linewright {
namespace {

using Kind = PathSegment::Kind;

constexpr double kPi = std::numbers::pi;

constexpr int kCorners = 16;

/// A regular polygon with its corners at this distance.
Polygon round(const Pose2& pose, double radius_m) {
  Polygon corners;
  for (int i = 0; i < kCorners; ++i) {
    const double angle = 2 * kPi * i / kCorners;
    corners.push_back(
        {pose.x_m + radius_m * std::cos(angle), pose.y_m + radius_m * std::sin(angle)});
  }
  return corners;
}

/// Corners of the footprint at a pose; a disc as a polygon around it.
Polygon outline(const Footprint& footprint, const Pose2& pose) {
  if (!footprint.is_circle()) return footprint.at(pose);
  return round(pose, footprint.circumscribed_m() / std::cos(kPi / kCorners));
}

/// Corners of a part of the footprint from which all of its edge is `margin_m` away; empty when
/// nothing is certain.
Polygon inline_of(const Footprint& footprint, const Pose2& pose, double margin_m) {
  if (margin_m > footprint.inscribed_m() / 2.0 || !footprint.is_convex()) return {};
  if (footprint.is_circle()) return round(pose, footprint.circumscribed_m() - margin_m);
  return footprint.grown(-margin_m).at(pose);
}

/// Ors the cells of an area into rows of bits.
void mark(const Polygon& area, std::int32_t first_row, std::int32_t first_column,
          std::uint64_t* rows) {
  RowSpans spans(area, true);
  for (std::int32_t row = spans.first_row(); row <= spans.last_row(); ++row) {
    spans.any_in_row(row, [&](ColumnSpan span) {
      const int count = span.last - span.first + 1;
      rows[row - first_row] |= (~std::uint64_t{0} >> (64 - count)) << (span.first - first_column);
      return false;
    });
  }
}

}  // namespace

MoveTable::MoveTable(const CollisionChecker& checker, const Mover& mover,
                     const PathPlannerOptions& options)
    : checker_(checker),
      radius_m_(mover.turning_radius_m),
      cell_m_(checker.map().frame().cell_m),
      ignores_heading_(radius_m_ <= 0.0 && mover.footprint.is_circle()),
      headings_(ignores_heading_ ? 1 : options.headings),
      step_rad_(2 * kPi / headings_),
      lattice_(headings_) {
  if (ignores_heading_) {
    add_walk_moves();
  } else if (radius_m_ > 0.0) {
    add_car_moves(options);
  } else {
    add_drive_moves(options);
  }
  table_.resize(static_cast<std::size_t>(headings_) * kQuarters * moves_.size() * kQuarters *
                kQuarters);
}

int MoveTable::quarter_of(double offset) {
  return std::clamp(static_cast<int>(std::floor((offset + 0.5) * kQuarters)), 0, kQuarters - 1);
}

void MoveTable::add(PathSegment piece, int turn, double cost_m, double cost_back_m) {
  lattice_ = std::gcd(lattice_, turn);
  const Pose2 end = advanced({}, piece.kind, piece.amount, radius_m_);
  moves_.push_back({piece, turn, static_cast<float>(cost_m), static_cast<float>(cost_back_m),
                    static_cast<float>(end.x_m), static_cast<float>(end.y_m)});
  const double metres = piece.kind == Kind::kTurn
                            ? std::abs(piece.amount) * checker_.footprint().circumscribed_m()
                            : std::abs(piece.amount);
  // The body swings out when it turns, but by no more than it turns.
  const double swing = std::abs(turn) * step_rad_ * checker_.footprint().circumscribed_m();
  reach_cells_ = std::max(reach_cells_, static_cast<float>((metres + swing) / cell_m_));
}

/// Heading steps that an arc turns: a divisor of all, so that a search has to do with few headings,
/// and about half as much as leads out of the cell in any direction.
int MoveTable::arc_turn() const {
  // Another heading is another node even in the same cell. Arcs twice as long take half the time
  // and miss a quarter of the ways through narrow aisles; shorter ones find hardly more.
  const double least_m = 0.5 * 1.4143 * cell_m_;
  int turn = 1;
  while (turn < headings_ / 4 &&
         (headings_ % turn != 0 || 2.0 * radius_m_ * std::sin(turn * step_rad_ / 2.0) < least_m)) {
    ++turn;
  }
  return turn;
}

void MoveTable::add_car_moves(const PathPlannerOptions& options) {
  const int turn = arc_turn();
  const double arc = radius_m_ * turn * step_rad_;
  const double straight = std::max(arc, 1.4143 * cell_m_);
  for (const double sign : {1.0, -1.0}) {
    const double factor = sign > 0.0 ? 1.0 : options.reverse_penalty;
    const double back = sign > 0.0 ? options.reverse_penalty : 1.0;
    const int direction = sign > 0.0 ? turn : -turn;
    add({Kind::kStraight, sign * straight}, 0, straight * factor, straight * back);
    add({Kind::kLeft, sign * arc}, direction, arc * factor, arc * back);
    add({Kind::kRight, sign * arc}, -direction, arc * factor, arc * back);
  }
}

void MoveTable::add_drive_moves(const PathPlannerOptions& options) {
  const double straight = 1.4143 * cell_m_;
  const double dear = straight * options.reverse_penalty;
  add({Kind::kStraight, straight}, 0, straight, dear);
  add({Kind::kStraight, -straight}, 0, dear, straight);
  for (const int turn : {1, -1, 4, -4}) {
    const double angle = turn * step_rad_;
    // Never free, or turning to and fro would be.
    const double cost = std::abs(angle) * options.turn_m_per_rad + 0.01 * cell_m_;
    add({Kind::kTurn, angle}, turn, cost, cost);
  }
}

void MoveTable::add_walk_moves() {
  for (int dx = -2; dx <= 2; ++dx) {
    for (int dy = -2; dy <= 2; ++dy) {
      const bool neighbour = std::max(std::abs(dx), std::abs(dy)) == 1;
      const bool knight = std::abs(dx) + std::abs(dy) == 3;
      if (!neighbour && !knight) continue;
      const double metres = std::hypot(dx, dy) * cell_m_;
      add({Kind::kStraight, metres}, 0, metres, metres);
      moves_.back().dx_m = static_cast<float>(dx * cell_m_);
      moves_.back().dy_m = static_cast<float>(dy * cell_m_);
    }
  }
}

Pose2 MoveTable::pose_on(const Move& move, const Pose2& from, double share) const {
  if (ignores_heading_) {
    return {from.x_m + share * move.dx_m, from.y_m + share * move.dy_m, 0.0};
  }
  return advanced(from, move.piece.kind, share * move.piece.amount, radius_m_);
}

std::vector<Polygon> MoveTable::swept_areas(const Move& move, const Pose2& from) const {
  const double angle = std::abs(move.turn) * step_rad_;
  const int parts = std::max(1, static_cast<int>(std::ceil(angle / 0.14)));
  const double reach_m = checker_.footprint().circumscribed_m() + std::abs(move.piece.amount);
  // All poses of the box, and how far an arc bulges out between two of its points.
  const double heading_error = ignores_heading_ ? 0.0 : step_rad_ / (2.0 * kQuarters);
  const double bulge = (reach_m + radius_m_) * (1.0 - std::cos(angle / parts / 2.0));
  const double margin_m = cell_m_ / kQuarters * 0.7072 + reach_m * heading_error + bulge + 1e-6;
  std::vector<Polygon> areas;
  Polygon before = outline(checker_.footprint(), from);
  for (int i = 1; i <= parts; ++i) {
    const Polygon after =
        outline(checker_.footprint(), pose_on(move, from, static_cast<double>(i) / parts));
    Polygon both = before;
    both.insert(both.end(), after.begin(), after.end());
    areas.push_back(grown(convex_hull(std::move(both)), margin_m));
    before = after;
  }
  return areas;
}

std::vector<Polygon> MoveTable::core_areas(const Move& move, const Pose2& from) const {
  const double reach_m = checker_.footprint().circumscribed_m() + std::abs(move.piece.amount);
  const double heading_error = ignores_heading_ ? 0.0 : step_rad_ / (2.0 * kQuarters);
  const double margin_m = cell_m_ / kQuarters * 0.7072 + reach_m * heading_error + 1e-6;
  std::vector<Polygon> areas;
  constexpr int kParts = 4;
  for (int i = 1; i <= kParts; ++i) {
    const Pose2 at = pose_on(move, from, static_cast<double>(i) / kParts);
    Polygon area = inline_of(checker_.footprint(), at, margin_m);
    if (!area.empty()) areas.push_back(std::move(area));
  }
  return areas;
}

MoveTable::Swept MoveTable::make(std::size_t index, std::size_t move, int qx, int qy, int heading,
                                 int offset_quarter) {
  Entry& entry = table_[index];
  if (entry.state == State::kTooWide) return {};
  const double offset = (offset_quarter + 0.5) / kQuarters - 0.5;
  const Pose2 from{(qx + 0.5) / kQuarters * cell_m_, (qy + 0.5) / kQuarters * cell_m_,
                   (heading + offset) * step_rad_};
  std::vector<Polygon> areas = swept_areas(moves_[move], from);
  Rectangle around{1e9, -1e9, 1e9, -1e9};
  std::vector<Polygon> cores = core_areas(moves_[move], from);
  const auto to_cells = [&](Polygon& area) {
    for (Point2& corner : area) corner = {corner.x_m / cell_m_, corner.y_m / cell_m_};
  };
  for (Polygon& core : cores) to_cells(core);
  for (Polygon& area : areas) {
    to_cells(area);
    const Rectangle box = bounds_of(area);
    around = {std::min(around.x0_m, box.x0_m), std::max(around.x1_m, box.x1_m),
              std::min(around.y0_m, box.y0_m), std::max(around.y1_m, box.y1_m)};
  }
  const ColumnSpan columns = columns_between(around.x0_m, around.x1_m);
  const ColumnSpan rows = columns_between(around.y0_m, around.y1_m);
  if (columns.last - columns.first >= 60 || columns.first < -60 || columns.first > 60 ||
      rows.last - rows.first > 200) {
    entry.state = State::kTooWide;
    return {};
  }
  entry.offset = static_cast<std::uint32_t>(pool_.size());
  entry.first_row = static_cast<std::int16_t>(rows.first);
  entry.first_column = static_cast<std::int16_t>(columns.first);
  entry.height = static_cast<std::int16_t>(rows.last - rows.first + 1);
  entry.width = static_cast<std::int16_t>(columns.last - columns.first + 1);
  const auto height = static_cast<std::size_t>(entry.height);
  pool_.resize(pool_.size() + 2 * height, 0);
  std::uint64_t* words = &pool_[entry.offset];
  for (const Polygon& area : areas) mark(area, entry.first_row, entry.first_column, words);
  for (const Polygon& core : cores) mark(core, entry.first_row, entry.first_column, words + height);
  entry.state = State::kReady;
  return swept_of(entry);
}

}  // namespace linewright
