#include "ompl_planners.hpp"

#ifdef LINEWRIGHT_HAS_OMPL

#include <ompl/base/objectives/PathLengthOptimizationObjective.h>
#include <ompl/base/spaces/ReedsSheppStateSpace.h>
#include <ompl/geometric/PathSimplifier.h>
#include <ompl/geometric/SimpleSetup.h>
#include <ompl/geometric/planners/informedtrees/BITstar.h>
#include <ompl/geometric/planners/rrt/RRTConnect.h>
#include <ompl/geometric/planners/rrt/RRTstar.h>
#include <ompl/util/Console.h>
#include <ompl/util/RandomNumbers.h>

#include "report.hpp"

namespace linewright::bench {
namespace {

namespace ob = ompl::base;
namespace og = ompl::geometric;
using Space = ob::ReedsSheppStateSpace;
using State = ob::SE2StateSpace::StateType;

Pose2 pose_of(const ob::State* state) {
  const auto* at = state->as<State>();
  return {at->getX(), at->getY(), at->getYaw()};
}

void set(ob::State* state, const Pose2& pose) {
  auto* at = state->as<State>();
  at->setXY(pose.x_m, pose.y_m);
  at->setYaw(pose.heading_rad);
}

std::shared_ptr<Space> space_of(const Case& c) {
  auto space = std::make_shared<Space>(c.mover.turning_radius_m);
  const GridFrame& frame = c.map->frame();
  ob::RealVectorBounds bounds(2);
  bounds.setLow(0.0);
  bounds.setHigh(0, frame.columns * frame.cell_m);
  bounds.setHigh(1, frame.rows * frame.cell_m);
  space->setBounds(bounds);
  return space;
}

ob::PlannerPtr planner_of(const std::string& name, const ob::SpaceInformationPtr& space) {
  if (name == "RRTConnect") return std::make_shared<og::RRTConnect>(space);
  if (name == "RRT*") return std::make_shared<og::RRTstar>(space);
  return std::make_shared<og::BITstar>(space);
}

}  // namespace

std::vector<std::string> ompl_planners() { return {"RRTConnect", "RRT*", "BIT*"}; }

std::optional<double> ompl_path_m(const std::string& planner, const Case& c, const Query& query,
                                  double seconds) {
  ompl::msg::setLogLevel(ompl::msg::LOG_NONE);
  ompl::RNG::setSeed(1);
  const auto space = space_of(c);
  og::SimpleSetup setup(space);
  const ob::SpaceInformationPtr& information = setup.getSpaceInformation();
  const CollisionChecker checker(c.map, c.mover.footprint.grown(PathPlannerOptions{}.clearance_m));
  setup.setStateValidityChecker([&](const ob::State* state) {
    return information->satisfiesBounds(state) && checker.free(pose_of(state));
  });
  information->setMotionValidator(std::make_shared<ob::ReedsSheppMotionValidator>(information));
  information->setStateValidityCheckingResolution(0.05 / space->getMaximumExtent());
  ob::ScopedState<Space> start(space);
  ob::ScopedState<Space> goal(space);
  set(start.get(), c.map->frame().to_grid(query.start));
  set(goal.get(), c.map->frame().to_grid(query.goal));
  setup.setStartAndGoalStates(start, goal, 1e-6);
  setup.setOptimizationObjective(
      std::make_shared<ob::PathLengthOptimizationObjective>(information));
  setup.setPlanner(planner_of(planner, information));
  setup.setup();
  const double end = cpu_s() + seconds;
  const ob::PlannerTerminationCondition time_up([end] { return cpu_s() >= end; });
  if (setup.solve(time_up) != ob::PlannerStatus::EXACT_SOLUTION) return std::nullopt;
  og::PathGeometric& path = setup.getSolutionPath();
  if (planner == "RRTConnect") og::PathSimplifier(information).simplify(path, time_up);
  return path.length();
}

bool ompl_lengths_m(const std::vector<Query>& pairs, double radius_m,
                    std::vector<double>& lengths) {
  const Space space(radius_m);
  ob::State* from = space.allocState();
  ob::State* to = space.allocState();
  for (const Query& pair : pairs) {
    set(from, pair.start);
    set(to, pair.goal);
    lengths.push_back(space.distance(from, to));
  }
  space.freeState(from);
  space.freeState(to);
  return true;
}

}  // namespace linewright::bench

#else

namespace linewright::bench {

std::vector<std::string> ompl_planners() { return {}; }

std::optional<double> ompl_path_m(const std::string&, const Case&, const Query&, double) {
  return std::nullopt;
}

bool ompl_lengths_m(const std::vector<Query>&, double, std::vector<double>&) { return false; }

}  // namespace linewright::bench

#endif
