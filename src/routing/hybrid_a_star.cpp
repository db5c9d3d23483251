#include "linewright/routing/hybrid_a_star.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>
#include <vector>

#include "curve_estimate.hpp"
#include "moves.hpp"
#include "node_store.hpp"
#include "smoothing.hpp"
#include "steering.hpp"

namespace linewright {
namespace {

using Kind = PathSegment::Kind;

constexpr float kInfinite = std::numeric_limits<float>::infinity();
constexpr double kBucket_m = 0.02;

/// A finished way: the node from which a curve leads to the goal, and the whole path.
struct Finish {
  double cost_m = std::numeric_limits<double>::infinity();
  Path path;
};

}  // namespace

class HybridAStar::Search {
 public:
  Search(std::shared_ptr<const ClearanceMap> map, const Mover& mover,
         const PathPlannerOptions& options)
      : map_(std::move(map)),
        options_(options),
        exact_(map_, mover.footprint),
        checker_(map_, mover.footprint.grown(options.clearance_m)),
        steering_(checker_, mover, options),
        moves_(checker_, mover, options),
        curves_(mover.turning_radius_m, map_->frame().cell_m, moves_.headings()),
        lattice_(moves_.lattice()),
        headings_(moves_.headings() / lattice_),
        nodes_(map_->frame().size(), headings_),
        open_(kBucket_m),
        per_cell_(static_cast<float>(1.0 / map_->frame().cell_m)),
        free_from_(static_cast<float>(
                       checker_.footprint().circumscribed_m() / map_->frame().cell_m + 1.4143) +
                   moves_.reach_cells()) {}

  Path plan(const Pose2& start_in_map, const Pose2& goal_in_map) {
    effort_ = {};
    const Pose2 start = map_->frame().to_grid(start_in_map);
    goal_ = map_->frame().to_grid(goal_in_map);
    Path path = plan_in_grid(start);
    path.start = start_in_map;
    return path;
  }

  [[nodiscard]] SearchEffort effort() const { return effort_; }
  void use(std::shared_ptr<GoalDistance> distance) { distance_ = std::move(distance); }
  [[nodiscard]] std::shared_ptr<GoalDistance> distance() const { return distance_; }

 private:
  [[nodiscard]] Path failed(PathStatus status) const {
    Path path;
    path.status = status;
    path.turning_radius_m = steering_.turning_radius_m();
    return path;
  }

  Path plan_in_grid(const Pose2& start) {
    if (!checker_.free(start)) return failed(PathStatus::kStartOccupied);
    if (!checker_.free(goal_)) return failed(PathStatus::kGoalOccupied);
    PathStatus status = search(start);
    if (status == PathStatus::kNoManoeuvre || status == PathStatus::kSearchLimit) {
      // Every path can be driven back the way it came. The cells and headings of that search are
      // others, and what can be reached must not depend on the direction asked for.
      const auto forwards = std::exchange(distance_, nullptr);
      const Pose2 goal = std::exchange(goal_, start);
      if (search(goal) == PathStatus::kFound) {
        status = PathStatus::kFound;
        best_.path = driven_back(best_.path);
      }
      distance_ = forwards;
      goal_ = goal;
    }
    if (status != PathStatus::kFound) return failed(status);
    smooth(best_.path, steering_, options_.smoothing_passes);
    if (steering_.ignores_heading()) take_short_turns(best_.path);
    return std::move(best_.path);
  }

  /// Leaves what it finds in best_.
  PathStatus search(const Pose2& start) {
    const Cell goal_cell = cell_of(goal_.x_m, goal_.y_m);
    if (!distance_ || !(distance_->goal() == goal_cell)) {
      distance_ = std::make_shared<GoalDistance>(map_, exact_.footprint().inscribed_m(), goal_cell);
    }
    const std::size_t start_cell = map_->frame().index(cell_of(start.x_m, start.y_m));
    if (distance_->to_goal(start_cell) == GoalDistance::kUnreachable) return PathStatus::kNoAisle;
    prepare(start);
    run(start);
    if (best_.cost_m < std::numeric_limits<double>::infinity()) return PathStatus::kFound;
    return out_of_nodes_ ? PathStatus::kSearchLimit : PathStatus::kNoManoeuvre;
  }

