#pragma once

#include <memory>
#include <vector>

#include "linewright/routing/path_planner.hpp"
#include "steering.hpp"

namespace linewright {

/// The plain reference: shortest ways over the middles of cells, eight neighbours, with a binary
/// heap; A* (octile distance) or, without an estimate, Dijkstra. It plans for the disc around the
/// footprint, and the mover turns on the spot wherever it likes.
class GridPlanner final : public PathPlanner {
 public:
  GridPlanner(std::shared_ptr<const ClearanceMap> map, const Mover& mover,
              const PathPlannerOptions& options, bool uses_estimate);

  [[nodiscard]] Path plan(const Pose2& start, const Pose2& goal) override;
  [[nodiscard]] SearchEffort effort() const override { return effort_; }

 private:
  struct Open {
    double priority;
    double cost;
    std::size_t cell;
    /// The earlier cell at equal priority, whatever order they were pushed in.
    friend bool operator<(const Open& a, const Open& b) {
      return a.priority != b.priority ? a.priority > b.priority : a.cell > b.cell;
    }
  };

  [[nodiscard]] Point2 middle(std::size_t cell) const;
  [[nodiscard]] bool segment_free(Point2 from, Point2 to) const;
  [[nodiscard]] std::vector<std::size_t> cells_near(Point2 point) const;
  [[nodiscard]] bool search(Point2 start, Point2 goal);
  void expand(std::size_t cell, Point2 goal);
  void reach(std::size_t cell, double cost, std::size_t from, Point2 goal);
  [[nodiscard]] Path path_to(const Pose2& start, const Pose2& goal) const;

  std::shared_ptr<const ClearanceMap> map_;
  PathPlannerOptions options_;
  CollisionChecker checker_;  ///< the disc, with the clearance
  Mover disc_;
  Steering steering_;
  bool uses_estimate_;
  SearchEffort effort_;
  std::vector<double> cost_;       ///< by cell; infinite: not reached
  std::vector<std::size_t> from_;  ///< by cell
  std::vector<std::size_t> touched_;
  std::vector<Open> open_;
  std::vector<double> last_;  ///< by cell: what is left from it to the goal; -1: not next to it
  std::size_t end_ = 0;
};

}  // namespace linewright
