// Compares ARCHITECTURE.md with the repository, and checks on small trees that break one rule each
// that every rule can fail.

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

#include "tests/architecture_rules.hpp"

namespace linewright::architecture {
namespace {

namespace fs = std::filesystem;

std::string listed(const Violations& violations) {
  std::string text;
  for (const std::string& violation : violations) text += "\n  " + violation;
  return text;
}

#define EXPECT_NONE(violations)                  \
  do {                                           \
    const Violations found = (violations);       \
    EXPECT_TRUE(found.empty()) << listed(found); \
  } while (false)

const fs::path& repository() {
  static const fs::path kRoot = LINEWRIGHT_SOURCE_DIR;
  return kRoot;
}

TEST(Repository, ListsEveryFolderOnce) { EXPECT_NONE(find_folder_violations(repository())); }
TEST(Repository, LayersUseOnlyLowerOnes) { EXPECT_NONE(find_table_violations(repository())); }
TEST(Repository, LayersIncludeOnlyAllowedOnes) {
  EXPECT_NONE(find_include_violations(repository()));
}
TEST(Repository, BuildAgreesWithTheTable) { EXPECT_NONE(find_cmake_violations(repository())); }
TEST(Repository, LayersAreSilentAndRepeatable) {
  EXPECT_NONE(find_purity_violations(repository()));
}
TEST(Repository, HeadersHavePragmaOnce) { EXPECT_NONE(find_pragma_violations(repository())); }
TEST(Repository, RefersToNothingOutside) { EXPECT_NONE(find_outside_references(repository())); }

/// A tree of three layers that keeps every rule: `low`, `middle` on `low`, `high` on `middle`.
class SmallTree : public testing::Test {
 protected:
  SmallTree() {
    std::string pattern = (fs::temp_directory_path() / "linewright_XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr) throw std::runtime_error("no temporary folder");
    root_ = pattern;
    write("ARCHITECTURE.md", kDocument);
    write("CMakeLists.txt",
          "linewright_layer(NAME low LIBRARIES fmt::fmt)  # lowest\n"
          "linewright_layer(NAME middle DEPENDS low)\n"
          "linewright_layer(NAME high\n  DEPENDS middle)\n");
    for (const std::string layer : {"low", "middle", "high"}) {
      write("include/linewright/" + layer + "/thing.hpp", "#pragma once\n");
      write("src/" + layer + "/thing.cpp", "#include \"linewright/" + layer + "/thing.hpp\"\n");
    }
    write("docs/notes.md", "notes\n");
    write("data/deep/down/numbers.txt", "1 2 3\n");
    write("build/generated/trash.txt", "not looked at\n");
    write("docs/node_modules/package/index.js", "not looked at\n");
  }

  ~SmallTree() override { fs::remove_all(root_); }

  void write(const std::string& file, const std::string& text) const {
    fs::create_directories((root_ / file).parent_path());
    std::ofstream(root_ / file) << text;
  }

  static constexpr const char* kDocument =
      "## Layers\n"
      "| layer | uses | libraries | what it is |\n"
      "| --- | --- | --- | --- |\n"
      "| `low` | | `fmt::fmt` | the lowest |\n"
      "| `middle` | `low` | | the middle |\n"
      "| `high` | `middle` | | the highest; `words` in its description do not count |\n"
      "## Folders\n"
      "| folder | what it holds |\n"
      "| --- | --- |\n"
      "| `docs` | notes |\n"
      "| `data/**` | numbers |\n";

  fs::path root_;
};

TEST_F(SmallTree, KeepsEveryRuleAsItIs) {
  EXPECT_NONE(find_folder_violations(root_));
  EXPECT_NONE(find_table_violations(root_));
  EXPECT_NONE(find_include_violations(root_));
  EXPECT_NONE(find_cmake_violations(root_));
  EXPECT_NONE(find_purity_violations(root_));
  EXPECT_NONE(find_pragma_violations(root_));
  EXPECT_NONE(find_outside_references(root_));
}

TEST_F(SmallTree, FindsAFolderThatIsNotListed) {
  write("extra/file.txt", "");
  write("docs/more/file.md", "");
  EXPECT_EQ(find_folder_violations(root_),
            (Violations{"docs/more: not listed", "extra: not listed"}));
}

TEST_F(SmallTree, FindsAListedFolderThatIsAbsent) {
  fs::remove_all(root_ / "docs");
  fs::remove(root_ / "src/low/thing.cpp");  // an empty folder is absent, as it is for git
  EXPECT_EQ(find_folder_violations(root_),
            (Violations{"src/low: listed, but holds no file", "docs: listed, but holds no file"}));
}

TEST_F(SmallTree, FindsAFolderListedTwice) {
  write("ARCHITECTURE.md", std::string(kDocument) + "| `docs` | again |\n");
  EXPECT_EQ(find_folder_violations(root_), Violations{"docs: listed twice"});
}

TEST_F(SmallTree, FindsALayerThatUsesAHigherOne) {
  write("ARCHITECTURE.md", "## Layers\n| `low` | `high` | |\n| `high` | `low` | |\n");
  EXPECT_EQ(find_table_violations(root_),
            Violations{"low: uses high, which does not stand above it"});
}

TEST_F(SmallTree, FindsADocumentWithoutLayers) {
  write("ARCHITECTURE.md", "nothing\n");
  EXPECT_EQ(find_table_violations(root_), Violations{"ARCHITECTURE.md: lists no layer"});
}

TEST_F(SmallTree, AllowsIndirectlyUsedLayers) {
  write("src/high/thing.cpp", "#include \"linewright/low/thing.hpp\"\n");
  EXPECT_NONE(find_include_violations(root_));
}

TEST_F(SmallTree, FindsAnIncludeOfAHigherLayer) {
  write("include/linewright/low/thing.hpp",
        "#pragma once\n#include \"linewright/high/thing.hpp\"\n");
  write("src/middle/thing.cpp", "\n  # include <linewright/high/thing.hpp>  // why not\n");
  EXPECT_EQ(find_include_violations(root_),
            (Violations{"include/linewright/low/thing.hpp:2: low may not include "
                        "linewright/high/thing.hpp",
                        "src/middle/thing.cpp:2: middle may not include "
                        "linewright/high/thing.hpp"}));
}

TEST_F(SmallTree, FindsAnIncludeOfAPrivateHeaderOfAHigherLayer) {
  write("src/low/thing.cpp", "#include \"../high/private.hpp\"\n#include \"high/private.hpp\"\n");
  EXPECT_EQ(find_include_violations(root_),
            (Violations{"src/low/thing.cpp:1: low may not include ../high/private.hpp",
                        "src/low/thing.cpp:2: low may not include high/private.hpp"}));
}

TEST_F(SmallTree, FindsAnIncludeOfALayerTheTableDoesNotKnow) {
  write("src/low/thing.cpp", "#include \"linewright/learning/network.hpp\"\n");
  EXPECT_EQ(find_include_violations(root_).size(), 1U);
}

TEST_F(SmallTree, IgnoresIncludesInComments) {
  write("src/low/thing.cpp",
        "// #include \"linewright/high/thing.hpp\"\n/*\n#include \"high/a.hpp\"\n*/\n");
  EXPECT_NONE(find_include_violations(root_));
}

TEST_F(SmallTree, FindsDependenciesThatDifferFromTheTable) {
  write("CMakeLists.txt",
        "linewright_layer(NAME low LIBRARIES fmt::fmt)\n"
        "linewright_layer(NAME middle LIBRARIES Threads::Threads)\n"
        "linewright_layer(NAME extra)\n");
  EXPECT_EQ(find_cmake_violations(root_),
            (Violations{"middle: DEPENDS nothing in CMakeLists.txt, but low in ARCHITECTURE.md",
                        "middle: LIBRARIES Threads::Threads in CMakeLists.txt, but nothing in "
                        "ARCHITECTURE.md",
                        "high: not in CMakeLists.txt", "extra: not in ARCHITECTURE.md"}));
}

TEST_F(SmallTree, FindsImpureCode) {
  for (const std::string code : {"std::cout << 1;",
                                 "std::cerr << 1;",
                                 "using std::clog;",
                                 "printf(\"x\");",
                                 "std::printf(\"x\");",
                                 "fprintf(file, \"x\");",
                                 "std::puts(\"x\");",
                                 "fmt::print(\"x\");",
                                 "fmt::println(\"x\");",
                                 "std::exit(1);",
                                 "exit(1);",
                                 "if (bad) exit(1);",
                                 "return abort();",
                                 "std::abort();",
                                 "::abort();",
                                 "std::terminate();",
                                 "auto t = std::chrono::steady_clock::now();",
                                 "std::chrono::system_clock::time_point t;",
                                 "std::chrono::high_resolution_clock::now();",
                                 "auto t = time(nullptr);",
                                 "auto t = std::time(&now);",
                                 "auto t = std::clock();",
                                 "auto x = 1'000; std::random_device device;",
                                 "int r = rand() % 6;",
                                 "std::srand(1);"}) {
    write("src/low/code.cpp", "void f() {\n" + code + "\n}\n");
    const Violations found = find_purity_violations(root_);
    ASSERT_EQ(found.size(), 1U) << code << listed(found);
    EXPECT_TRUE(found[0].starts_with("src/low/code.cpp:2: ")) << found[0];
  }
}

TEST_F(SmallTree, AllowsCodeThatOnlyLooksImpure) {
  for (const std::string code :
       {"// never calls std::abort()", "/* std::cout\n std::cerr */",
        "throw Error(\"exit() and std::cout\");", "auto s = R\"x(\" printf() )x\";",
        "Tick time() const;", "event.time();", "state->clock();", "own::exit(1);",
        "char c = '\"'; // std::cout", "fmt::format(\"{}\", 1);", "out << 1;", "assert(x > 0);",
        "std::snprintf(b, 8, \"x\");", "int exit_place = 1;", "std::optional<Tick> time(int x);",
        "auto sum = time() + 1;"}) {
    write("src/low/code.cpp", "void f() {\n" + code + "\n}\n");
    const Violations found = find_purity_violations(root_);
    EXPECT_TRUE(found.empty()) << code << listed(found);
  }
}

TEST_F(SmallTree, LetsTestsReadAClock) {
  write("src/low/thing_test.cpp", "auto t = std::chrono::steady_clock::now();\n");
  EXPECT_NONE(find_purity_violations(root_));
}

TEST_F(SmallTree, FindsAHeaderWithoutPragmaOnce) {
  write("include/linewright/low/other.hpp", "// #pragma once\n");
  EXPECT_EQ(find_pragma_violations(root_),
            Violations{"include/linewright/low/other.hpp: lacks #pragma once"});
}

TEST_F(SmallTree, FindsAReferenceToTheOutside) {
  write("docs/notes.md", std::string("see ..") + "/shared/design.md\n");
  EXPECT_EQ(find_outside_references(root_),
            Violations{std::string("docs/notes.md: mentions ..") + "/shared"});
}

}  // namespace
}  // namespace linewright::architecture
