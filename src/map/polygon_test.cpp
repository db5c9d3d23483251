#include "linewright/map/polygon.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "random_polygon.hpp"

namespace linewright {
namespace {

const Polygon kSquare = {{0, 0}, {2, 0}, {2, 2}, {0, 2}};
const Polygon kNotched = {{0, 0}, {4, 0}, {4, 4}, {2, 1}, {0, 4}};

bool in_triangle(Point2 p, Point2 a, Point2 b, Point2 c) {
  const auto side = [](Point2 from, Point2 to, Point2 q) {
    return (to.x_m - from.x_m) * (q.y_m - from.y_m) - (to.y_m - from.y_m) * (q.x_m - from.x_m);
  };
  return side(a, b, p) > 0.0 && side(b, c, p) > 0.0 && side(c, a, p) > 0.0;
}

TEST(Polygon, FaultsAreNamed) {
  EXPECT_FALSE(polygon_fault(kSquare));
  EXPECT_FALSE(polygon_fault(kNotched));
  EXPECT_FALSE(polygon_fault({{0, 0}, {1, 0}, {2, 0}, {2, 2}}));  // a corner within a side
  EXPECT_EQ(polygon_fault({{0, 0}, {1, 1}}), "it has 2 corners, and needs three at least");
  EXPECT_EQ(polygon_fault({{0, 0}, {2, 0}, {2, 0}, {0, 2}}), "corners 2 and 3 are one point");
  EXPECT_EQ(polygon_fault({{0, 0}, {2, 0}, {2, 2}, {0, 0}}), "corners 4 and 1 are one point");
  EXPECT_EQ(polygon_fault({{0, 0}, {2, 0}, {1, 0}}), "it goes back on itself at corner 2");
  EXPECT_EQ(polygon_fault({{0, 0}, {2, 2}, {2, 0}, {0, 2}}),
            "the sides after corners 1 and 3 cross or touch");
  EXPECT_EQ(polygon_fault({{0, 0}, {4, 0}, {4, 4}, {2, 0}, {0, 4}}),
            "the sides after corners 1 and 3 cross or touch");
}

TEST(Polygon, EveryStarIsSimpleAndAnySwapOfNeighboursInARoundOneIsNot) {
  RandomStream random(1);
  for (int i = 0; i < 300; ++i) EXPECT_FALSE(polygon_fault(random_polygon(random, {1, 2}, 3.0)));
  for (std::size_t swapped = 0; swapped < 8; ++swapped) {
    Polygon round;
    for (int i = 0; i < 8; ++i) round.push_back({std::cos(i * 0.785), std::sin(i * 0.785)});
    std::swap(round[swapped], round[(swapped + 1) % 8]);
    EXPECT_TRUE(polygon_fault(round)) << swapped;
  }
}

TEST(Polygon, AreaTurnsWithTheCorners) {
  EXPECT_EQ(doubled_area_m2(kSquare), 8.0);
  EXPECT_EQ(doubled_area_m2({kSquare.rbegin(), kSquare.rend()}), -8.0);
  EXPECT_EQ(doubled_area_m2(kNotched), 20.0);
  EXPECT_TRUE(is_convex(kSquare));
  EXPECT_TRUE(is_convex({kSquare.rbegin(), kSquare.rend()}));
  EXPECT_FALSE(is_convex(kNotched));
}

TEST(Polygon, ContainsWhatTheTrianglesAroundItsMiddleContain) {
  RandomStream random(2);
  const Point2 middle{-3.0, 1.0};
  for (int i = 0; i < 100; ++i) {
    const Polygon polygon = random_polygon(random, middle, 2.0);
    for (int j = 0; j < 100; ++j) {
      const Point2 point{random_between(random, -5.5, -0.5), random_between(random, -1.5, 3.5)};
      bool inside = false;
      for (std::size_t c = 0; c < polygon.size(); ++c) {
        inside =
            inside || in_triangle(point, middle, polygon[c], polygon[(c + 1) % polygon.size()]);
      }
      EXPECT_EQ(contains(polygon, point), inside) << point.x_m << ", " << point.y_m;
    }
  }
}

TEST(Polygon, DistanceIsThatToTheNearestPointOfItsEdge) {
  RandomStream random(3);
  for (int i = 0; i < 100; ++i) {
    const Polygon polygon = random_polygon(random, {0, 0}, 2.0);
    const Point2 point{random_between(random, -4, 4), random_between(random, -4, 4)};
    double nearest_m = 100.0;
    for (std::size_t c = 0; c < polygon.size(); ++c) {
      const Point2 a = polygon[c];
      const Point2 b = polygon[(c + 1) % polygon.size()];
      for (double share = 0.0; share <= 1.0; share += 1e-3) {
        nearest_m = std::min(nearest_m, distance_m(point, {a.x_m + share * (b.x_m - a.x_m),
                                                           a.y_m + share * (b.y_m - a.y_m)}));
      }
    }
    EXPECT_NEAR(distance_to_m(point, polygon), contains(polygon, point) ? 0.0 : nearest_m, 4e-3);
  }
}

TEST(Polygon, BoundsAndCornersBelongTogether) {
  const Rectangle bounds = bounds_of(kNotched);
  EXPECT_EQ(bounds.x0_m, 0.0);
  EXPECT_EQ(bounds.x1_m, 4.0);
  EXPECT_EQ(bounds.y0_m, 0.0);
  EXPECT_EQ(bounds.y1_m, 4.0);
  EXPECT_EQ(doubled_area_m2(corners_of(bounds)), 32.0);
}

}  // namespace
}  // namespace linewright
