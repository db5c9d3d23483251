#include "linewright/training/csv_log.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include "linewright/base/diagnostic.hpp"
#include "linewright/base/files.hpp"

namespace linewright {
namespace {

using Row = std::vector<double>;
const std::vector<std::string> kColumns{"update", "loss"};

std::string temporary() {
  return testing::TempDir() + "linewright_csv_log_" +
         testing::UnitTest::GetInstance()->current_test_info()->name() + "/log.csv";
}

std::string content_of(const std::string& path) {
  std::string reason;
  return read_file(path, 1 << 20, reason).value_or("unreadable: " + reason);
}

TEST(CsvLog, WritesAHeaderAndRows) {
  const std::string path = temporary();
  CsvLog log = CsvLog::create(path, kColumns);
  EXPECT_EQ(content_of(path), "update,loss\n");
  log.row(Row{1, 0.1});
  log.row(Row{2'000'000, std::nan("")});
  log.row(Row{-3, std::numeric_limits<double>::infinity()});
  log.flush();
  EXPECT_EQ(content_of(path), "update,loss\n1,0.1\n2000000,\n-3,\n");
}

TEST(CsvLog, AResumedRunLosesWhatCameAfterItsCheckpoint) {
  const std::string path = temporary();
  CsvLog first = CsvLog::create(path, kColumns);
  first.row(Row{1, 1});
  const std::uint64_t size = first.size();
  first.row(Row{2, 2});
  first.flush();
  CsvLog second = CsvLog::reopen(path, kColumns, size);
  second.row(Row{2, 3});
  second.flush();
  EXPECT_EQ(content_of(path), "update,loss\n1,1\n2,3\n");
}

TEST(CsvLog, OtherColumnsAreNotContinued) {
  const std::string path = temporary();
  const std::uint64_t size = CsvLog::create(path, kColumns).size();
  EXPECT_THROW((void)CsvLog::reopen(path, {"update", "gain"}, size), ScenarioError);
  EXPECT_THROW((void)CsvLog::reopen(path, kColumns, 3), ScenarioError);
  EXPECT_THROW((void)CsvLog::reopen(path, kColumns, size + 1), ScenarioError);
  EXPECT_THROW((void)CsvLog::reopen(path + ".none", kColumns, size), ScenarioError);
  EXPECT_EQ(content_of(path), "update,loss\n");
}

TEST(CsvLog, RefusesRowsAndColumnsThatDoNotFit) {
  EXPECT_THROW((void)CsvLog::create(temporary(), {"a,b"}), std::invalid_argument);
  CsvLog log = CsvLog::create(temporary(), kColumns);
  EXPECT_THROW(log.row(Row{1}), std::invalid_argument);
}

}  // namespace
}  // namespace linewright
