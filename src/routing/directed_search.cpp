#include "directed_search.hpp"

#include <algorithm>
#include <numbers>
#include <utility>

#include "smoothing.hpp"

namespace linewright {
namespace {

using Kind = PathSegment::Kind;

constexpr float kInfinite = std::numeric_limits<float>::infinity();
constexpr double kBucket_m = 0.02;
/// Up to this factor on metres driven backwards it does not matter which end is driven from.
constexpr double kDear = 1.2;

void turn_round(ReedsSheppCurve& curve) {
  std::reverse(curve.pieces.begin(), curve.pieces.begin() + curve.count);
  for (PathSegment& piece : curve.pieces) piece.amount = -piece.amount;
}

}  // namespace

Path driven_back(const Path& path, bool ignores_heading) {
  Path back = path;
  back.start = path.end();
  back.segments.clear();
  for (auto piece = path.segments.rbegin(); piece != path.segments.rend(); ++piece) {
    const PathSegment other{piece->kind, -piece->amount};
    if (ignores_heading && other.kind == Kind::kStraight && other.amount < 0.0) {
      // Who does not care where it looks does not go backwards either.
      append_segment(back, {Kind::kTurn, std::numbers::pi});
      append_segment(back, {Kind::kStraight, -other.amount});
      append_segment(back, {Kind::kTurn, -std::numbers::pi});
    } else {
      append_segment(back, other);
    }
  }
  return back;
}

DirectedSearch::DirectedSearch(SearchTools& tools, bool backwards)
    : tools_(tools),
      map_(*tools.map),
      backwards_(backwards),
      mirrored_(backwards && tools.options.reverse_penalty > kDear),
      lattice_(tools.moves.lattice()),
      headings_(tools.moves.headings() / lattice_),
      curves_(tools.steering.turning_radius_m(), map_.frame().cell_m, tools.moves.headings()),
      nodes_(map_.frame().size(), headings_),
      open_(kBucket_m),
      cell_m_(static_cast<float>(map_.frame().cell_m)),
      per_cell_(static_cast<float>(1.0 / map_.frame().cell_m)),
      free_from_(static_cast<float>(
                     tools.checker.footprint().circumscribed_m() / map_.frame().cell_m + 1.4143) +
                 tools.moves.reach_cells()) {}

bool DirectedSearch::begin(const Pose2& from, const Pose2& to) {
  start_ = backwards_ ? to : from;
  goal_ = backwards_ ? from : to;
  expansions_ = connections_ = until_connection_ = 0;
  const Cell goal_cell = cell_of(goal_.x_m, goal_.y_m);
  if (!distance_ || !(distance_->goal() == goal_cell)) {
    distance_ = std::make_shared<GoalDistance>(tools_.map, tools_.inscribed_m, goal_cell);
  }
  const Cell start_cell = cell_of(start_.x_m, start_.y_m);
  // A body may lie on the map while the point that its pose names does not.
  if (!map_.frame().contains(start_cell) || !map_.frame().contains(goal_cell)) return false;
  const std::size_t cell = map_.frame().index(start_cell);
  if (distance_->to_goal(cell) == GoalDistance::kUnreachable) return false;
  prepare_headings();
  if (curves_.used()) curves_.aim(goal_, offset_, tools_.moves.step_rad());
  nodes_.clear();
  open_.clear();
  best_ = {};
  most_ = SIZE_MAX;
  const std::uint32_t root = nodes_.id(cell, first_heading_);
  nodes_[root] = {0.0F, static_cast<float>(start_.x_m), static_cast<float>(start_.y_m),
                  NodeStore::kNoParent};
  open_.push(left_m(cell, nodes_[root], first_heading_), {root, 0.0F});
  return true;
}

Cell DirectedSearch::cell_of(double x_m, double y_m) const {
  const double cell_m = map_.frame().cell_m;
  return {static_cast<std::int32_t>(std::floor(x_m / cell_m)),
          static_cast<std::int32_t>(std::floor(y_m / cell_m))};
}

/// What depends on the heading of this start.
void DirectedSearch::prepare_headings() {
  const MoveTable& table = tools_.moves;
  const int all = table.headings();
  const double steps = start_.heading_rad / table.step_rad();
  const double whole = std::round(steps);
  offset_ = all == 1 ? 0.0 : steps - whole;
  offset_quarter_ = MoveTable::quarter_of(offset_);
  const auto rest = static_cast<int>(std::fmod(whole, all));
  const int first = all == 1 ? 0 : (rest < 0 ? rest + all : rest);
  first_heading_ = first / lattice_;
  phase_ = first % lattice_;
  displacement_.clear();
  for (int h = 0; h < headings_; ++h) {
    const auto c = static_cast<float>(std::cos(heading_rad(h)));
    const auto s = static_cast<float>(std::sin(heading_rad(h)));
    for (const Move& move : table.moves()) {
      displacement_.push_back(
          all == 1 ? Displacement{move.dx_m, move.dy_m}
                   : Displacement{c * move.dx_m - s * move.dy_m, s * move.dx_m + c * move.dy_m});
    }
  }
}

double DirectedSearch::heading_rad(int heading) const {
  return tools_.moves.headings() == 1 ? start_.heading_rad
                                      : (step_of(heading) + offset_) * tools_.moves.step_rad();
}

int DirectedSearch::turned(int heading, int turn) const {
  const int sum = heading + turn;
  return sum < 0 ? sum + headings_ : (sum >= headings_ ? sum - headings_ : sum);
}

DirectedSearch::Outcome DirectedSearch::run(std::size_t expansions) {
  while (!open_.empty()) {
    if (open_.lowest_m() >= static_cast<float>(best_.cost_m)) return Outcome::kFound;
    if (has_path() ? expansions_ >= most_ : expansions_ >= expansions) {
      return has_path() ? Outcome::kFound : Outcome::kPaused;
    }
    const BucketQueue::Entry entry = open_.pop();
    if (nodes_[entry.node].cost_m < entry.cost_m) continue;  // reached more cheaply meanwhile
    if (nodes_.full()) return has_path() ? Outcome::kFound : Outcome::kFull;
    if (++expansions_ % 4096 == 0 && is_cancelled()) return Outcome::kFull;
    const NodeStore::Node node = nodes_[entry.node];
    nodes_[entry.node].cost_m = NodeStore::kExpanded;
    if (until_connection_-- == 0) {
      const bool had_one = has_path();
      until_connection_ = connect(entry.node, node);
      // A better one may follow, but is not worth more than the first one was.
      if (!had_one && has_path()) most_ = 2 * expansions_ + 500;
    }
    expand(entry.node, node);
  }
  return has_path() ? Outcome::kFound : Outcome::kExhausted;
}

Path DirectedSearch::take_path() {
  if (!backwards_) return std::move(best_.path);
  return driven_back(best_.path, tools_.steering.ignores_heading());
}

/// Estimate of the cost from a node to the goal; infinite when there is no way.
float DirectedSearch::left_m(std::size_t cell, const NodeStore::Node& node, int heading) {
  const float cells = distance_->to_goal(cell);
  if (cells == GoalDistance::kUnreachable) return kInfinite;
  float metres = cells * cell_m_;
  if (curves_.used()) {
    metres = std::max(metres, curves_.metres(node.x_m, node.y_m, step_of(heading)));
  }
  return metres * static_cast<float>(tools_.options.greed);
}

void DirectedSearch::expand(std::uint32_t id, const NodeStore::Node& node) {
  const int heading = nodes_.heading(id);
  const Cell cell{static_cast<std::int32_t>(node.x_m * per_cell_),
                  static_cast<std::int32_t>(node.y_m * per_cell_)};
  if (!map_.frame().contains(cell)) return;  // a float can be rounded across the edge of the map
  const bool open_space = map_.distance_cells(map_.frame().index(cell)) >= free_from_;
  const std::vector<Move>& moves = tools_.moves.moves();
  const Displacement* displacement =
      &displacement_[static_cast<std::size_t>(heading) * moves.size()];
  for (std::size_t m = 0; m < moves.size(); ++m) {
    NodeStore::Node next{node.cost_m + cost_of(node, moves[m]), node.x_m + displacement[m].x_m,
                         node.y_m + displacement[m].y_m,
                         id << NodeStore::kMoveBits | static_cast<std::uint32_t>(m)};
    if (next.x_m < 0.0F || next.y_m < 0.0F) continue;
    const Cell to{static_cast<std::int32_t>(next.x_m * per_cell_),
                  static_cast<std::int32_t>(next.y_m * per_cell_)};
    if (!map_.frame().contains(to)) continue;
    const std::size_t index = map_.frame().index(to);
    if (!distance_->passable(index)) continue;
    const int next_heading = turned(heading, moves[m].turn / lattice_);
    const std::uint32_t next_id = nodes_.id(index, next_heading);
    if (nodes_[next_id].cost_m <= next.cost_m) continue;
    if (!open_space && !move_free(node, cell, heading, m)) continue;
    const float priority = next.cost_m + left_m(index, next, next_heading);
    if (priority >= static_cast<float>(best_.cost_m)) continue;  // infinite, too
    nodes_[next_id] = next;
    open_.push(priority, {next_id, next.cost_m});
  }
}

/// With what it costs that this move is not like the one that led to the node.
float DirectedSearch::cost_of(const NodeStore::Node& node, const Move& move) const {
  float cost = mirrored_ ? move.cost_back_m : move.cost_m;
  if (node.is_root() || tools_.moves.headings() == 1) return cost;
  const PathSegment& before = tools_.moves.moves()[node.move()].piece;
  if (before.kind != move.piece.kind && tools_.steering.turning_radius_m() > 0.0) {
    cost += static_cast<float>(tools_.options.steering_change_m);
  }
  if (before.kind != Kind::kTurn && move.piece.kind != Kind::kTurn &&
      before.amount * move.piece.amount < 0.0) {
    cost += static_cast<float>(tools_.options.direction_change_m);
  }
  return cost;
}

bool DirectedSearch::move_free(const NodeStore::Node& node, Cell cell, int heading,
                               std::size_t move) {
  const MoveTable::Swept swept = tools_.moves.swept(
      move, node.x_m * per_cell_, node.y_m * per_cell_, step_of(heading), offset_quarter_);
  if (swept.rows != nullptr) {
    std::uint64_t hit = 0;
    std::uint64_t certain = 0;
    for (int r = 0; r < swept.height; ++r) {
      const std::uint64_t blocked =
          map_.bits(cell.column + swept.first_column, cell.row + swept.first_row + r, swept.width);
      hit |= swept.rows[r] & blocked;
      certain |= swept.core[r] & blocked;
    }
    if (hit == 0) return true;
    if (certain != 0) return false;
  }
  return move_free_exactly({node.x_m, node.y_m, heading_rad(heading)}, tools_.moves.moves()[move]);
}

bool DirectedSearch::move_free_exactly(const Pose2& from, const Move& move) const {
  if (tools_.moves.headings() == 1) {
    const Pose2 facing{from.x_m, from.y_m, std::atan2(move.dy_m, move.dx_m)};
    return tools_.steering.free(facing, {&move.piece, 1});
  }
  // What is in the way is mostly so at the end.
  const Pose2 end =
      advanced(from, move.piece.kind, move.piece.amount, tools_.steering.turning_radius_m());
  return tools_.checker.free(end) && tools_.steering.free(from, {&move.piece, 1});
}

Connection DirectedSearch::connection_from(const Pose2& from) const {
  if (!mirrored_) return tools_.steering.connect(from, goal_);
  Connection made = tools_.steering.connect(goal_, from);
  turn_round(made.curve);
  return made;
}

Connection DirectedSearch::connection_like(const Pose2& from, const Connection& like) const {
  Connection made = mirrored_ ? tools_.steering.reconnect(goal_, from, like)
                              : tools_.steering.reconnect(from, goal_, like);
  if (mirrored_) turn_round(made.curve);
  return made;
}

/// Tries to finish from the node; returns after how many expansions to try again.
std::size_t DirectedSearch::connect(std::uint32_t id, const NodeStore::Node& node) {
  const Pose2 from{node.x_m, node.y_m, heading_rad(nodes_.heading(id))};
  ++connections_;
  const Connection connection = connection_from(from);
  // Often near the goal, seldom far from it.
  const double cells = connection.cost_m / map_.frame().cell_m;
  const auto wait = static_cast<std::size_t>(std::min(cells / 8.0, 200.0));
  if (node.cost_m + connection.cost_m >= best_.cost_m) return wait;
  if (!tools_.steering.free(from, connection.curve.segments())) return wait;
  finish(id, node.cost_m, connection);
  return wait;
}

/// The moves that led to a node as a path of exact poses.
Path DirectedSearch::moves_to(std::uint32_t id) const {
  std::vector<std::uint32_t> chain;
  for (std::uint32_t at = id; !nodes_[at].is_root(); at = nodes_[at].parent()) chain.push_back(at);
  Path path;
  path.status = PathStatus::kFound;
  path.turning_radius_m = tools_.steering.turning_radius_m();
  path.start = start_;
  double heading = start_.heading_rad;
  for (auto node = chain.rbegin(); node != chain.rend(); ++node) {
    const Move& move = tools_.moves.moves()[nodes_[*node].move()];
    if (tools_.moves.headings() == 1) {
      const double turn =
          std::remainder(std::atan2(move.dy_m, move.dx_m) - heading, 2 * std::numbers::pi);
      append_segment(path, {Kind::kTurn, turn});
      heading += turn;
    }
    append_segment(path, move.piece);
  }
  return path;
}

/// Keeps the way over the node and the connection when it is the best one so far.
void DirectedSearch::finish(std::uint32_t id, double cost_m, const Connection& connection) {
  Path path = moves_to(id);
  const Pose2 pose = path.end();
  // Nodes hold floats: a last curve of the same word from the exact pose ends in the exact goal.
  Connection last = connection_like(pose, connection);
  if (last.curve.count == 0) last = connection_from(pose);
  if (!tools_.steering.free(pose, last.curve.segments())) return;
  for (const PathSegment& piece : last.curve.segments()) append_segment(path, piece);
  // Over hundreds of metres the floats of the nodes drift away from the exact moves: into the
  // clearance, which is what it is for, but not farther.
  if (!tools_.body_steering.free(start_, path.segments)) return;
  const double cost = cost_m + last.cost_m;
  if (cost < best_.cost_m) best_ = {cost, std::move(path)};
}

}  // namespace linewright
