#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

#include "linewright/base/diagnostic.hpp"
#include "linewright/planning/lookahead.hpp"

namespace linewright {
namespace {

std::string complaint(const std::string& text) {
  try {
    static_cast<void>(parse_lookahead(text));
  } catch (const ScenarioError& error) {
    return error.what();
  }
  return "";
}

TEST(LookaheadOptions, TakeABudgetInTimeOrRollouts) {
  EXPECT_EQ(parse_lookahead("10ms").budget_ns, 10'000'000);
  EXPECT_EQ(parse_lookahead("0.5ms").budget_ns, 500'000);
  EXPECT_EQ(parse_lookahead("2s").budget_ns, 2'000'000'000);
  EXPECT_EQ(parse_lookahead("200r").rollouts, 200U);
  EXPECT_EQ(parse_lookahead("200r").budget_ns, 0);
}

TEST(LookaheadOptions, KeepTheCommasOfTheBasePlanner) {
  const LookaheadOptions options =
      parse_lookahead("10ms,base=priority:1,2,8,agents=free,wait=true,chains=3,threads=2");
  EXPECT_EQ(options.base, "priority:1,2,8");
  EXPECT_TRUE(options.free_agents);
  EXPECT_TRUE(options.wait);
  EXPECT_EQ(options.chains, 3U);
  EXPECT_EQ(options.threads, 2U);
}

TEST(LookaheadOptions, SayWhatIsWrongAndWhatToWrite) {
  const std::vector<std::pair<std::string, std::string>> wrong{
      {"", "budget is missing"},
      {"0ms", "leaves nothing to look ahead with"},
      {"-3r", "leaves nothing to look ahead with"},
      {"nanms", "leaves nothing to look ahead with"},
      {"10", "is no budget"},
      {"10h", "lookahead:10ms"},
      {"base=first", "is no budget"},
      {"10ms,agent=free", "did you mean 'agents'?"},
      {"10ms,agents=all", "agents=free"},
      {"10ms,wait=maybe", "wait=true"},
      {"10ms,wait=true,wait=false", "given twice"},
      {"10ms,chains=0", "write 1 to 1024"},
      {"10ms,base=", "base=first"},
      {"10ms,base=lookahead:1ms", "cannot look ahead itself"},
      {"10ms,fast", "KEY=VALUE"},
  };
  for (const auto& [text, message] : wrong) {
    EXPECT_NE(complaint(text).find(message), std::string::npos) << text << ": " << complaint(text);
  }
}

}  // namespace
}  // namespace linewright
