#pragma once

// The rules of ARCHITECTURE.md as functions on a source tree, so that the test can run them on this
// repository and on small trees that break one rule each.
//
// Every `find_...` function returns one line per violation, sorted by path, and an empty list if
// the rule holds. They read files below `root` and nothing else.

#include <filesystem>
#include <string>
#include <vector>

namespace linewright::architecture {

/// One row of the table of layers, or one `linewright_layer()` call.
struct Layer {
  std::string name;
  std::vector<std::string> uses;       ///< lower layers named directly
  std::vector<std::string> libraries;  ///< external CMake targets
};

/// What ARCHITECTURE.md says.
struct Architecture {
  std::vector<Layer> layers;         ///< lowest first
  std::vector<std::string> folders;  ///< every listed folder, `/**` at the end if with subfolders
};

using Violations = std::vector<std::string>;

/// Reads the tables of `root`/ARCHITECTURE.md. A missing file gives an empty Architecture.
Architecture read_architecture(const std::filesystem::path& root);

/// Folders that hold files but are not listed, are listed twice, or are listed but hold nothing.
Violations find_folder_violations(const std::filesystem::path& root);

/// Rows that use a layer which does not stand above them; a document without any row.
Violations find_table_violations(const std::filesystem::path& root);

/// `#include`s of a layer outside the transitive closure of what the table allows.
Violations find_include_violations(const std::filesystem::path& root);

/// Layers, DEPENDS or LIBRARIES in CMakeLists.txt that differ from the table.
Violations find_cmake_violations(const std::filesystem::path& root);

/// Printing, exiting, clocks and global randomness in the layers (tests excepted).
Violations find_purity_violations(const std::filesystem::path& root);

/// Headers without `#pragma once`.
Violations find_pragma_violations(const std::filesystem::path& root);

/// Files that refer to a shared folder beside the repository instead of something in it.
Violations find_outside_references(const std::filesystem::path& root);

}  // namespace linewright::architecture
