#include "moves.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "random_hall.hpp"
#include "steering.hpp"

namespace linewright {
namespace {

TEST(MoveTable, WhereNoSweptCellIsBlockedTheMoveIsFree) {
  RandomStream random(41);
  const OccupancyGrid grid = random_hall(random, 120, 90, 0.2, 12);
  const auto map = std::make_shared<const ClearanceMap>(grid);
  const std::vector<Mover> movers{{Footprint::circle(0.3), 0.0},
                                  {Footprint::circle(0.4), 0.6},
                                  {Footprint::rectangle(1.4, 0.9), 0.0},
                                  {Footprint::rectangle(1.4, 0.9), 0.8}};
  for (const Mover& mover : movers) {
    const CollisionChecker checker(map, mover.footprint.grown(0.01));
    const PathPlannerOptions options;
    const Steering steering(checker, mover, options);
    MoveTable table(checker, mover, options);
    int clear = 0;
    int blocked_for_sure = 0;
    int unsure = 0;
    for (int i = 0; i < 20000; ++i) {
      Pose2 pose = random_free_pose(random, *map, 0.3);
      const auto heading =
          static_cast<int>(random.below(static_cast<std::size_t>(table.headings())));
      const double offset = random.uniform() - 0.5;
      pose.heading_rad = (heading + offset) * table.step_rad();
      if (!checker.free(pose)) continue;
      const std::size_t m = random.below(table.moves().size());
      const Move& move = table.moves()[m];
      if (table.headings() == 1) pose.heading_rad = std::atan2(move.dy_m, move.dx_m);
      const double column = pose.x_m / grid.cell_m();
      const double row = pose.y_m / grid.cell_m();
      const MoveTable::Swept swept =
          table.swept(m, static_cast<float>(column), static_cast<float>(row), heading,
                      MoveTable::quarter_of(offset));
      ASSERT_NE(swept.rows, nullptr);
      std::uint64_t hit = 0;
      std::uint64_t certain = 0;
      for (int r = 0; r < swept.height; ++r) {
        const std::uint64_t blocked =
            map->bits(static_cast<std::int32_t>(column) + swept.first_column,
                      static_cast<std::int32_t>(row) + swept.first_row + r, swept.width);
        hit |= swept.rows[r] & blocked;
        certain |= swept.core[r] & blocked;
        EXPECT_EQ(swept.core[r] & ~swept.rows[r], 0U);
      }
      const bool free = steering.free(pose, {&move.piece, 1});
      if (hit == 0) {
        EXPECT_TRUE(free);
        ++clear;
      } else if (certain != 0) {
        EXPECT_FALSE(free);
        ++blocked_for_sure;
      } else {
        unsure += free ? 1 : 0;
      }
    }
    EXPECT_GT(clear, 5000);
    EXPECT_GT(blocked_for_sure, 20);
    EXPECT_LT(unsure, clear / 10);  // the exact look is the exception
  }
}

}  // namespace
}  // namespace linewright