  [[nodiscard]] static Path driven_back(const Path& path) {
    Path back = path;
    back.start = path.end();
    back.segments.assign(path.segments.rbegin(), path.segments.rend());
    for (PathSegment& segment : back.segments) segment.amount = -segment.amount;
    return back;
  }

  [[nodiscard]] Cell cell_of(double x_m, double y_m) const {
    const double cell_m = map_->frame().cell_m;
    return {static_cast<std::int32_t>(std::floor(x_m / cell_m)),
            static_cast<std::int32_t>(std::floor(y_m / cell_m))};
  }

  /// What depends on the headings of this start and goal.
  void prepare(const Pose2& start) {
    start_ = start;
    const int all = moves_.headings();
    const double steps = start.heading_rad / moves_.step_rad();
    const double whole = std::round(steps);
    offset_ = all == 1 ? 0.0 : steps - whole;
    offset_quarter_ = MoveTable::quarter_of(offset_);
    const auto rest = static_cast<int>(std::fmod(whole, all));
    const int first = all == 1 ? 0 : (rest < 0 ? rest + all : rest);
    first_heading_ = first / lattice_;
    phase_ = first % lattice_;
    displacement_.clear();
    for (int h = 0; h < headings_; ++h) {
      const double angle = heading_rad(h);
      const auto c = static_cast<float>(std::cos(angle));
      const auto s = static_cast<float>(std::sin(angle));
      for (const Move& move : moves_.moves()) {
        displacement_.push_back(
            all == 1 ? Displacement{move.dx_m, move.dy_m}
                     : Displacement{c * move.dx_m - s * move.dy_m, s * move.dx_m + c * move.dy_m});
      }
    }
    if (curves_.used()) curves_.aim(goal_, offset_, moves_.step_rad());
    nodes_.clear();
    open_.clear();
    best_ = {};
    out_of_nodes_ = false;
  }

  /// The step of all headings() that a heading of this search is.
  [[nodiscard]] int step_of(int heading) const { return heading * lattice_ + phase_; }
  [[nodiscard]] double heading_rad(int heading) const {
    return moves_.headings() == 1 ? start_.heading_rad
                                  : (step_of(heading) + offset_) * moves_.step_rad();
  }

  void run(const Pose2& start) {
    const Cell cell = cell_of(start.x_m, start.y_m);
    const std::uint32_t root = nodes_.id(map_->frame().index(cell), first_heading_);
    nodes_[root] = {0.0F, static_cast<float>(start.x_m), static_cast<float>(start.y_m),
                    NodeStore::kNoParent};
    open_.push(estimate(map_->frame().index(cell), nodes_[root], first_heading_), {root, 0.0F});
    std::size_t until_connection = 0;
    std::size_t most = options_.most_expansions;
    while (!open_.empty()) {
      if (open_.lowest_m() >= static_cast<float>(best_.cost_m)) return;
      const BucketQueue::Entry entry = open_.pop();
      if (nodes_[entry.node].cost_m < entry.cost_m) continue;  // reached more cheaply meanwhile
      if (effort_.expansions >= most || nodes_.full()) {
        out_of_nodes_ = true;
        return;
      }
      ++effort_.expansions;
      const NodeStore::Node node = nodes_[entry.node];
      nodes_[entry.node].cost_m = NodeStore::kExpanded;
      if (until_connection-- == 0) {
        const bool had_one = best_.cost_m < std::numeric_limits<double>::infinity();
        until_connection = connect(entry.node, node);
        if (!had_one && best_.cost_m < std::numeric_limits<double>::infinity()) {
          // A better one may follow, but is not worth more than the first one was.
          most = std::min(most, 2 * effort_.expansions + 500);
        }
      }
      expand(entry.node, node);
    }
  }

  [[nodiscard]] float estimate(std::size_t cell, const NodeStore::Node& node, int heading) {
    const float cells = distance_->to_goal(cell);
    if (cells == GoalDistance::kUnreachable) return kInfinite;
    float metres = cells * static_cast<float>(map_->frame().cell_m);
    if (curves_.used()) metres = std::max(metres, curves_.metres(node.x_m, node.y_m, step_of(heading)));
    return node.cost_m + metres * static_cast<float>(options_.greed);
  }

