// What the command line tool says to wrong arguments: exit code 2, and what to write instead.

#include <gtest/gtest.h>

#include "tests/cli_support.hpp"

#ifdef LINEWRIGHT_CLI

namespace linewright::testing {
namespace {

struct Wrong {
  const char* arguments;
  const char* says;
};

class CliErrors : public ::testing::TestWithParam<Wrong> {};

TEST_P(CliErrors, ExitWithTwoAndSayWhatToWrite) {
  const Output output = linewright(GetParam().arguments);
  EXPECT_EQ(output.code, 2);
  EXPECT_EQ(output.out, "");
  EXPECT_NE(output.err.find(GetParam().says), std::string::npos) << output.err;
}

INSTANTIATE_TEST_SUITE_P(
    All, CliErrors,
    ::testing::Values(
        Wrong{"simulate nowhere.yaml", "nowhere.yaml"},
        Wrong{"simulate scenarios/duct_line.yaml --planner frist", "did you mean 'first'?"},
        Wrong{"simulate scenarios/duct_line.yaml --allocator sapp", "did you mean 'sap'?"},
        Wrong{"simulate scenarios/duct_line.yaml --planner priority:1,99", "no task '99'"},
        Wrong{"simulate scenarios/duct_line.yaml --planner priority:cut_strait",
              "did you mean 'cut_straight'?"},
        Wrong{"simulate scenarios/duct_line.yaml --planner priority:1,1", "listed twice"},
        Wrong{"simulate scenarios/duct_line.yaml --planner lookahead:0ms", "nothing to look ahead"},
        Wrong{"simulate scenarios/duct_line.yaml --planner lookahead:1ms,agent=free",
              "did you mean 'agents'?"},
        Wrong{"simulate scenarios/teaching/long_hall.yaml --planner priority:tuned",
              "linewright tune-priority scenarios/teaching/long_hall.yaml"},
        Wrong{"evaluate scenarios/duct_line.yaml --planner first,random,first", "listed twice"},
        Wrong{"evaluate scenarios/duct_line.yaml --planner first,random --versus random",
              "name one planner"},
        Wrong{"solve scenarios/duct_line.yaml --budget 0s", "leaves nothing to search with"},
        Wrong{"solve scenarios/duct_line.yaml --budget 60", "is no time"},
        Wrong{"solve scenarios/duct_line.yaml --budget 1s --rollouts 5", "--rollouts"},
        Wrong{"solve scenarios/duct_line.yaml --humans 1,2 --rollouts 5 --log out/x.jsonl",
              "for one run"},
        Wrong{"solve scenarios/duct_line.yaml --rollouts 5 --allocator no_spatial",
              "draws at random"},
        Wrong{"tune-priority scenarios/duct_line.yaml --runs 0", "--runs"},
        Wrong{"tune-priority scenarios/duct_line.yaml --runs 10 --exhaustive", "--exhaustive"},
        Wrong{"simulate scenarios/duct_line.yaml --planner first:3", "takes no '3'"},
        Wrong{"simulate scenarios/duct_line.yaml --humans 7", "made for 1 to 3"},
        Wrong{"simulate scenarios/duct_line.yaml --humans two", "is no count"},
        Wrong{"simulate scenarios/duct_line.yaml --crew forklift=1",
              "no workers called 'forklift'"},
        Wrong{"simulate scenarios/duct_line.yaml --order 0", "order of 0"},
        Wrong{"simulate scenarios/duct_line.yaml --close ramp@10+5", "has no zone 'ramp'"},
        Wrong{"evaluate scenarios/duct_line.yaml --close ramp@10", "is no ZONE@TICK+TICKS"},
        Wrong{"simulate scenarios/duct_line.yaml --close ramp@0+5", "is no ZONE@TICK+TICKS"},
        Wrong{"simulate scenarios/duct_line.yaml --horizon -5", "horizon"},
        Wrong{"simulate scenarios/duct_line.yaml --planner replay", "--decisions FILE"},
        Wrong{"simulate scenarios/duct_line.yaml --decisions x.json", "--planner replay"},
        Wrong{"simulate scenarios/duct_line.yaml --planner replay --decisions nowhere.json",
              "nowhere.json"},
        Wrong{"simulate scenarios/duct_line.yaml --planner replay --decisions README.md",
              "event log"},
        Wrong{"simulate scenarios/duct_line.yaml --log /proc/nowhere/x.jsonl", "cannot be written"},
        Wrong{"simulate scenarios/duct_line.yaml --gantt out/x.pdf", ".svg"},
        Wrong{"evaluate scenarios/duct_line.yaml --humans 3..1", "is empty"},
        Wrong{"evaluate scenarios/duct_line.yaml --trials 0", "--trials"},
        Wrong{"evaluate scenarios/duct_line.yaml --allocator sap,longest_pth",
              "did you mean 'longest_path'?"},
        Wrong{"evaluate scenarios/duct_line.yaml --allocator sap,sap", "listed twice"},
        Wrong{"evaluate scenarios/duct_line.yaml --allocator sap,first_idle --versus random",
              "name one allocator"},
        Wrong{"evaluate scenarios/duct_line.yaml --humans 0..10000 --robots 1..2",
              "more than 10000 crews"},
        Wrong{"simulate scenarios/duct_line.yaml --humans 10001", "a number up to 10000"},
        Wrong{"gantt nowhere.jsonl", "nowhere.jsonl"},
        Wrong{"gantt scenarios/duct_line.yaml", "scenarios/duct_line.yaml"},
        Wrong{"simulate scenarios/duct_line.yaml --humanz 2", "did you mean '--humans'?"},
        Wrong{"simulate scenarios/duct_line.yaml --humans 1..2", "this command runs one"},
        Wrong{"simulate scenarios/duct_line.yaml --humans 2 --crew human=1", "given twice"},
        Wrong{"simulate scenarios/duct_line.yaml --log out/x.svg --gantt out/x.svg", "two files"},
        Wrong{"simulate scenarios/duct_line.yaml --seed -1", "--seed"},
        Wrong{"simulate scenarios/duct_line.yaml --planner replay --humans 1 --decisions x.json",
              "from the record"},
        Wrong{"simulate scenarios/duct_line.yaml --planner replay --order 0 --decisions "
              "tests/data/recorded/rule_H2R2_n1_s0.json",
              "order of 0"},
        Wrong{"evaluate scenarios/duct_line.yaml --planner replay", "only for simulate"},
        Wrong{"map scenarios/maps/duct_hall.yaml", "a map file of ROS map_server, not a scenario"},
        Wrong{"map scenarios/teaching/one_human_one_robot.yaml", "the scenario has no map"},
        Wrong{"map scenarios/duct_line.yaml --out out/hall.png", "name the YAML file: hall.yaml"},
        Wrong{"map nowhere.yaml", "nowhere.yaml"},
        Wrong{"routes scenarios/duct_line.yaml",
              "write travel: {human: hybrid_a_star, robot: hybrid_a_star}"},
        Wrong{"routes scenarios/teaching/one_human_one_robot.yaml", "give it a map"},
        Wrong{"routes scenarios/duct_line_routed.yaml --no-cache --kind robt",
              "did you mean 'robot'?"},
        Wrong{"routes scenarios/duct_line_routed.yaml --no-cache --svg out/x.svg --start "
              "flange_rak",
              "did you mean 'flange_rack'?"},
        Wrong{"routes scenarios/duct_line_routed.yaml --start storage", "add --svg FILE.svg"},
        Wrong{"routes scenarios/duct_line_routed.yaml --svg out/x.png", "ends in .svg"},
        Wrong{"evaluate scenarios/duct_line.yaml --planner policy:docs", "has no policy"},
        Wrong{"simulate scenarios/duct_line.yaml --planner policy:policies", "is a folder"},
        Wrong{"simulate scenarios/duct_line.yaml --explain --json", "add --log FILE"},
        Wrong{"simulate scenarios/duct_line.yaml --shield maybe", "--shield"},
        Wrong{"bound scenarios/duct_line.yaml --humans 1 --robots 1 --makespan 0", "--makespan"},
        Wrong{"bound nowhere.yaml", "nowhere.yaml"},
        Wrong{"reproduce papr", "did you mean 'paper'?"},
        Wrong{"reproduce paper --policies nowhere", "nowhere"},
        Wrong{"simualte", "did you mean 'simulate'?"}));

}  // namespace
}  // namespace linewright::testing

#endif
