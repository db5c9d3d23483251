#include "view_page.hpp"

#include <fmt/format.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <system_error>

#include "linewright/base/diagnostic.hpp"
#include "linewright/base/files.hpp"

namespace linewright::cli {
namespace {

constexpr const char* kFile = "linewright-view.html";
constexpr std::size_t kLargestPage = 64U << 20U;
constexpr std::string_view kBefore = "<script type=\"application/json\" id=\"linewright-logs\">";
constexpr std::string_view kEmpty = "null";
constexpr std::string_view kAfter = "</script>";

std::vector<std::string> folders() {
  std::vector<std::string> found = shipped_folders("web");
  for (std::string& folder : shipped_folders("build/web")) found.push_back(std::move(folder));
  return found;
}

/// JSON in ASCII that means the same within HTML: `<`, `>` and `&` only stand in texts.
std::string json_for_html(const nlohmann::ordered_json& json) {
  const std::string plain =
      json.dump(-1, ' ', true, nlohmann::ordered_json::error_handler_t::replace);
  std::string safe;
  safe.reserve(plain.size() + plain.size() / 64);
  for (const char c : plain) {
    if (c == '<' || c == '>' || c == '&') {
      safe += fmt::format("\\u{:04x}", static_cast<unsigned char>(c));
    } else {
      safe += c;
    }
  }
  return safe;
}

}  // namespace

std::string load_page() {
  for (const std::string& folder : folders()) {
    const std::string file = (std::filesystem::path(folder) / kFile).string();
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(file, ignored)) continue;
    std::string reason;
    auto page = read_file(file, kLargestPage, reason);
    if (page && page->size() <= kLargestPage) return std::move(*page);
    throw ScenarioError(file, "cannot be read: " + (page ? "it is too large" : reason),
                        "build it again: make web");
  }
  throw ScenarioError({}, fmt::format("the page {} is not here", kFile),
                      "build it: make web (needs Node.js); it is looked for in build/web, and in "
                      "web/ beside the program and in the folders above it");
}

std::string page_with(const std::string& page, const std::vector<NamedText>& logs) {
  const std::string slot = std::string(kBefore) + std::string(kEmpty) + std::string(kAfter);
  const std::size_t at = page.find(slot);
  if (at == std::string::npos || page.find(slot, at + 1) != std::string::npos) {
    throw ScenarioError({}, fmt::format("the page {} has no place for logs", kFile),
                        "it is of another version: build it again with make web");
  }
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const NamedText& log : logs) list.push_back({{"name", log.name}, {"text", log.text}});
  std::string filled = page;
  filled.replace(at + kBefore.size(), kEmpty.size(), json_for_html({{"logs", std::move(list)}}));
  return filled;
}

}  // namespace linewright::cli
