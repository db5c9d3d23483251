#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "routes_view.hpp"

namespace linewright::hall {

/// Who stands at one place is drawn side by side.
class Crowd {
 public:
  /// The nearest free spot, the place itself if it is free.
  [[nodiscard]] routes::Pixel spot(routes::Pixel at, double radius) {
    constexpr double kAir = 2.0;           // between two, pixels
    constexpr std::size_t kCrowded = 600;  // more would hide the hall, and take long to arrange
    if (taken_.size() >= kCrowded) return at;
    constexpr int kRings = 6;
    constexpr int kDirections = 8;
    for (int ring = 0; ring <= kRings; ++ring) {
      for (int direction = 0; direction < (ring == 0 ? 1 : kDirections); ++direction) {
        const double angle = direction * std::numbers::pi / 4.0;
        const double reach = ring * (2.0 * radius + kAir);
        const routes::Pixel there{at.x + reach * std::cos(angle), at.y + reach * std::sin(angle)};
        if (free(there, radius)) return take(there, radius);
      }
    }
    return take(at, radius);
  }

 private:
  struct Disc {
    routes::Pixel at;
    double radius = 0.0;
  };
  [[nodiscard]] bool free(routes::Pixel at, double radius) const {
    return std::none_of(taken_.begin(), taken_.end(), [&](const Disc& other) {
      return std::hypot(other.at.x - at.x, other.at.y - at.y) < other.radius + radius;
    });
  }
  routes::Pixel take(routes::Pixel at, double radius) {
    taken_.push_back({at, radius});
    return at;
  }

  std::vector<Disc> taken_;
};

}  // namespace linewright::hall
