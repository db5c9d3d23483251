#include "linewright/routing/hybrid_a_star.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "directed_search.hpp"
#include "smoothing.hpp"

namespace linewright {
namespace {

using Outcome = DirectedSearch::Outcome;

/// Expansions after which a search is no longer an easy one, and is helped from the other end.
constexpr std::size_t kAlone = 50'000;

/// How long one direction goes on when the other one has nothing left after `exhausted` expansions.
/// Then the way out of one end is as good as closed; but since the two tell poses apart in other
/// cells, one may get through a gap that the other one does not see.
constexpr std::size_t last_try(std::size_t exhausted) { return 4 * exhausted + kAlone; }

}  // namespace

class HybridAStar::Search {
 public:
  Search(std::shared_ptr<const ClearanceMap> map, const Mover& mover,
         const PathPlannerOptions& options)
      : tools_(std::move(map), mover, options), forwards_(tools_, false) {}

  Path plan(const Pose2& start_in_map, const Pose2& goal_in_map) {
    effort_ = {};
    const GridFrame& frame = tools_.map->frame();
    Path path = plan_in_grid(frame.to_grid(start_in_map), frame.to_grid(goal_in_map));
    path.start = start_in_map;
    return path;
  }

  [[nodiscard]] SearchEffort effort() const { return effort_; }
  void use(std::shared_ptr<GoalDistance> distance) { forwards_.use(std::move(distance)); }
  [[nodiscard]] std::shared_ptr<GoalDistance> distance() const { return forwards_.distance(); }

 private:
  Path plan_in_grid(const Pose2& start, const Pose2& goal) {
    Path path;
    path.turning_radius_m = tools_.steering.turning_radius_m();
    path.status = PathStatus::kStartOccupied;
    if (!tools_.checker.free(start)) return path;
    path.status = PathStatus::kGoalOccupied;
    if (!tools_.checker.free(goal)) return path;
    path.status = search(start, goal, path);
    if (!path.found()) return path;
    smooth(path, tools_.steering, tools_.options.smoothing_passes);
    if (tools_.steering.ignores_heading()) take_short_turns(path);
    return path;
  }

  PathStatus search(const Pose2& start, const Pose2& goal, Path& path) {
    if (!forwards_.begin(start, goal)) return PathStatus::kNoAisle;
    const std::size_t most = tools_.options.most_expansions;
    const Outcome outcome = forwards_.run(std::min(kAlone, most));
    const PathStatus status = outcome == Outcome::kFound
                                  ? taken(forwards_, path)
                                  : search_from_both_ends(start, goal, outcome, path);
    effort_.expansions += forwards_.expansions();
    effort_.connections += forwards_.connections();
    return status;
  }

  static PathStatus taken(DirectedSearch& search, Path& path) {
    path = search.take_path();
    return PathStatus::kFound;
  }

  /// In turns, each as long as the other. What can be reached does not depend on which of the two
  /// places is the start: the same two searches are run as far in both cases.
  PathStatus search_from_both_ends(const Pose2& start, const Pose2& goal, Outcome forwards,
                                   Path& path) {
    if (!backwards_) backwards_.emplace(tools_, true);
    DirectedSearch& other = *backwards_;
    Outcome backwards = other.begin(start, goal) ? Outcome::kPaused : Outcome::kExhausted;
    const std::size_t most = tools_.options.most_expansions;
    const auto go_on = [&](DirectedSearch& search, Outcome& outcome, std::size_t until) {
      if (outcome == Outcome::kPaused) outcome = search.run(std::min(until, most));
      return outcome == Outcome::kFound;
    };
    bool found_forwards = false;
    bool found_backwards = false;
    for (std::size_t until = kAlone;; until *= 2) {
      if (forwards == Outcome::kExhausted) {
        found_backwards = go_on(other, backwards, last_try(forwards_.expansions()));
        break;
      }
      if (go_on(other, backwards, until)) found_backwards = true;
      if (found_backwards) break;
      if (backwards == Outcome::kExhausted) {
        found_forwards = go_on(forwards_, forwards, last_try(other.expansions()));
        break;
      }
      if (until >= most) break;
      found_forwards = go_on(forwards_, forwards, 2 * until);
      if (found_forwards) break;
    }
    effort_.expansions += other.expansions();
    effort_.connections += other.connections();
    if (found_forwards) return taken(forwards_, path);
    if (found_backwards) return taken(other, path);
    const bool closed = forwards == Outcome::kExhausted || backwards == Outcome::kExhausted;
    return closed ? PathStatus::kNoManoeuvre : PathStatus::kSearchLimit;
  }

  SearchTools tools_;
  DirectedSearch forwards_;
  std::optional<DirectedSearch> backwards_;  ///< made when first needed
  SearchEffort effort_;
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
