#include "linewright/routing/reeds_shepp.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace linewright {
namespace {

using Kind = PathSegment::Kind;

constexpr double kPi = std::numbers::pi;
constexpr double kHalfPi = kPi / 2;
/// Lengths (in turning radii) that are zero but for rounding.
constexpr double kZero = 1e-10;

/// Angle in [-pi, pi].
double normal(double angle) { return std::remainder(angle, 2 * kPi); }

/// The pose to reach, in units of the turning radius, seen from the start; maybe mirrored.
struct Target {
  double x, y, phi, sin_phi, cos_phi;
};

/// Lengths t, u, v of the three pieces that a formula leaves open.
struct Lengths {
  double t = 0, u = 0, v = 0;
  bool valid = false;
};

struct Polar {
  double r, theta;
};
Polar polar(double x, double y) { return {std::sqrt(x * x + y * y), std::atan2(y, x)}; }

// The numbers are those of the formulas in the paper.

Lengths formula_8_1(const Target& to) {  // L+ S+ L+
  const auto [u, t] = polar(to.x - to.sin_phi, to.y - 1.0 + to.cos_phi);
  if (t < -kZero) return {};
  const double v = normal(to.phi - t);
  return {t, u, v, v >= -kZero};
}

Lengths formula_8_2(const Target& to) {  // L+ S+ R+
  const double x = to.x + to.sin_phi;
  const double y = to.y - 1.0 - to.cos_phi;
  const double squared = x * x + y * y;
  if (squared < 4.0) return {};
  const double u = std::sqrt(squared - 4.0);
  const double t = normal(std::atan2(y, x) + std::atan2(2.0, u));
  const double v = normal(t - to.phi);
  return {t, u, v, t >= -kZero && v >= -kZero};
}

Lengths formula_8_3(const Target& to) {  // L+ R- L+ (and with the last piece backwards)
  const double x = to.x - to.sin_phi;
  const double y = to.y - 1.0 + to.cos_phi;
  const double squared = x * x + y * y;
  if (squared > 16.0) return {};
  const double u = -2.0 * std::asin(0.25 * std::sqrt(squared));
  const double t = normal(std::atan2(y, x) + 0.5 * u + kPi);
  const double v = normal(to.phi - t + u);
  return {t, u, v, t >= -kZero && u <= kZero};
}

/// Outer lengths of the four-arc words, given the inner ones.
Lengths outer(double u, double v, double x, double y, double phi) {
  const double delta = normal(u - v);
  const double a = std::sin(u) - std::sin(delta);
  const double b = std::cos(u) - std::cos(delta) - 1.0;
  const double angle = std::atan2(y * a - x * b, x * a + y * b);
  const bool other = 2.0 * (std::cos(delta) - std::cos(v) - std::cos(u)) + 3.0 < 0.0;
  const double t = normal(other ? angle + kPi : angle);
  return {t, u, normal(t - u + v - phi), true};
}

Lengths formula_8_7(const Target& to) {  // L+ Ru+ Lu- R-
  const double x = to.x + to.sin_phi;
  const double y = to.y - 1.0 - to.cos_phi;
  const double rho = 0.25 * (2.0 + std::sqrt(x * x + y * y));
  if (rho > 1.0) return {};
  const double u = std::acos(rho);
  Lengths found = outer(u, -u, x, y, to.phi);
  found.valid = found.t >= -kZero && found.v <= kZero;
  return found;
}

Lengths formula_8_8(const Target& to) {  // L+ Ru- Lu- R+
  const double x = to.x + to.sin_phi;
  const double y = to.y - 1.0 - to.cos_phi;
  const double rho = (20.0 - x * x - y * y) / 16.0;
  if (rho < 0.0 || rho > 1.0) return {};
  const double u = -std::acos(rho);
  Lengths found = outer(u, u, x, y, to.phi);
  found.valid = found.t >= -kZero && found.v >= -kZero;
  return found;
}

Lengths formula_8_9(const Target& to) {  // L+ R(pi/2)- S- L-
  const double x = to.x - to.sin_phi;
  const double y = to.y - 1.0 + to.cos_phi;
  const double squared = x * x + y * y;
  if (squared < 4.0) return {};
  const double r = std::sqrt(squared - 4.0);
  const double t = normal(std::atan2(y, x) + std::atan2(r, -2.0));
  const double v = normal(to.phi - kHalfPi - t);
  return {t, 2.0 - r, v, t >= -kZero && 2.0 - r <= kZero && v <= kZero};
}

Lengths formula_8_10(const Target& to) {  // L+ R(pi/2)- S- R-
  const double x = to.x + to.sin_phi;
  const double y = to.y - 1.0 - to.cos_phi;
  const auto [rho, theta] = polar(-y, x);
  if (rho < 2.0) return {};
  const double v = normal(theta + kHalfPi - to.phi);
  return {theta, 2.0 - rho, v, theta >= -kZero && v <= kZero};
}

Lengths formula_8_11(const Target& to) {  // L+ R(pi/2)- S- L(pi/2)- R+
  const double x = to.x + to.sin_phi;
  const double y = to.y - 1.0 - to.cos_phi;
  const double squared = x * x + y * y;
  if (squared < 4.0) return {};
  const double u = 4.0 - std::sqrt(squared - 4.0);
  if (u > kZero) return {};
  const double t = normal(std::atan2((4.0 - u) * x - 2.0 * y, -2.0 * x + (u - 4.0) * y));
  const double v = normal(t - to.phi);
  return {t, u, v, t >= -kZero && v >= -kZero};
}

constexpr Kind kL = Kind::kLeft;
constexpr Kind kR = Kind::kRight;
constexpr Kind kS = Kind::kStraight;

/// A formula, the kinds of its pieces, and how their lengths follow from t, u and v.
struct Pattern {
  Lengths (*formula)(const Target&);
  std::uint8_t count;
  std::array<Kind, 5> kinds;
  std::array<double, 5> (*lengths)(const Lengths&);
  bool backwards;  ///< also holds from the end to the start
};

using Five = std::array<double, 5>;

const std::array<Pattern, 8> kPatterns{{
    {formula_8_1,
     3,
     {kL, kS, kL},
     [](const Lengths& l) {
       return Five{l.t, l.u, l.v};
     },
     false},
    {formula_8_2,
     3,
     {kL, kS, kR},
     [](const Lengths& l) {
       return Five{l.t, l.u, l.v};
     },
     false},
    {formula_8_3,
     3,
     {kL, kR, kL},
     [](const Lengths& l) {
       return Five{l.t, l.u, l.v};
     },
     true},
    {formula_8_7,
     4,
     {kL, kR, kL, kR},
     [](const Lengths& l) {
       return Five{l.t, l.u, -l.u, l.v};
     },
     false},
    {formula_8_8,
     4,
     {kL, kR, kL, kR},
     [](const Lengths& l) {
       return Five{l.t, l.u, l.u, l.v};
     },
     false},
    {formula_8_9,
     4,
     {kL, kR, kS, kL},
     [](const Lengths& l) {
       return Five{l.t, -kHalfPi, l.u, l.v};
     },
     true},
    {formula_8_10,
     4,
     {kL, kR, kS, kR},
     [](const Lengths& l) {
       return Five{l.t, -kHalfPi, l.u, l.v};
     },
     true},
    {formula_8_11,
     5,
     {kL, kR, kS, kL, kR},
     [](const Lengths& l) {
       return Five{l.t, -kHalfPi, l.u, -kHalfPi, l.v};
     },
     false},
}};

/// The four ways to mirror a word: drive it backwards, and swap left and right.
struct Mirror {
  bool flipped, reflected;
};
constexpr std::array<Mirror, 4> kMirrors{
    {{false, false}, {true, false}, {false, true}, {true, true}}};

Target mirrored(const Target& to, Mirror mirror) {
  const double turn = mirror.flipped != mirror.reflected ? -1.0 : 1.0;
  return {mirror.flipped ? -to.x : to.x, mirror.reflected ? -to.y : to.y, turn * to.phi,
          turn * to.sin_phi, to.cos_phi};
}

Target target_of(const Pose2& from, const Pose2& to, double radius_m) {
  const double dx = (to.x_m - from.x_m) / radius_m;
  const double dy = (to.y_m - from.y_m) / radius_m;
  const double c = std::cos(from.heading_rad);
  const double s = std::sin(from.heading_rad);
  const double phi = normal(to.heading_rad - from.heading_rad);
  return {c * dx + s * dy, c * dy - s * dx, phi, std::sin(phi), std::cos(phi)};
}

/// The word that leads back from the end to the start, so that it can be driven the other way
/// round.
Target seen_from_the_end(const Target& to) {
  return {to.x * to.cos_phi + to.y * to.sin_phi, to.x * to.sin_phi - to.y * to.cos_phi, to.phi,
          to.sin_phi, to.cos_phi};
}

/// One of the words: pattern, mirror, and whether it is read from its end.
struct Word {
  std::uint8_t pattern, mirror;
  bool from_end;
};

std::array<Word, kReedsSheppWords> make_words() {
  std::array<Word, kReedsSheppWords> words{};
  std::size_t count = 0;
  for (std::uint8_t p = 0; p < kPatterns.size(); ++p) {
    for (std::uint8_t m = 0; m < kMirrors.size(); ++m) {
      words[count++] = {p, m, false};
      if (kPatterns[p].backwards) words[count++] = {p, m, true};
    }
  }
  return words;
}

const std::array<Word, kReedsSheppWords> kWords = make_words();

ReedsSheppCurve curve_of(std::uint8_t index, const Lengths& found, double radius_m) {
  const Word word = kWords[index];
  const Pattern& pattern = kPatterns[word.pattern];
  const Mirror mirror = kMirrors[word.mirror];
  const Five lengths = pattern.lengths(found);
  ReedsSheppCurve curve;
  curve.word = index;
  for (std::size_t i = 0; i < pattern.count; ++i) {
    const std::size_t from = word.from_end ? pattern.count - 1 - i : i;
    if (std::abs(lengths[from]) <= kZero) continue;
    Kind kind = pattern.kinds[from];
    if (mirror.reflected && kind != kS) kind = kind == kL ? kR : kL;
    const double sign = mirror.flipped ? -radius_m : radius_m;
    curve.pieces[curve.count++] = {kind, sign * lengths[from]};
  }
  return curve;
}

double length_of(const Pattern& pattern, const Lengths& l) {
  double sum = 0.0;
  const Five lengths = pattern.lengths(l);
  for (std::size_t i = 0; i < pattern.count; ++i) sum += std::abs(lengths[i]);
  return sum;
}

/// Calls visit(word, lengths, length in radii) for every word that leads to the target.
template <class Visit>
void each_word(const Target& to, Visit&& visit) {
  const Target back = seen_from_the_end(to);
  for (std::size_t i = 0; i < kReedsSheppWords; ++i) {
    const Word word = kWords[i];
    const Pattern& pattern = kPatterns[word.pattern];
    const Lengths found =
        pattern.formula(mirrored(word.from_end ? back : to, kMirrors[word.mirror]));
    if (found.valid) visit(static_cast<std::uint8_t>(i), found, length_of(pattern, found));
  }
}

}  // namespace

