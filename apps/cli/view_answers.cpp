#include "view_answers.hpp"

#include <fmt/format.h>

#include <charconv>
#include <nlohmann/json.hpp>
#include <system_error>

namespace linewright::cli {
namespace {

// The page is one file with its scripts and styles inside, and speaks to this server only.
constexpr const char* kPolicy =
    "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; "
    "img-src data: blob:; font-src data:; worker-src blob:; connect-src 'self'; base-uri 'none'; "
    "form-action 'none'; frame-ancestors 'none'";

std::string_view text_of(boost::beast::string_view text) { return {text.data(), text.size()}; }

/// Whether `place` (of Host, or of Origin after its scheme) is this server.
bool is_here(std::string_view place, std::uint16_t port) {
  return place == fmt::format("127.0.0.1:{}", port) || place == fmt::format("localhost:{}", port);
}

/// Other pages in the same browser, and names that lead to this machine, may not ask.
bool is_foreign(const Request& request, std::uint16_t port) {
  constexpr std::string_view kScheme = "http://";
  if (!is_here(text_of(request[http::field::host]), port)) return true;
  const auto origin = request.find(http::field::origin);
  if (origin == request.end()) return false;
  const std::string_view from = text_of(origin->value());
  return !from.starts_with(kScheme) || !is_here(from.substr(kScheme.size()), port);
}

std::string_view path_of(const Request& request) {
  const std::string_view target = text_of(request.target());
  return target.substr(0, target.find('?'));
}

bool is_reading(const Request& request) {
  return request.method() == http::verb::get || request.method() == http::verb::head;
}

}  // namespace

void set_headers(http::response_header<>& answer, const char* type) {
  answer.set(http::field::content_type, type);
  answer.set(http::field::cache_control, "no-store");
  answer.set("Content-Security-Policy", kPolicy);
  answer.set("X-Content-Type-Options", "nosniff");
  answer.set("X-Frame-Options", "DENY");
  answer.set("Referrer-Policy", "no-referrer");
  answer.set("Cross-Origin-Opener-Policy", "same-origin");
  answer.set("Cross-Origin-Resource-Policy", "same-origin");
}

std::string logs_json_of(const std::vector<ServedLog>& logs) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const ServedLog& log : logs) {
    list.push_back(
        {{"name", log.name}, {"href", fmt::format("logs/{}", list.size())}, {"live", log.live}});
  }
  return nlohmann::ordered_json{{"logs", std::move(list)}}.dump(
      -1, ' ', true, nlohmann::ordered_json::error_handler_t::replace);
}

TextAnswer refusal(http::status status, std::string_view words) {
  TextAnswer answer(status, 11);
  set_headers(answer, "text/plain; charset=utf-8");
  answer.body() = fmt::format("{}\n", words);
  answer.keep_alive(false);
  answer.prepare_payload();
  return answer;
}

std::optional<std::size_t> log_asked_for(const Request& request, const Served& served) {
  constexpr std::string_view kFolder = "/logs/";
  const std::string_view path = path_of(request);
  if (!is_reading(request) || is_foreign(request, served.port) || !path.starts_with(kFolder)) {
    return std::nullopt;
  }
  const std::string_view digits = path.substr(kFolder.size());
  std::size_t number = 0;
  const auto [end, error] = std::from_chars(digits.begin(), digits.end(), number);
  const bool is_number = error == std::errc() && end == digits.end();
  if (!is_number || std::to_string(number) != digits || number >= served.logs.size()) {
    return std::nullopt;
  }
  return number;
}

TextAnswer answer_to(const Request& request, const Served& served) {
  if (is_foreign(request, served.port)) {
    return refusal(http::status::forbidden,
                   "This server answers only its own page: open it by its address.");
  }
  if (!is_reading(request)) {
    TextAnswer answer = refusal(http::status::method_not_allowed, "GET and HEAD only.");
    answer.set(http::field::allow, "GET, HEAD");
    return answer;
  }
  const std::string_view path = path_of(request);
  const bool is_page = path == "/";
  if (!is_page && path != "/logs.json") {
    return refusal(http::status::not_found, "There is nothing here: see / and /logs.json.");
  }
  TextAnswer answer(http::status::ok, request.version());
  set_headers(answer, is_page ? "text/html; charset=utf-8" : "application/json");
  answer.body() = is_page ? served.page : served.logs_json;
  answer.keep_alive(request.keep_alive());
  answer.prepare_payload();
  if (request.method() == http::verb::head) answer.body().clear();  // its length stays
  return answer;
}

}  // namespace linewright::cli
