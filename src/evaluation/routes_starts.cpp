#include <algorithm>
#include <cmath>

#include "linewright/evaluation/routes_svg.hpp"

namespace linewright {
namespace {

/// Mean and standard deviation of the routes from a stop, added up: long and varied is much.
double interest_m(const RouteTable& routes, std::size_t from) {
  const auto others = static_cast<double>(std::max<std::size_t>(routes.stops(), 2) - 1);
  double sum = 0.0;
  double squares = 0.0;
  for (std::size_t to = 0; to < routes.stops(); ++to) {
    const double metres = routes.path(from, to).found() ? routes.path(from, to).metres() : 0.0;
    sum += metres;
    squares += metres * metres;
  }
  const double mean = sum / others;
  return mean + std::sqrt(std::max(0.0, squares / others - mean * mean));
}

void add_panels(const RouteTable& routes, std::size_t kind, std::vector<RoutesPanel>& panels) {
  if (routes.stops() == 1) panels.push_back({kind, 0});
  if (routes.stops() < 2) return;
  std::vector<double> interest;
  for (std::size_t i = 0; i < routes.stops(); ++i) interest.push_back(interest_m(routes, i));
  std::size_t first = 0;
  std::size_t second = 1;
  double best = -1.0;
  for (std::size_t a = 0; a < routes.stops(); ++a) {
    for (std::size_t b = a + 1; b < routes.stops(); ++b) {
      const Path& between = routes.path(a, b);
      const double value = interest[a] + interest[b] + (between.found() ? between.metres() : 0.0);
      if (value <= best) continue;
      best = value;
      first = a;
      second = b;
    }
  }
  panels.push_back({kind, first});
  panels.push_back({kind, second});
}

}  // namespace

std::vector<RoutesPanel> showcase_panels(const Scenario& scenario) {
  std::vector<RoutesPanel> panels;
  for (std::size_t kind = 0; kind < scenario.routes.size(); ++kind) {
    if (scenario.routes[kind]) add_panels(scenario.routes[kind]->routes, kind, panels);
  }
  return panels;
}

}  // namespace linewright
