#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "linewright/base/geometry.hpp"
#include "linewright/routing/path.hpp"

namespace linewright {

/// A curve of at most five arcs and straight pieces.
struct ReedsSheppCurve {
  std::array<PathSegment, 5> pieces{};
  std::uint8_t count = 0;
  std::uint8_t word = 0;  ///< which of the words below it is

  [[nodiscard]] std::span<const PathSegment> segments() const { return {pieces.data(), count}; }
  [[nodiscard]] double metres() const;
};

/// Number of words (patterns of arcs and straight pieces, with their directions) that a shortest
/// curve can have.
inline constexpr std::size_t kReedsSheppWords = 44;

/// The shortest curve between two poses of a vehicle that drives forwards and backwards with a
/// turning radius > 0 on an empty floor (J. Reeds, L. Shepp: Optimal paths for a car that goes both
/// forwards and backwards, 1990, section 8). Pieces of no length are left out.
[[nodiscard]] ReedsSheppCurve reeds_shepp(const Pose2& from, const Pose2& to,
                                          double turning_radius_m);

/// Its length in metres.
[[nodiscard]] double reeds_shepp_m(const Pose2& from, const Pose2& to, double turning_radius_m);

/// What driving costs beside its length.
struct DrivingCosts {
  double reverse = 1.0;           ///< factor on metres driven backwards, >= 1
  double direction_change_m = 0;  ///< metres that each change of direction counts, >= 0
  double arc = 1.0;               ///< factor on metres driven on arcs, >= 1
  double turn_m_per_rad = 0;      ///< metres that a radian turned on the spot counts, >= 0
};

/// Cost of pieces driven one after the other, in metres.
[[nodiscard]] double driving_cost_m(std::span<const PathSegment> pieces, const DrivingCosts& costs);

/// The cheapest of the curves of all words.
[[nodiscard]] ReedsSheppCurve cheapest_reeds_shepp(const Pose2& from, const Pose2& to,
                                                   double turning_radius_m,
                                                   const DrivingCosts& costs);

/// The curve of the same word as one between nearby poses; count 0 when the word does not lead
/// there.
[[nodiscard]] ReedsSheppCurve same_reeds_shepp_word(const Pose2& from, const Pose2& to,
                                                    double turning_radius_m, std::uint8_t word);

}  // namespace linewright
