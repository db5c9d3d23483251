#include "route_times.hpp"

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <mutex>
#include <thread>
#include <vector>

#include "common.hpp"
#include "linewright/base/diagnostic.hpp"
#include "linewright/base/files.hpp"
#include "linewright/routing/route_cache.hpp"

namespace linewright::cli {
namespace {

constexpr std::size_t kReadings = 9;

template <typename Work>
double milliseconds_of(Work work) {
  using Clock = std::chrono::steady_clock;
  const Clock::time_point begin = Clock::now();
  work();
  return std::chrono::duration<double, std::milli>(Clock::now() - begin).count();
}

/// A folder that is gone at the end.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::error_code error;
    std::string name = (std::filesystem::temp_directory_path(error) / "linewright_XXXXXX").string();
    if (error || mkdtemp(name.data()) == nullptr) {
      throw ScenarioError(name, "cannot be made, to measure reading from a file",
                          "set TMPDIR to a folder that you may write to");
    }
    path_ = name;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  [[nodiscard]] std::string file(const char* name) const { return (path_ / name).string(); }

 private:
  std::filesystem::path path_;
};

struct Subject {
  std::vector<RouteRequest> requests;
  std::vector<RouteTable> tables;
};

Subject subject_of(const Scenario& scenario) {
  Subject subject;
  for (const auto& kind : scenario.routes) {
    if (!kind) continue;
    subject.requests.push_back(kind->request);
    subject.tables.push_back(kind->routes);
  }
  return subject;
}

std::vector<RouteTable> planned(const OccupancyGrid& grid,
                                const std::vector<RouteRequest>& requests, std::size_t threads) {
  ProgressBar bar("routes, timed");
  std::mutex drawing;
  RouteBuildOptions options{.threads = threads, .cancel = &interrupted()};
  options.progress = [&](std::size_t done, std::size_t total) {
    const std::scoped_lock lock(drawing);
    bar.update(done, total);
  };
  return build_route_tables(std::make_shared<const ClearanceMap>(grid), requests, options);
}

double median_reading_ms(const OccupancyGrid& grid, const std::vector<RouteRequest>& requests,
                         const std::string& bytes) {
  const TemporaryFolder folder;
  const std::string file = folder.file("cache.routes");
  write_file(file, bytes);
  std::vector<double> times;
  for (std::size_t i = 0; i < kReadings; ++i) {
    bool usable = false;
    times.push_back(milliseconds_of([&] {
      std::string why;
      const std::uint64_t key = route_key(grid, requests);
      const auto read = read_file(file, bytes.size(), why);
      usable = read && decode_routes(*read, key, requests).usable();
    }));
    if (!usable) throw std::logic_error("routes just written cannot be read");
  }
  std::nth_element(times.begin(), times.begin() + kReadings / 2, times.end());
  return times[kReadings / 2];
}

}  // namespace

std::optional<RouteTimes> time_routes(const Scenario& scenario, std::size_t threads) {
  const OccupancyGrid& grid = *scenario.map->grid;
  const Subject subject = subject_of(scenario);
  RouteTimes times{.readings = kReadings};
  times.threads = threads != 0 ? threads : std::max(1U, std::thread::hardware_concurrency());
  std::vector<RouteTable> tables;
  times.cold_ms = milliseconds_of([&] { tables = planned(grid, subject.requests, threads); });
  if (interrupted().requested()) return std::nullopt;
  const std::uint64_t key = route_key(grid, subject.requests);
  const std::string bytes = encode_routes(tables, key);
  if (bytes != encode_routes(subject.tables, key)) {
    report(scenario.file +
           ".routes: the routes stored there are not those that are planned now; remove the file");
  }
  times.bytes = bytes.size();
  times.cached_ms = median_reading_ms(grid, subject.requests, bytes);
  return times;
}

}  // namespace linewright::cli
