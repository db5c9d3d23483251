#include "label_places.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <utility>

namespace linewright::labels {
namespace {

constexpr double kSquare = 3.0;    // pixels
constexpr double kLedFrom = 10.0;  // pixels between dot and name that need a line
constexpr double kNever = 1e6;
constexpr double kHidden = 3e3;   // a name or a dot under a name
constexpr double kCrossed = 400;  // a name or a dot under a line

/// Directions of the name from the dot: x and y in -1 ... 1, and how much worse than the first.
struct Direction {
  double x;
  double y;
  double worse;
};
constexpr std::array<Direction, 12> kDirections = {{{1, 0, 0},
                                                    {-1, 0, 1},
                                                    {0, -1, 2},
                                                    {0, 1, 2},
                                                    {1, -1, 1},
                                                    {1, 1, 1},
                                                    {-1, -1, 2},
                                                    {-1, 1, 2},
                                                    {0.4, -1, 3},
                                                    {0.4, 1, 3},
                                                    {-0.4, -1, 3},
                                                    {-0.4, 1, 3}}};
constexpr std::array<double, 8> kDistances = {3, 7, 14, 24, 36, 50, 66, 86};

Place place_at(const Anchor& anchor, double dot, const Direction& direction, double distance) {
  const double length = std::hypot(direction.x, direction.y);
  const double x = anchor.x + direction.x / length * (dot + distance);
  const double y = anchor.y + direction.y / length * (dot + distance);
  const double side = std::clamp(direction.x * 1.01, -1.0, 1.0);
  const double x0 = x - anchor.width * (1.0 - side) / 2.0;
  const double y0 = y - anchor.height * (1.0 - direction.y) / 2.0;
  Place place{.box = {x0, y0, x0 + anchor.width, y0 + anchor.height}};
  place.led = distance >= kLedFrom;
  place.x = anchor.x + direction.x / length * dot;
  place.y = anchor.y + direction.y / length * dot;
  place.to_x = std::clamp(anchor.x, place.box.x0, place.box.x1);
  place.to_y = std::clamp(anchor.y, place.box.y0, place.box.y1);
  return place;
}

bool crosses(const Place& place, const Box& box) {
  const double length = std::hypot(place.to_x - place.x, place.to_y - place.y);
  const int steps = std::max(1, static_cast<int>(length / 2.0));
  for (int i = 0; i <= steps; ++i) {
    const double x = place.x + (place.to_x - place.x) * i / steps;
    const double y = place.y + (place.to_y - place.y) * i / steps;
    if (box.meets({x, y, x + 0.01, y + 0.01})) return true;
  }
  return false;
}

/// The most crowded first: they have the least choice.
std::vector<std::size_t> order_of(const std::vector<Anchor>& anchors) {
  constexpr double kNear = 60.0;
  std::vector<int> neighbours;
  for (const Anchor& a : anchors) {
    neighbours.push_back(
        static_cast<int>(std::count_if(anchors.begin(), anchors.end(), [&](const Anchor& b) {
          return std::abs(a.x - b.x) < a.width + kNear && std::abs(a.y - b.y) < kNear;
        })));
  }
  std::vector<std::size_t> order(anchors.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return neighbours[a] > neighbours[b]; });
  return order;
}

}  // namespace

Placer::Placer(double width, double height)
    : width_(width),
      height_(height),
      columns_(static_cast<std::size_t>(std::ceil(width / kSquare)) + 1),
      rows_(static_cast<std::size_t>(std::ceil(height / kSquare)) + 1),
      drawn_(columns_ * rows_) {}

void Placer::discourage(double x, double y, double weight) {
  if (!(x >= 0.0 && y >= 0.0 && x <= width_ && y <= height_)) return;
  const auto column = static_cast<std::size_t>(x / kSquare);
  const auto row = static_cast<std::size_t>(y / kSquare);
  float& value = drawn_[row * columns_ + column];
  value = std::max(value, static_cast<float>(weight));
}

void Placer::discourage(const Box& box, double weight) {
  const double x1 = std::min(box.x1, width_);
  const double y1 = std::min(box.y1, height_);
  for (double y = std::max(0.0, box.y0); y <= y1; y += kSquare) {
    for (double x = std::max(0.0, box.x0); x <= x1; x += kSquare) discourage(x, y, weight);
  }
}

double Placer::covered(const Box& box) const {
  double sum = 0.0;
  for (double y = box.y0; y <= box.y1; y += kSquare) {
    for (double x = box.x0; x <= box.x1; x += kSquare) {
      sum += static_cast<double>(drawn_[static_cast<std::size_t>(y / kSquare) * columns_ +
                                        static_cast<std::size_t>(x / kSquare)]);
    }
  }
  return sum;
}

double Placer::cost(const Place& place, double distance, std::size_t self) const {
  const Box& box = place.box;
  if (box.x0 < 0.0 || box.y0 < 0.0 || box.x1 > width_ || box.y1 > height_) return kNever;
  double sum = 0.25 * distance + covered(box);
  for (std::size_t i = 0; i < dots_.size(); ++i) {
    if (dots_[i].meets(box)) sum += kHidden;
    if (i == self) continue;
    if (place.led && crosses(place, dots_[i])) sum += kCrossed;
    if (!places_[i]) continue;
    const Box& other = places_[i]->box;
    // Two names need a little air between them.
    if (other.meets({box.x0 - 4.0, box.y0 - 1.0, box.x1 + 4.0, box.y1 + 1.0})) sum += kHidden;
    if (place.led && crosses(place, other)) sum += kCrossed;
    if (places_[i]->led && crosses(*places_[i], box)) sum += kCrossed;
  }
  return sum;
}

void Placer::choose(const std::vector<Anchor>& anchors, double dot, std::size_t i) {
  double least = kNever * 2.0;
  std::optional<Place> best;
  for (const double distance : kDistances) {
    for (const Direction& direction : kDirections) {
      const Place place = place_at(anchors[i], dot, direction, distance);
      const double value = cost(place, distance, i) + direction.worse;
      if (value >= least) continue;
      least = value;
      best = place;
    }
  }
  places_[i] = best;
}

std::vector<Place> Placer::place(const std::vector<Anchor>& anchors, double dot) {
  for (const Anchor& a : anchors) {
    dots_.push_back({a.x - dot, a.y - dot, a.x + dot, a.y + dot});
  }
  places_.assign(anchors.size(), std::nullopt);
  constexpr int kRounds = 3;  // later ones know where all the others are
  const std::vector<std::size_t> order = order_of(anchors);
  for (int round = 0; round < kRounds; ++round) {
    for (const std::size_t i : order) choose(anchors, dot, i);
  }
  std::vector<Place> places;
  for (const auto& place : places_) places.push_back(*place);
  for (const Place& place : places) taken_.push_back(place.box);
  taken_.insert(taken_.end(), dots_.begin(), dots_.end());
  return places;
}

bool Placer::take(const Box& box) {
  if (box.x0 < 0.0 || box.y0 < 0.0 || box.x1 > width_ || box.y1 > height_) return false;
  for (const Box& other : taken_) {
    if (other.meets(box)) return false;
  }
  for (const auto& place : places_) {
    if (place->led && crosses(*place, box)) return false;
  }
  taken_.push_back(box);
  return true;
}

}  // namespace linewright::labels
