#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <vector>

#include "curve_estimate.hpp"
#include "linewright/routing/goal_distance.hpp"
#include "moves.hpp"
#include "node_store.hpp"
#include "steering.hpp"

namespace linewright {

/// What all searches of one mover on one map share.
struct SearchTools {
  SearchTools(std::shared_ptr<const ClearanceMap> on, const Mover& mover,
              const PathPlannerOptions& how)
      : map(std::move(on)),
        options(how),
        inscribed_m(mover.footprint.inscribed_m()),
        checker(map, mover.footprint.grown(options.clearance_m)),
        body(map, mover.footprint.grown(std::min(options.clearance_m, 0.001))),
        body_steering(body, mover, options),
        steering(checker, mover, options),
        moves(checker, mover, options) {}
  SearchTools(const SearchTools&) = delete;
  SearchTools& operator=(const SearchTools&) = delete;

  std::shared_ptr<const ClearanceMap> map;
  PathPlannerOptions options;
  double inscribed_m;        ///< of the footprint itself
  CollisionChecker checker;  ///< with the clearance
  CollisionChecker body;     ///< with as little as looking every 5 cm needs
  Steering body_steering;    ///< asks `body`
  Steering steering;
  MoveTable moves;
};

/// One Hybrid A* search that can be interrupted. Poses are in the frame of the grid.
///
/// Backwards it starts at the end of the way: every way can be driven back as it came. The nodes of
/// the two directions are others, so that one may find what the other one does not, or find it
/// sooner. Where driving backwards is dear, costs are those of driving in the asked direction; else
/// the search is the very one that the opposite way would be searched by.
class DirectedSearch {
 public:
  DirectedSearch(SearchTools& tools, bool backwards);

  /// Begins a search between two free poses. Returns false when the map alone shows that there is
  /// no way; then it must not be run.
  [[nodiscard]] bool begin(const Pose2& from, const Pose2& to);

  enum class Outcome : std::uint8_t { kPaused, kFound, kExhausted, kFull };
  /// Goes on until there is a path, nothing is left, or `expansions` were done in all (somewhat
  /// more when it has a path by then and looks for a better one). kFull: out of node numbers,
  /// or cancelled.
  [[nodiscard]] Outcome run(std::size_t expansions);

  /// From `from` to `to` also when searched backwards; after kFound.
  [[nodiscard]] Path take_path();

  [[nodiscard]] std::size_t expansions() const { return expansions_; }
  [[nodiscard]] std::size_t connections() const { return connections_; }

  void use(std::shared_ptr<GoalDistance> distance) { distance_ = std::move(distance); }
  [[nodiscard]] std::shared_ptr<GoalDistance> distance() const { return distance_; }

 private:
  struct Displacement {
    float x_m, y_m;
  };
  /// A finished way: the moves, and the curve that leads to the goal.
  struct Finish {
    double cost_m = std::numeric_limits<double>::infinity();
    Path path;
  };

  void prepare_headings();
  [[nodiscard]] Cell cell_of(double x_m, double y_m) const;
  /// The step of all MoveTable::headings() that a heading of this search is.
  [[nodiscard]] int step_of(int heading) const { return heading * lattice_ + phase_; }
  [[nodiscard]] double heading_rad(int heading) const;
  [[nodiscard]] int turned(int heading, int turn) const;
  [[nodiscard]] bool is_cancelled() const {
    return tools_.options.cancel != nullptr && tools_.options.cancel->requested();
  }
  [[nodiscard]] bool has_path() const { return best_.cost_m < kNever; }
  [[nodiscard]] float left_m(std::size_t cell, const NodeStore::Node& node, int heading);
  void expand(std::uint32_t id, const NodeStore::Node& node);
  [[nodiscard]] float cost_of(const NodeStore::Node& node, const Move& move) const;
  [[nodiscard]] bool move_free(const NodeStore::Node& node, Cell cell, int heading,
                               std::size_t move);
  [[nodiscard]] bool move_free_exactly(const Pose2& from, const Move& move) const;
  [[nodiscard]] std::size_t connect(std::uint32_t id, const NodeStore::Node& node);
  [[nodiscard]] Connection connection_from(const Pose2& from) const;
  [[nodiscard]] Connection connection_like(const Pose2& from, const Connection& like) const;
  [[nodiscard]] Path moves_to(std::uint32_t id) const;
  void finish(std::uint32_t id, double cost_m, const Connection& connection);

  static constexpr double kNever = std::numeric_limits<double>::infinity();

  SearchTools& tools_;
  const ClearanceMap& map_;
  bool backwards_;
  bool mirrored_;  ///< costs are those of driving everything the other way
  int lattice_;    ///< heading steps between two headings that one search tells apart
  int headings_;   ///< these headings
  CurveEstimate curves_;
  NodeStore nodes_;
  BucketQueue open_;
  float cell_m_;
  float per_cell_;   ///< cells per metre
  float free_from_;  ///< cells from which on no move of any heading can collide
  std::shared_ptr<GoalDistance> distance_;
  // Of the search that is under way:
  Pose2 start_;
  Pose2 goal_;
  double offset_ = 0.0;  ///< heading steps between all headings and whole steps
  int offset_quarter_ = 0;
  int phase_ = 0;  ///< heading steps from step 0 to this search's heading 0
  int first_heading_ = 0;
  std::vector<Displacement> displacement_;  ///< [heading][move]
  Finish best_;
  std::size_t expansions_ = 0;
  std::size_t connections_ = 0;
  std::size_t until_connection_ = 0;
  std::size_t most_ = 0;  ///< expansions, once there is a path
};

/// The same way in the other direction.
[[nodiscard]] Path driven_back(const Path& path, bool ignores_heading);

}  // namespace linewright
