#include "label_places.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>
#include <utility>

namespace linewright::labels {
namespace {

constexpr double kSquare = 3.0;    // pixels
constexpr double kLedFrom = 10.0;  // pixels between dot and name that need a line
constexpr double kNever = 1e6;
constexpr double kHidden = 3e3;   // a name or a dot under a name
constexpr double kMistaken = 60;  // a name beside another dot than its own
constexpr double kCrossed = 400;  // a name or a dot under a line

/// Directions of the name from the dot, in steps of a sixteenth of a turn from the right on; those
/// beside and in the corners read best.
constexpr int kDirections = 16;
constexpr std::array<double, kDirections> kWorse = {0, 2, 1, 3, 2, 3, 2, 3, 1, 3, 2, 3, 2, 3, 1, 2};
constexpr std::array<double, 9> kDistances = {3, 6, 13, 21, 30, 41, 54, 70, 90};

Place place_at(const Anchor& anchor, int direction, double distance) {
  const double angle = direction * 2.0 * std::numbers::pi / kDirections;
  const double dx = std::cos(angle);
  const double dy = std::sin(angle);
  const double x = anchor.x + dx * (anchor.dot + distance);
  const double y = anchor.y + dy * (anchor.dot + distance);
  // Its near side or corner lies there; straight above and below, its middle.
  const double side = std::clamp(dx * 1.5, -1.0, 1.0);
  const double rise = std::clamp(dy * 1.5, -1.0, 1.0);
  const double x0 = x - anchor.width * (1.0 - side) / 2.0;
  const double y0 = y - anchor.height * (1.0 - rise) / 2.0;
  Place place{.box = {x0, y0, x0 + anchor.width, y0 + anchor.height}};
  place.led = distance >= kLedFrom;
  place.to_x = std::clamp(anchor.x, x0 + 2.0, place.box.x1 - 2.0);
  place.to_y = std::clamp(anchor.y, y0, place.box.y1);
  const double length = std::max(1.0, std::hypot(place.to_x - anchor.x, place.to_y - anchor.y));
  place.x = anchor.x + (place.to_x - anchor.x) / length * anchor.dot;
  place.y = anchor.y + (place.to_y - anchor.y) / length * anchor.dot;
  return place;
}

template <typename Visit>
void walk(const Place& place, Visit visit) {
  const double length = std::hypot(place.to_x - place.x, place.to_y - place.y);
  const int steps = std::max(1, static_cast<int>(length / 2.0));
  for (int i = 0; i <= steps; ++i) {
    visit(place.x + (place.to_x - place.x) * i / steps,
          place.y + (place.to_y - place.y) * i / steps);
  }
}

bool crosses(const Place& place, const Box& box) {
  const Box around{std::min(place.x, place.to_x) - 0.5, std::min(place.y, place.to_y) - 0.5,
                   std::max(place.x, place.to_x) + 0.5, std::max(place.y, place.to_y) + 0.5};
  if (!around.meets(box)) return false;
  bool crossed = false;
  walk(place, [&](double x, double y) {
    crossed = crossed || box.meets({x - 0.5, y - 0.5, x + 0.5, y + 0.5});
  });
  return crossed;
}

/// Whether the lines of two places cross.
bool tangled(const Place& a, const Place& b) {
  const auto side = [](const Place& line, double x, double y) {
    return (line.to_x - line.x) * (y - line.y) - (line.to_y - line.y) * (x - line.x) > 0.0;
  };
  return a.led && b.led && side(a, b.x, b.y) != side(a, b.to_x, b.to_y) &&
         side(b, a.x, a.y) != side(b, a.to_x, a.to_y);
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

float Placer::drawn_at(double x, double y) const {
  return drawn_[static_cast<std::size_t>(y / kSquare) * columns_ +
                static_cast<std::size_t>(x / kSquare)];
}

double Placer::covered(const Box& box) const {
  double sum = 0.0;
  for (double y = box.y0; y <= box.y1; y += kSquare) {
    for (double x = box.x0; x <= box.x1; x += kSquare) sum += static_cast<double>(drawn_at(x, y));
  }
  return sum;
}

bool Placer::outside(const Box& box) const {
  return box.x0 < 0.0 || box.y0 < 0.0 || box.x1 > width_ || box.y1 > height_;
}

double Placer::cost_of_line(const Place& place, std::size_t self) const {
  double sum = 6.0;
  walk(place, [&](double x, double y) {
    const bool inside = x >= 0.0 && y >= 0.0 && x <= width_ && y <= height_;
    if (inside) sum += 0.8 * static_cast<double>(drawn_at(x, y));
  });
  for (std::size_t i = 0; i < dots_.size(); ++i) {
    if (i == self) continue;
    if (crosses(place, dots_[i])) sum += kCrossed;
    if (places_[i] && crosses(place, places_[i]->box)) sum += kCrossed;
  }
  return sum;
}

double Placer::cost(const Place& place, double distance, std::size_t self) const {
  const Box& box = place.box;
  if (outside(box)) return kNever;
  double sum = 0.2 * distance + 3.0 * covered(box);
  if (place.led) sum += cost_of_line(place, self);
  for (const Box& blocked : blocked_) sum += blocked.meets(box) ? kHidden : 0.0;
  for (std::size_t i = 0; i < dots_.size(); ++i) {
    if (dots_[i].meets(box)) sum += kHidden;
    if (i == self) continue;
    const Box near{box.x0 - 7.0, box.y0 - 7.0, box.x1 + 7.0, box.y1 + 7.0};
    if (dots_[i].meets(near)) sum += place.led ? kMistaken / 2.0 : kMistaken;
    if (!places_[i]) continue;
    // Two names need a little air between them.
    const Box airy{box.x0 - 5.0, box.y0 - 1.0, box.x1 + 5.0, box.y1 + 1.0};
    if (places_[i]->box.meets(airy)) sum += kHidden;
    if (places_[i]->led && crosses(*places_[i], box)) sum += kCrossed;
    if (tangled(place, *places_[i])) sum += kCrossed;
  }
  return sum;
}

double Placer::choose(const std::vector<Anchor>& anchors, std::size_t i) {
  double least = kNever * 2.0;
  std::optional<Place> best;
  for (const double distance : kDistances) {
    for (int direction = 0; direction < kDirections; ++direction) {
      const Place place = place_at(anchors[i], direction, distance);
      const double value = cost(place, distance, i) + kWorse[static_cast<std::size_t>(direction)];
      if (value >= least) continue;
      least = value;
      best = place;
    }
  }
  places_[i] = best;
  return least;
}

double Placer::arrange_in(const std::vector<Anchor>& anchors,
                          const std::vector<std::size_t>& order) {
  constexpr int kRounds = 5;  // later ones know where all the others are
  places_.assign(anchors.size(), std::nullopt);
  double sum = 0.0;
  for (int round = 0; round < kRounds; ++round) {
    sum = 0.0;
    for (const std::size_t i : order) sum += choose(anchors, i);
  }
  return sum;
}

void Placer::arrange(const std::vector<Anchor>& anchors) {
  // Each order ends with an arrangement that no single name can better; the best of several.
  constexpr std::size_t kManyNames = 40;
  std::vector<std::size_t> order = order_of(anchors);
  const std::size_t orders =
      anchors.size() > kManyNames ? 1 : std::min<std::size_t>(8, 2 * anchors.size());
  double least = 0.0;
  std::vector<std::optional<Place>> best;
  for (std::size_t turn = 0; turn < orders; ++turn) {
    const double sum = arrange_in(anchors, order);
    if (turn == 0 || sum < least) {
      least = sum;
      best = places_;
    }
    if (turn % 2 == 0) {
      std::reverse(order.begin(), order.end());
    } else {
      std::rotate(order.begin(), order.begin() + 1, order.end());
    }
  }
  places_ = std::move(best);
}

std::vector<Place> Placer::place(const std::vector<Anchor>& anchors) {
  for (const Anchor& a : anchors) {
    dots_.push_back({a.x - a.dot, a.y - a.dot, a.x + a.dot, a.y + a.dot});
  }
  arrange(anchors);
  std::vector<Place> places;
  for (const auto& place : places_) places.push_back(*place);
  for (const Place& place : places) taken_.push_back(place.box);
  taken_.insert(taken_.end(), dots_.begin(), dots_.end());
  taken_.insert(taken_.end(), blocked_.begin(), blocked_.end());
  return places;
}

bool Placer::take(const Box& box) {
  if (outside(box)) return false;
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
