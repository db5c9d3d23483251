#include "linewright/planning/planner.hpp"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace linewright {
namespace {

using List = std::vector<std::string>;

TEST(PlannerList, IsSplitOnlyWhereANewPlannerBegins) {
  EXPECT_EQ(split_planners("first"), List{"first"});
  EXPECT_EQ(split_planners("first,random,spt"), (List{"first", "random", "spt"}));
  EXPECT_EQ(split_planners("priority:1,2,8,priority:tuned,first"),
            (List{"priority:1,2,8", "priority:tuned", "first"}));
  EXPECT_EQ(split_planners("lookahead:1ms,base=priority:1,2,wait=true,lookahead:10ms"),
            (List{"lookahead:1ms,base=priority:1,2,wait=true", "lookahead:10ms"}));
  EXPECT_EQ(split_planners("policy:a,b.safetensors,fifo"),
            (List{"policy:a,b.safetensors", "fifo"}));
}

TEST(PlannerList, LeavesWhatIsNoPlannerForTheRegistryToRefuse) {
  EXPECT_EQ(split_planners("frist,random"), (List{"frist", "random"}));
  EXPECT_EQ(split_planners("first,rnadom"), (List{"first,rnadom"}));
  EXPECT_EQ(split_planners(""), List{""});
}

}  // namespace
}  // namespace linewright