  void expand(std::uint32_t id, const NodeStore::Node& node) {
    const int heading = nodes_.heading(id);
    const Cell cell{static_cast<std::int32_t>(node.x_m * per_cell_),
                    static_cast<std::int32_t>(node.y_m * per_cell_)};
    const bool open_space = map_->distance_cells(map_->frame().index(cell)) >= free_from_;
    const std::vector<Move>& moves = moves_.moves();
    const Displacement* displacement =
        &displacement_[static_cast<std::size_t>(heading) * moves.size()];
    for (std::size_t m = 0; m < moves.size(); ++m) {
      NodeStore::Node next{node.cost_m + moves[m].cost_m + change_cost(node, moves[m]),
                           node.x_m + displacement[m].x_m, node.y_m + displacement[m].y_m,
                           id << NodeStore::kMoveBits | static_cast<std::uint32_t>(m)};
      if (next.x_m < 0.0F || next.y_m < 0.0F) continue;
      const Cell to{static_cast<std::int32_t>(next.x_m * per_cell_),
                    static_cast<std::int32_t>(next.y_m * per_cell_)};
      if (!map_->frame().contains(to)) continue;
      const std::size_t index = map_->frame().index(to);
      if (!distance_->passable(index)) continue;
      const int next_heading = turned(heading, moves[m].turn / lattice_);
      const std::uint32_t next_id = nodes_.id(index, next_heading);
      if (nodes_[next_id].cost_m <= next.cost_m) continue;
      if (!open_space && !move_free(node, cell, heading, m)) continue;
      const float priority = estimate(index, next, next_heading);
      if (priority >= static_cast<float>(best_.cost_m)) continue;  // infinite, too
      nodes_[next_id] = next;
      open_.push(priority, {next_id, next.cost_m});
    }
  }

  [[nodiscard]] int turned(int heading, int turn) const {
    const int sum = heading + turn;
    return sum < 0 ? sum + headings_ : (sum >= headings_ ? sum - headings_ : sum);
  }

  /// What it costs that this move is not like the one that led to the node.
  [[nodiscard]] float change_cost(const NodeStore::Node& node, const Move& move) const {
    if (node.is_root() || moves_.headings() == 1) return 0.0F;
    const PathSegment& before = moves_.moves()[node.move()].piece;
    float cost = 0.0F;
    if (before.kind != move.piece.kind && steering_.turning_radius_m() > 0.0) {
      cost += static_cast<float>(options_.steering_change_m);
    }
    if (before.kind != Kind::kTurn && move.piece.kind != Kind::kTurn &&
        before.amount * move.piece.amount < 0.0) {
      cost += static_cast<float>(options_.direction_change_m);
    }
    return cost;
  }

  [[nodiscard]] bool move_free(const NodeStore::Node& node, Cell cell, int heading,
                               std::size_t move) {
    const MoveTable::Swept swept = moves_.swept(
        move, node.x_m * per_cell_, node.y_m * per_cell_, step_of(heading), offset_quarter_);
    if (swept.rows != nullptr) {
      std::uint64_t hit = 0;
      std::uint64_t certain = 0;
      for (int r = 0; r < swept.height; ++r) {
        const std::uint64_t blocked = map_->bits(cell.column + swept.first_column,
                                                 cell.row + swept.first_row + r, swept.width);
        hit |= swept.rows[r] & blocked;
        certain |= swept.core[r] & blocked;
      }
      if (hit == 0) return true;
      if (certain != 0) return false;
    }
    const Pose2 from{node.x_m, node.y_m, heading_rad(heading)};
    const Move& made = moves_.moves()[move];
    if (moves_.headings() > 1) {
      // What is in the way is mostly so at the end.
      const Pose2 end =
          advanced(from, made.piece.kind, made.piece.amount, steering_.turning_radius_m());
      return checker_.free(end) && steering_.free(from, {&made.piece, 1});
    }
    const Pose2 facing{from.x_m, from.y_m, std::atan2(made.dy_m, made.dx_m)};
    return steering_.free(facing, {&made.piece, 1});
  }

