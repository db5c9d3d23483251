#include "linewright/routing/route_table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <thread>
#include <utility>

namespace linewright {
namespace {

/// All ways of one kind to one goal: what one thread does in one go.
struct Job {
  std::size_t request;
  std::size_t goal;
};

/// Hands out jobs to threads and collects the paths, each in its own place.
class Builder {
 public:
  Builder(const std::shared_ptr<const ClearanceMap>& map, const std::vector<RouteRequest>& requests,
          const RouteBuildOptions& options)
      : map_(map), requests_(requests), options_(options) {
    for (std::size_t r = 0; r < requests.size(); ++r) {
      tables_.emplace_back(requests[r].stops.size());
      total_ += tables_[r].pairs();
      for (std::size_t goal = 0; goal < requests[r].stops.size(); ++goal)
        jobs_.push_back({r, goal});
    }
  }

  std::vector<RouteTable> run() {
    std::size_t threads =
        options_.threads == 0 ? std::thread::hardware_concurrency() : options_.threads;
    threads = std::clamp<std::size_t>(threads, 1, std::max<std::size_t>(1, jobs_.size()));
    {
      std::vector<std::jthread> others;  // joined at the end of this block, whatever happens
      for (std::size_t t = 1; t < threads; ++t) others.emplace_back([this] { work_safely(); });
      work_safely();
    }
    if (failure_) std::rethrow_exception(failure_);
    return std::move(tables_);
  }

 private:
  /// The first failure of any thread stops all of them and is thrown again by run().
  void work_safely() {
    try {
      work();
    } catch (...) {
      const std::scoped_lock lock(failure_mutex_);
      if (!failure_) failure_ = std::current_exception();
      next_ = jobs_.size();
    }
  }

  void work() {
    std::vector<std::unique_ptr<PathPlanner>> planners(requests_.size());
    for (std::size_t i = next_++; i < jobs_.size(); i = next_++) {
      auto& planner = planners[jobs_[i].request];
      const RouteRequest& request = requests_[jobs_[i].request];
      if (!planner) {
        PathPlannerOptions options = request.options;
        options.cancel = options_.cancel;
        options.most_expansions = std::min(options.most_expansions, options_.most_expansions);
        planner = make_path_planner(request.planner, map_, request.mover, options);
      }
      plan_to(jobs_[i], *planner);
    }
  }

  void plan_to(const Job& job, PathPlanner& planner) {
    const std::vector<RouteStop>& stops = requests_[job.request].stops;
    for (std::size_t from = 0; from < stops.size(); ++from) {
      Path path;
      path.start = stops[from].pose;
      if (from == job.goal) {
        path.status = PathStatus::kFound;
      } else if (stopped()) {
        path.status = PathStatus::kSearchLimit;
      } else {
        path = planner.plan(stops[from].pose, stops[job.goal].pose);
        expansions_ += planner.effort().expansions;
        const std::size_t done = ++done_;
        if (options_.progress) options_.progress(done, total_);
      }
      tables_[job.request].set(from, job.goal, std::move(path));
    }
  }

  [[nodiscard]] bool stopped() const {
    return (options_.cancel != nullptr && options_.cancel->requested()) ||
           expansions_ >= options_.most_expansions;
  }

  const std::shared_ptr<const ClearanceMap>& map_;
  const std::vector<RouteRequest>& requests_;
  const RouteBuildOptions& options_;
  std::vector<RouteTable> tables_;
  std::vector<Job> jobs_;
  std::size_t total_ = 0;
  std::exception_ptr failure_;
  std::mutex failure_mutex_;
  std::atomic<std::size_t> next_{0};
  std::atomic<std::size_t> done_{0};
  std::atomic<std::size_t> expansions_{0};
};

}  // namespace

std::size_t RouteTable::failed() const {
  return static_cast<std::size_t>(
      std::count_if(paths_.begin(), paths_.end(), [](const Path& p) { return !p.found(); }));
}

std::vector<RouteTable> build_route_tables(const std::shared_ptr<const ClearanceMap>& map,
                                           const std::vector<RouteRequest>& requests,
                                           const RouteBuildOptions& options) {
  return Builder(map, requests, options).run();
}

std::string explain_missing(const RouteRequest& request, std::size_t from, std::size_t to,
                            PathStatus status) {
  const RouteStop& a = request.stops[from];
  const RouteStop& b = request.stops[to];
  const auto occupied = [&](const RouteStop& stop) {
    return fmt::format("'{}' collides at '{}' ({:.2f}, {:.2f})", request.kind, stop.name,
                       stop.pose.x_m, stop.pose.y_m);
  };
  switch (status) {
    case PathStatus::kFound:
      return {};
    case PathStatus::kStartOccupied:
      return occupied(a);
    case PathStatus::kGoalOccupied:
      return occupied(b);
    case PathStatus::kNoAisle:
      return fmt::format("every aisle from '{}' to '{}' is blocked or narrower than {:.2f} m",
                         a.name, b.name, 2.0 * request.mover.footprint.inscribed_m());
    case PathStatus::kNoManoeuvre:
      if (request.mover.turning_radius_m <= 0.0) {
        return fmt::format("every aisle from '{}' to '{}' is too narrow for this footprint", a.name,
                           b.name);
      }
      return fmt::format(
          "from '{}' to '{}' there are aisles wide enough, but no room to turn in with a turning "
          "radius of {:.2f} m and this footprint",
          a.name, b.name, request.mover.turning_radius_m);
    case PathStatus::kSearchLimit:
      return fmt::format("the search from '{}' to '{}' was given up after {} expansions", a.name,
                         b.name, request.options.most_expansions);
  }
  return {};
}

}  // namespace linewright