double ReedsSheppCurve::metres() const {
  double sum = 0.0;
  for (const PathSegment& piece : segments()) sum += std::abs(piece.amount);
  return sum;
}

ReedsSheppCurve reeds_shepp(const Pose2& from, const Pose2& to, double radius_m) {
  double shortest = std::numeric_limits<double>::infinity();
  std::uint8_t word = 0;
  Lengths lengths;
  each_word(target_of(from, to, radius_m), [&](std::uint8_t w, const Lengths& l, double length) {
    if (length >= shortest) return;
    shortest = length;
    word = w;
    lengths = l;
  });
  return curve_of(word, lengths, radius_m);
}

double reeds_shepp_m(const Pose2& from, const Pose2& to, double radius_m) {
  double shortest = std::numeric_limits<double>::infinity();
  each_word(target_of(from, to, radius_m), [&](std::uint8_t, const Lengths&, double length) {
    shortest = std::min(shortest, length);
  });
  return shortest * radius_m;
}

double driving_cost_m(std::span<const PathSegment> pieces, const DrivingCosts& costs) {
  double sum = 0.0;
  double before = 0.0;
  for (const PathSegment& piece : pieces) {
    if (piece.kind == Kind::kTurn) {
      sum += std::abs(piece.amount) * costs.turn_m_per_rad;
      continue;
    }
    double metres = std::abs(piece.amount);
    if (piece.amount < 0.0) metres *= costs.reverse;
    if (piece.kind != Kind::kStraight) metres *= costs.arc;
    if (before * piece.amount < 0.0) metres += costs.direction_change_m;
    sum += metres;
    before = piece.amount;
  }
  return sum;
}

ReedsSheppCurve cheapest_reeds_shepp(const Pose2& from, const Pose2& to, double radius_m,
                                     const DrivingCosts& costs) {
  double least = std::numeric_limits<double>::infinity();
  ReedsSheppCurve best;
  each_word(target_of(from, to, radius_m), [&](std::uint8_t w, const Lengths& l, double length) {
    if (length * radius_m >= least) return;  // no cost is below the length
    const ReedsSheppCurve curve = curve_of(w, l, radius_m);
    const double cost = driving_cost_m(curve.segments(), costs);
    if (cost >= least) return;
    least = cost;
    best = curve;
  });
  return best;
}

ReedsSheppCurve same_reeds_shepp_word(const Pose2& from, const Pose2& to, double radius_m,
                                      std::uint8_t word) {
  const Target target = target_of(from, to, radius_m);
  const Word w = kWords[word];
  const Lengths found = kPatterns[w.pattern].formula(
      mirrored(w.from_end ? seen_from_the_end(target) : target, kMirrors[w.mirror]));
  return found.valid ? curve_of(word, found, radius_m) : ReedsSheppCurve{};
}

}  // namespace linewright