  /// Tries to finish from the node; returns after how many expansions to try again.
  std::size_t connect(std::uint32_t id, const NodeStore::Node& node) {
    const Pose2 from{node.x_m, node.y_m, heading_rad(nodes_.heading(id))};
    ++effort_.connections;
    const Connection connection = steering_.connect(from, goal_);
    // Often near the goal, seldom far from it.
    const double cells = connection.cost_m / map_->frame().cell_m;
    const auto wait = static_cast<std::size_t>(std::min(cells / 8.0, 200.0));
    if (node.cost_m + connection.cost_m >= best_.cost_m) return wait;
    if (!steering_.free(from, connection.curve.segments())) return wait;
    finish(id, node.cost_m, connection);
    return wait;
  }

  /// Follows the nodes back and joins the moves to a path of exact poses.
  void finish(std::uint32_t id, double cost_m, const Connection& connection) {
    std::vector<std::uint32_t> chain;
    std::uint32_t at = id;
    for (; !nodes_[at].is_root(); at = nodes_[at].parent()) chain.push_back(at);
    Path path = failed(PathStatus::kFound);
    path.start = start_;
    Pose2 pose = start_;
    const auto add = [&](const PathSegment& piece) {
      append_segment(path, piece);
      pose = advanced(pose, piece.kind, piece.amount, path.turning_radius_m);
    };
    for (auto node = chain.rbegin(); node != chain.rend(); ++node) {
      const Move& move = moves_.moves()[nodes_[*node].move()];
      if (moves_.headings() == 1) {
        const double bearing = std::atan2(move.dy_m, move.dx_m);
        add({Kind::kTurn, std::remainder(bearing - pose.heading_rad, 2 * std::numbers::pi)});
      }
      add(move.piece);
    }
    // Nodes hold floats: a last curve of the same word from the exact pose ends in the exact goal.
    Connection last = steering_.reconnect(pose, goal_, connection);
    if (last.curve.count == 0) last = steering_.connect(pose, goal_);
    if (!steering_.free(pose, last.curve.segments())) return;
    for (const PathSegment& piece : last.curve.segments()) append_segment(path, piece);
    const double cost = cost_m + last.cost_m;
    if (cost < best_.cost_m) best_ = {cost, std::move(path)};
  }

  struct Displacement {
    float x_m, y_m;
  };

  std::shared_ptr<const ClearanceMap> map_;
  PathPlannerOptions options_;
  CollisionChecker exact_;
  CollisionChecker checker_;  ///< with the clearance
  Steering steering_;
  MoveTable moves_;
  CurveEstimate curves_;
  int lattice_;   ///< heading steps between two headings that one search tells apart
  int headings_;  ///< these headings
  NodeStore nodes_;
  BucketQueue open_;
  float per_cell_;   ///< cells per metre
  float free_from_;  ///< cells from which on no move of any heading can collide
  std::shared_ptr<GoalDistance> distance_;
  SearchEffort effort_;
  // Of the search that is under way; poses in the frame of the grid.
  Pose2 start_;
  Pose2 goal_;
  double offset_ = 0.0;  ///< heading steps between all headings and whole steps
  int offset_quarter_ = 0;
  int first_heading_ = 0;
  int phase_ = 0;  ///< heading steps from step 0 to this search's heading 0
  std::vector<Displacement> displacement_;  ///< [heading][move]
  Finish best_;
  bool out_of_nodes_ = false;
};

HybridAStar::HybridAStar(std::shared_ptr<const ClearanceMap> map, const Mover& mover,
                         const PathPlannerOptions& options)
    : search_(std::make_unique<Search>(std::move(map), mover, options)) {}
HybridAStar::~HybridAStar() = default;

Path HybridAStar::plan(const Pose2& start, const Pose2& goal) { return search_->plan(start, goal); }

SearchEffort HybridAStar::effort() const { return search_->effort(); }

void HybridAStar::use_goal_distance(std::shared_ptr<GoalDistance> distance) {
  search_->use(std::move(distance));
}

std::shared_ptr<GoalDistance> HybridAStar::goal_distance() const { return search_->distance(); }

}  // namespace linewright
