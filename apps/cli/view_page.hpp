#pragma once

#include <string>
#include <vector>

namespace linewright::cli {

/// A log within the page.
struct NamedText {
  std::string name;
  std::string text;
};

/// The page that `make web` builds: build/web/linewright-view.html here, or web/ beside the program
/// or above it. Throws ScenarioError when there is none.
[[nodiscard]] std::string load_page();

/// The page with the logs inside, so that it needs nothing else. No text of a log can end the
/// element that it stands in. Throws ScenarioError when the page has no single place for them.
[[nodiscard]] std::string page_with(const std::string& page, const std::vector<NamedText>& logs);

}  // namespace linewright::cli
