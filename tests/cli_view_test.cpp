// `linewright view` without a server: logs that are broken, one file with everything, pictures.

#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "src/base/xml_check.hpp"
#include "tests/view_support.hpp"

#ifdef LINEWRIGHT_CLI

namespace linewright::testing {
namespace {

constexpr const char* kLog = LINEWRIGHT_SOURCE_DIR "/tests/golden/kitting_cell-first.jsonl";
const std::string kBefore = "<script type=\"application/json\" id=\"linewright-logs\">";

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

class CliView : public ::testing::Test {
 protected:
  /// The command in the folder with the page.
  [[nodiscard]] Output view(const std::string& arguments) const {
    return linewright_in(folder_.path(), "view " + arguments);
  }

  /// The logs in the page.
  [[nodiscard]] nlohmann::json logs_in(const std::string& page) const {
    const std::size_t begin = page.find(kBefore) + kBefore.size();
    return nlohmann::json::parse(page.substr(begin, page.find("</script>", begin) - begin));
  }

  PageFolder folder_;
};

TEST_F(CliView, ExportsOneFileWithTheLogsInside) {
  folder_.write("b.jsonl", read_file(kLog));
  const Output output = view(std::string(kLog) + " b.jsonl --export out/page.html");
  ASSERT_EQ(output.code, 0) << output.err;
  EXPECT_EQ(output.out, "page         out/page.html\n");
  const std::string page = read_file(folder_.file("out/page.html"));
  EXPECT_TRUE(has(page, "<p>the page</p>"));
  const auto logs = logs_in(page)["logs"];
  ASSERT_EQ(logs.size(), 2U);
  EXPECT_EQ(logs[0]["name"], "kitting_cell-first.jsonl");
  EXPECT_EQ(logs[0]["text"], read_file(kLog));
  EXPECT_EQ(logs[1]["name"], "b.jsonl");
}

TEST_F(CliView, NoTextOfALogCanEndItsElement) {
  std::string log = read_file(kLog);
  const std::string evil = "</script><script>alert(1)</script>&\xE2\x80\xA8";
  log.replace(log.find("kitting_cell"), 12, evil);
  folder_.write("evil.jsonl", log);
  const Output output = view("evil.jsonl --export page.html");
  ASSERT_EQ(output.code, 0) << output.err;
  const std::string page = read_file(folder_.file("page.html"));
  const std::size_t begin = page.find(kBefore) + kBefore.size();
  const std::string inside = page.substr(begin, page.rfind("</script>") - begin);
  EXPECT_EQ(inside.find_first_of("<>&"), std::string::npos);
  EXPECT_FALSE(has(inside, "\xE2\x80\xA8"));
  EXPECT_TRUE(has(inside, "\\u003c/script\\u003e"));
  EXPECT_EQ(logs_in(page)["logs"][0]["text"], log);
}

TEST_F(CliView, LogsOfOneNameAreToldApartByTheirFolders) {
  std::filesystem::create_directories(folder_.file("x"));
  folder_.write("run.jsonl", read_file(kLog));
  folder_.write("x/run.jsonl", read_file(kLog));
  ASSERT_EQ(view("run.jsonl x/run.jsonl --export page.html").code, 0);
  const auto logs = logs_in(read_file(folder_.file("page.html")))["logs"];
  EXPECT_EQ(logs[0]["name"], "run.jsonl");
  EXPECT_EQ(logs[1]["name"], "x/run.jsonl");
}

TEST_F(CliView, SaysHowToBuildThePageWhereThereIsNone) {
  std::filesystem::remove_all(folder_.file("web"));
  // Far from the repository, where the page may well have been built.
  const std::string program = folder_.file("linewright");
  std::filesystem::copy_file(LINEWRIGHT_CLI, program);
  const Output output =
      linewright_in(folder_.path(), "view " + std::string(kLog) + " --export page.html", program);
  EXPECT_EQ(output.code, 2);
  EXPECT_TRUE(has(output.err, "make web")) << output.err;
}

TEST_F(CliView, RefusesAPageOfAnotherVersion) {
  folder_.write("web/linewright-view.html", "<p>no place for logs</p>");
  const Output output = view(std::string(kLog) + " --export page.html");
  EXPECT_EQ(output.code, 2);
  EXPECT_TRUE(has(output.err, "has no place for logs")) << output.err;
}

TEST_F(CliView, SaysWhatIsWrongWithALog) {
  const std::string log = read_file(kLog);
  folder_.write("empty.jsonl", "");
  folder_.write("other.jsonl", "{\"a\": 1}\n");
  folder_.write("text.jsonl", "hello\n");
  std::string old = log;
  old.replace(old.find("event_log/1"), 11, "event_log/9");
  folder_.write("old.jsonl", old);
  const auto error = [&](const std::string& file) {
    const Output output = view(file + " --export page.html");
    EXPECT_EQ(output.code, 2) << file;
    EXPECT_FALSE(std::filesystem::exists(folder_.file("page.html"))) << file;
    return output.err;
  };
  EXPECT_TRUE(has(error("missing.jsonl"), "missing.jsonl: error: cannot be read: No such file"));
  EXPECT_TRUE(has(error("empty.jsonl"), "empty.jsonl: error: the file is empty"));
  EXPECT_TRUE(has(error("other.jsonl"), "other.jsonl:1: error: is not an event log"));
  EXPECT_TRUE(has(error("text.jsonl"), "text.jsonl:1: error: is not JSON"));
  EXPECT_TRUE(has(error("old.jsonl"), "old.jsonl:1: error: has the format"));
  EXPECT_TRUE(has(error("web"), "web: error: cannot be read: it is a folder"));
}

TEST_F(CliView, ShowsWhatIsThereOfALogThatIsCutOff) {
  const std::string log = read_file(kLog);
  folder_.write("cut.jsonl", log.substr(0, log.size() / 2));
  const Output output = view("cut.jsonl --export page.html --snapshots 0 --out .");
  EXPECT_EQ(output.code, 0);
  EXPECT_TRUE(has(output.err, "warning: the log is cut off")) << output.err;
  EXPECT_EQ(logs_in(read_file(folder_.file("page.html")))["logs"][0]["text"],
            log.substr(0, log.size() / 2));
  EXPECT_EQ(test::XmlCheck::fault(read_file(folder_.file("cut_tick0.svg"))), "");
}

TEST_F(CliView, DrawsTheHallAtTicks) {
  const Output output = view(std::string(kLog) + " --snapshots 10,50 --out pictures");
  ASSERT_EQ(output.code, 0) << output.err;
  EXPECT_EQ(output.out,
            "hall picture  pictures/kitting_cell-first_tick10.svg\n"
            "hall picture  pictures/kitting_cell-first_tick50.svg\n");
  const std::string svg = read_file(folder_.file("pictures/kitting_cell-first_tick50.svg"));
  EXPECT_EQ(test::XmlCheck::fault(svg), "");
  EXPECT_TRUE(has(svg, "kitting_cell at tick 50"));
}

TEST_F(CliView, RefusesTicksThatTheLogDoesNotHave) {
  for (const char* ticks : {"99999", "10,99999", "-1", "ten", "1.5"}) {
    const Output output = view(std::string(kLog) + " --snapshots=" + ticks + " --out pictures");
    EXPECT_EQ(output.code, 2) << ticks;
    EXPECT_FALSE(std::filesystem::exists(folder_.file("pictures"))) << ticks;
  }
  EXPECT_TRUE(has(view(std::string(kLog) + " --snapshots 99999").err, "it ends at tick"));
}

}  // namespace
}  // namespace linewright::testing

#endif
