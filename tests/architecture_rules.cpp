#include "tests/architecture_rules.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <map>
#include <optional>
#include <regex>
#include <set>
#include <sstream>
#include <string_view>
#include <utility>

#include "tests/cpp_text.hpp"

namespace linewright::architecture {
namespace {

namespace fs = std::filesystem;

std::string read_file(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

/// Not part of the repository: build results, version control, caches and settings of editors.
bool is_ignored(const std::string& relative) {
  static const std::set<std::string> kAtTheTop = {"build", "out", ".git"};
  static const std::set<std::string> kAnywhere = {".cache", ".idea", ".vscode", "__pycache__",
                                                  "node_modules"};
  return kAtTheTop.contains(relative) || kAnywhere.contains(fs::path(relative).filename().string());
}

/// Every file of the repository, relative to `root`, sorted.
std::vector<std::string> files_of(const fs::path& root) {
  std::vector<std::string> files;
  for (auto entry = fs::recursive_directory_iterator(root); entry != fs::end(entry); ++entry) {
    const std::string relative = entry->path().lexically_relative(root).generic_string();
    if (is_ignored(relative)) {
      if (entry->is_directory()) entry.disable_recursion_pending();
    } else if (entry->is_regular_file()) {
      files.push_back(relative);
    }
  }
  std::sort(files.begin(), files.end());
  return files;
}

bool is_cpp(const std::string& file) { return file.ends_with(".hpp") || file.ends_with(".cpp"); }

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

std::vector<std::string> backticked(const std::string& cell) {
  static const std::regex kQuoted("`([^`]+)`");
  std::vector<std::string> words;
  for (std::sregex_iterator match(cell.begin(), cell.end(), kQuoted), end; match != end; ++match) {
    words.push_back((*match)[1]);
  }
  return words;
}

std::vector<std::string> cells_of(const std::string& row) {
  std::vector<std::string> cells;
  std::istringstream stream(row.substr(1));
  for (std::string cell; std::getline(stream, cell, '|');) cells.push_back(cell);
  return cells;
}

/// The layer a file of the repository belongs to: `map` for `src/map/x.cpp`.
std::optional<std::string> layer_of_file(const std::string& file) {
  static const std::regex kLayerFile("(?:include/linewright|src)/([^/]+)/.+");
  std::smatch match;
  if (!std::regex_match(file, match, kLayerFile)) return std::nullopt;
  return match[1];
}

/// The layer an `#include` written in `file` leads to, if it leads to a folder of a layer.
std::optional<std::string> layer_of_include(const std::string& file, const std::string& included) {
  for (const std::string& prefix : {std::string("include/"), std::string("src/"), std::string()}) {
    const fs::path path = fs::path(prefix + included).lexically_normal();
    if (auto layer = layer_of_file(path.generic_string())) return layer;
    const std::string from_include = "include/" + path.generic_string();
    if (auto layer = layer_of_file(from_include)) return layer;
  }
  const fs::path beside = (fs::path(file).parent_path() / included).lexically_normal();
  return layer_of_file(beside.generic_string());
}

/// Per layer everything it may include: itself and what it uses, directly or indirectly.
std::map<std::string, std::set<std::string>> closures_of(const std::vector<Layer>& layers) {
  std::map<std::string, std::set<std::string>> closures;
  for (const Layer& layer : layers) {
    std::set<std::string>& closure = closures[layer.name];
    closure.insert(layer.name);
    for (const std::string& lower : layer.uses) {
      closure.insert(lower);
      const auto known = closures.find(lower);
      if (known != closures.end()) closure.insert(known->second.begin(), known->second.end());
    }
  }
  return closures;
}

std::string join(std::vector<std::string> words) {
  std::sort(words.begin(), words.end());
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
  return text.empty() ? "nothing" : text;
}

std::vector<Layer> read_cmake_layers(const fs::path& root) {
  static const std::regex kComment("#[^\n]*");
  static const std::regex kCall("linewright_layer\\(([^)]*)\\)");
  const std::string text = std::regex_replace(read_file(root / "CMakeLists.txt"), kComment, "");
  std::vector<Layer> layers;
  for (std::sregex_iterator call(text.begin(), text.end(), kCall), end; call != end; ++call) {
    Layer layer;
    std::istringstream words((*call)[1].str());
    std::string keyword;
    for (std::string word; words >> word;) {
      if (word == "NAME" || word == "DEPENDS" || word == "LIBRARIES") {
        keyword = word;
      } else if (keyword == "NAME") {
        layer.name = word;
      } else {
        (keyword == "DEPENDS" ? layer.uses : layer.libraries).push_back(word);
      }
    }
    layers.push_back(std::move(layer));
  }
  return layers;
}

bool contains(const std::vector<std::string>& words, std::string_view word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

/// Whether `identifier` may be the function of the C or C++ library: called, not a member, not of
/// another namespace, and not the name in a declaration (`Tick time() const;`).
bool calls_library_function(const Identifier& identifier) {
  static const std::vector<std::string> kBeforeCalls = {"return", "else", "do", "case",
                                                        "co_return"};
  if (!identifier.after.starts_with("(")) return false;
  if (identifier.before == "." || identifier.before == "->") return false;
  if (identifier.global || identifier.qualifier == "std") return true;
  if (!identifier.qualifier.empty()) return false;
  if (identifier.before.empty() || contains(kBeforeCalls, identifier.before)) return true;
  static const std::string kOfTypes =
      "abcdefghijklmnopqrstuvwxyz"
      "ABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_>";
  return kOfTypes.find(identifier.before.back()) == std::string::npos;
}

/// What is wrong with using `identifier` in a layer; nothing if it is fine.
std::optional<std::string> impurity_of(const Identifier& identifier) {
  static const std::map<std::string, std::string, std::less<>> kNever = {
      {"cout", "prints"},
      {"cerr", "prints"},
      {"clog", "prints"},
      {"wcout", "prints"},
      {"wcerr", "prints"},
      {"stdout", "prints"},
      {"stderr", "prints"},
      {"system_clock", "reads a clock"},
      {"steady_clock", "reads a clock"},
      {"high_resolution_clock", "reads a clock"},
      {"utc_clock", "reads a clock"},
      {"file_clock", "reads a clock"},
      {"gettimeofday", "reads a clock"},
      {"clock_gettime", "reads a clock"},
      {"timespec_get", "reads a clock"},
      {"random_device", "uses global randomness"},
  };
  static const std::map<std::string, std::string, std::less<>> kNeverCalled = {
      {"printf", "prints"},
      {"fprintf", "prints"},
      {"vprintf", "prints"},
      {"vfprintf", "prints"},
      {"puts", "prints"},
      {"putchar", "prints"},
      {"println", "prints"},
      {"exit", "exits"},
      {"_Exit", "exits"},
      {"_exit", "exits"},
      {"quick_exit", "exits"},
      {"abort", "exits"},
      {"terminate", "exits"},
      {"rand", "uses global randomness"},
      {"srand", "uses global randomness"},
      {"drand48", "uses global randomness"},
  };
  const auto never = kNever.find(identifier.name);
  if (never != kNever.end()) return never->second;
  const bool is_print =
      identifier.name == "print" || identifier.name == "println" || identifier.name == "vprint";
  if (is_print && (identifier.qualifier == "fmt" || identifier.qualifier == "std")) return "prints";
  if (!calls_library_function(identifier)) return std::nullopt;
  const auto called = kNeverCalled.find(identifier.name);
  if (called != kNeverCalled.end()) return called->second;
  const bool qualified = identifier.global || identifier.qualifier == "std";
  if (qualified && (identifier.name == "time" || identifier.name == "clock")) {
    return "reads a clock";
  }
  static const std::regex kTimeArgument("\\(\\s*(nullptr|NULL|0|&\\s*\\w+)\\s*\\)[^]*");
  const std::string_view argument = identifier.after.substr(0, 80);
  const bool reads_time = identifier.name == "time" &&
                          std::regex_match(argument.begin(), argument.end(), kTimeArgument);
  return reads_time ? std::optional<std::string>("reads a clock") : std::nullopt;
}

}  // namespace

Architecture read_architecture(const fs::path& root) {
  Architecture architecture;
  std::string section;
  for (const std::string& line : lines_of(read_file(root / "ARCHITECTURE.md"))) {
    if (line.starts_with("## ")) section = line.substr(3);
    if (!line.starts_with("| `")) continue;
    const std::vector<std::string> cells = cells_of(line);
    if (section == "Layers" && cells.size() >= 3) {
      const std::string name = backticked(cells[0]).at(0);
      architecture.layers.push_back({name, backticked(cells[1]), backticked(cells[2])});
      architecture.folders.push_back("include/linewright/" + name);
      architecture.folders.push_back("src/" + name);
    } else if (section == "Folders") {
      architecture.folders.push_back(backticked(cells.at(0)).at(0));
    }
  }
  return architecture;
}

Violations find_folder_violations(const fs::path& root) {
  Violations violations;
  std::set<std::string> with_files;  // holds a file itself
  std::set<std::string> populated;   // holds a file, itself or deeper
  for (const std::string& file : files_of(root)) {
    fs::path folder = fs::path(file).parent_path();
    if (!folder.empty()) with_files.insert(folder.generic_string());
    for (; !folder.empty(); folder = folder.parent_path())
      populated.insert(folder.generic_string());
  }
  std::set<std::string> listed;
  std::vector<std::string> trees;
  for (std::string folder : read_architecture(root).folders) {
    if (folder.ends_with("/**")) {
      folder.resize(folder.size() - 3);
      trees.push_back(folder + "/");
    }
    if (!listed.insert(folder).second) violations.push_back(folder + ": listed twice");
    if (!populated.contains(folder)) violations.push_back(folder + ": listed, but holds no file");
  }
  for (const std::string& folder : with_files) {
    const bool in_tree = std::any_of(trees.begin(), trees.end(), [&](const std::string& tree) {
      return folder.starts_with(tree);
    });
    if (!listed.contains(folder) && !in_tree) violations.push_back(folder + ": not listed");
  }
  return violations;
}

Violations find_table_violations(const fs::path& root) {
  Violations violations;
  std::set<std::string> above;
  for (const Layer& layer : read_architecture(root).layers) {
    for (const std::string& lower : layer.uses) {
      if (!above.contains(lower)) {
        violations.push_back(layer.name + ": uses " + lower + ", which does not stand above it");
      }
    }
    if (!above.insert(layer.name).second) violations.push_back(layer.name + ": listed twice");
  }
  if (above.empty()) violations.emplace_back("ARCHITECTURE.md: lists no layer");
  return violations;
}

Violations find_include_violations(const fs::path& root) {
  static const std::regex kInclude("\\s*#\\s*include\\s*[<\"]([^>\"]+)[>\"].*");
  Violations violations;
  const auto closures = closures_of(read_architecture(root).layers);
  for (const std::string& file : files_of(root)) {
    const auto layer = layer_of_file(file);
    if (!layer || !is_cpp(file) || !closures.contains(*layer)) continue;
    const auto lines = lines_of(without_comments(read_file(root / file), StringLiterals::kKeep));
    for (std::size_t i = 0; i < lines.size(); ++i) {
      std::smatch match;
      if (lines[i].find("include") == std::string::npos) continue;
      if (!std::regex_match(lines[i], match, kInclude)) continue;
      const auto target = layer_of_include(file, match[1]);
      const bool is_ours =
          target && (closures.contains(*target) || match[1].str().starts_with("linewright/"));
      if (is_ours && !closures.at(*layer).contains(*target)) {
        violations.push_back(file + ":" + std::to_string(i + 1) + ": " + *layer +
                             " may not include " + match[1].str());
      }
    }
  }
  return violations;
}

Violations find_cmake_violations(const fs::path& root) {
  Violations violations;
  const std::vector<Layer> stated = read_architecture(root).layers;
  const std::vector<Layer> built = read_cmake_layers(root);
  const auto find = [](const std::vector<Layer>& layers, const std::string& name) {
    return std::find_if(layers.begin(), layers.end(),
                        [&](const Layer& layer) { return layer.name == name; });
  };
  for (const Layer& layer : stated) {
    const auto target = find(built, layer.name);
    if (target == built.end()) {
      violations.push_back(layer.name + ": not in CMakeLists.txt");
      continue;
    }
    const auto compare = [&](const char* what, const auto& in_table, const auto& in_cmake) {
      if (join(in_table) != join(in_cmake)) {
        violations.push_back(layer.name + ": " + what + " " + join(in_cmake) +
                             " in CMakeLists.txt, but " + join(in_table) + " in ARCHITECTURE.md");
      }
    };
    compare("DEPENDS", layer.uses, target->uses);
    compare("LIBRARIES", layer.libraries, target->libraries);
  }
  for (const Layer& layer : built) {
    if (find(stated, layer.name) == stated.end()) {
      violations.push_back(layer.name + ": not in ARCHITECTURE.md");
    }
  }
  return violations;
}

Violations find_purity_violations(const fs::path& root) {
  Violations violations;
  for (const std::string& file : files_of(root)) {
    if (!layer_of_file(file) || !is_cpp(file) || file.ends_with("_test.cpp")) continue;
    const std::string code = without_comments(read_file(root / file), StringLiterals::kBlank);
    for (const Identifier& identifier : identifiers_of(code)) {
      if (const auto reason = impurity_of(identifier)) {
        violations.push_back(file + ":" + std::to_string(identifier.line) + ": " +
                             std::string(identifier.name) + " " + *reason);
      }
    }
  }
  return violations;
}

Violations find_pragma_violations(const fs::path& root) {
  Violations violations;
  for (const std::string& file : files_of(root)) {
    if (!file.ends_with(".hpp")) continue;
    const auto lines = lines_of(without_comments(read_file(root / file), StringLiterals::kKeep));
    if (!contains(lines, "#pragma once")) violations.push_back(file + ": lacks #pragma once");
  }
  return violations;
}

Violations find_outside_references(const fs::path& root) {
  // Put together here, so that this file passes its own check.
  const std::string outside = std::string("..") + "/shared";
  Violations violations;
  for (const std::string& file : files_of(root)) {
    if (read_file(root / file).find(outside) != std::string::npos) {
      violations.push_back(file + ": mentions " + outside);
    }
  }
  return violations;
}

}  // namespace linewright::architecture
