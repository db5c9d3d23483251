#include "plain_hybrid_a_star.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <queue>
#include <unordered_map>

#include "../../src/routing/moves.hpp"
#include "../../src/routing/smoothing.hpp"
#include "../../src/routing/steering.hpp"
#include "linewright/routing/goal_distance.hpp"

namespace linewright::bench {

class PlainHybridAStar::Search {
 public:
  Search(const Case& c, const PathPlannerOptions& options)
      : map_(c.map),
        options_(options),
        inscribed_m_(c.mover.footprint.inscribed_m()),
        radius_m_(c.mover.turning_radius_m),
        checker_(c.map, c.mover.footprint.grown(options.clearance_m)),
        steering_(checker_, c.mover, options),
        moves_(checker_, c.mover, options) {}

  Path plan(const Query& query) {
    expansions_ = 0;
    const Pose2 start = map_->frame().to_grid(query.start);
    goal_ = map_->frame().to_grid(query.goal);
    nodes_.clear();
    open_ = {};
    if (!distance_ || !(distance_->goal() == cell_of(goal_))) {
      distance_ = std::make_shared<GoalDistance>(map_, inscribed_m_, cell_of(goal_));
    }
    reach(start, 0.0, kRoot, 0);
    while (!open_.empty() && expansions_ < 1'000'000) {
      const std::uint64_t key = open_.top().second;
      open_.pop();
      Node& node = nodes_[key];
      if (node.closed) continue;
      node.closed = true;
      ++expansions_;
      Path path = connected(key, start);
      if (path.found()) {
        smooth(path, steering_, options_.smoothing_passes);
        return path;
      }
      expand(key);
    }
    return {};
  }

  [[nodiscard]] std::size_t expansions() const { return expansions_; }

 private:
  static constexpr std::uint64_t kRoot = ~std::uint64_t{0};

  struct Node {
    Pose2 pose;
    double cost_m = 0.0;
    std::uint64_t parent = kRoot;
    std::size_t move = 0;
    bool closed = false;
  };
  using Open = std::pair<double, std::uint64_t>;

  [[nodiscard]] Cell cell_of(const Pose2& pose) const {
    const double cell_m = map_->frame().cell_m;
    return {static_cast<std::int32_t>(std::floor(pose.x_m / cell_m)),
            static_cast<std::int32_t>(std::floor(pose.y_m / cell_m))};
  }

  [[nodiscard]] double left_m(const Pose2& pose, std::size_t cell) {
    const double cells = distance_->to_goal(cell);
    return options_.greed *
           std::max(cells * map_->frame().cell_m, reeds_shepp_m(pose, goal_, radius_m_));
  }

  void reach(const Pose2& pose, double cost_m, std::uint64_t parent, std::size_t move) {
    const Cell at = cell_of(pose);
    if (!map_->frame().contains(at)) return;
    const std::size_t cell = map_->frame().index(at);
    if (!distance_->passable(cell)) return;
    const double turns = pose.heading_rad / (2.0 * std::numbers::pi);
    const auto heading =
        static_cast<std::uint64_t>(std::lround((turns - std::floor(turns)) * options_.headings)) %
        static_cast<std::uint64_t>(options_.headings);
    const std::uint64_t key = cell * static_cast<std::uint64_t>(options_.headings) + heading;
    const auto [found, is_new] = nodes_.try_emplace(key);
    Node& node = found->second;
    if (!is_new && (node.closed || node.cost_m <= cost_m)) return;
    const double left = left_m(pose, cell);
    if (!std::isfinite(left)) return;
    node = {pose, cost_m, parent, move, false};
    open_.emplace(cost_m + left, key);
  }

  [[nodiscard]] bool free(const Pose2& from, const PathSegment& piece) const {
    const int looks = std::max(1, static_cast<int>(std::ceil(std::abs(piece.amount) / 0.05)));
    for (int i = 1; i <= looks; ++i) {
      const Pose2 at = advanced(from, piece.kind, piece.amount * i / looks, radius_m_);
      if (!checker_.free(at)) return false;
    }
    return true;
  }

  void expand(std::uint64_t key) {
    const Node node = nodes_[key];
    for (std::size_t m = 0; m < moves_.moves().size(); ++m) {
      const Move& move = moves_.moves()[m];
      if (!free(node.pose, move.piece)) continue;
      double cost_m = node.cost_m + move.cost_m;
      if (node.parent != kRoot) {
        const PathSegment& before = moves_.moves()[node.move].piece;
        if (before.kind != move.piece.kind) cost_m += options_.steering_change_m;
        if (before.amount * move.piece.amount < 0.0) cost_m += options_.direction_change_m;
      }
      reach(advanced(node.pose, move.piece.kind, move.piece.amount, radius_m_), cost_m, key, m);
    }
  }

  /// The path when the curve from the node to the goal is free; tried often near the goal only.
  [[nodiscard]] Path connected(std::uint64_t key, const Pose2& start) {
    if (wait_ > 0 && --wait_ > 0) return {};
    const Node& node = nodes_[key];
    const Connection last = steering_.connect(node.pose, goal_);
    wait_ = 1 + static_cast<std::size_t>(std::min(last.cost_m / map_->frame().cell_m / 8.0, 200.0));
    Pose2 at = node.pose;
    for (const PathSegment& piece : last.curve.segments()) {
      if (!free(at, piece)) return {};
      at = advanced(at, piece.kind, piece.amount, radius_m_);
    }
    std::vector<std::size_t> moves;
    for (std::uint64_t k = key; nodes_[k].parent != kRoot; k = nodes_[k].parent) {
      moves.push_back(nodes_[k].move);
    }
    Path path{PathStatus::kFound, start, radius_m_, {}};
    for (auto move = moves.rbegin(); move != moves.rend(); ++move) {
      append_segment(path, moves_.moves()[*move].piece);
    }
    for (const PathSegment& piece : last.curve.segments()) append_segment(path, piece);
    return path;
  }

  std::shared_ptr<const ClearanceMap> map_;
  PathPlannerOptions options_;
  double inscribed_m_;
  double radius_m_;
  CollisionChecker checker_;
  Steering steering_;
  MoveTable moves_;
  Pose2 goal_;
  std::shared_ptr<GoalDistance> distance_;
  std::unordered_map<std::uint64_t, Node> nodes_;
  std::priority_queue<Open, std::vector<Open>, std::greater<>> open_;
  std::size_t wait_ = 0;
  std::size_t expansions_ = 0;
};

PlainHybridAStar::PlainHybridAStar(const Case& c, const PathPlannerOptions& options)
    : search_(std::make_unique<Search>(c, options)) {}
PlainHybridAStar::~PlainHybridAStar() = default;
Path PlainHybridAStar::plan(const Query& query) { return search_->plan(query); }
std::size_t PlainHybridAStar::expansions() const { return search_->expansions(); }

}  // namespace linewright::bench
