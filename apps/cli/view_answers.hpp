#pragma once

#include <boost/beast/http.hpp>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "view_server.hpp"

// What the server answers, apart from sending it.
namespace linewright::cli {

namespace http = boost::beast::http;
using Request = http::request<http::empty_body>;
using TextAnswer = http::response<http::string_body>;

/// What is served, and under which port.
struct Served {
  std::string page;
  std::vector<ServedLog> logs;
  std::string logs_json;
  std::uint16_t port = 0;
};

[[nodiscard]] std::string logs_json_of(const std::vector<ServedLog>& logs);

/// The log that the request asks for, when it may have it.
[[nodiscard]] std::optional<std::size_t> log_asked_for(const Request& request,
                                                       const Served& served);

/// The answer to every other request: the page, the list of logs, or why there is none.
[[nodiscard]] TextAnswer answer_to(const Request& request, const Served& served);

/// The answer to what is no request.
[[nodiscard]] TextAnswer refusal(http::status status, std::string_view words);

/// The headers that every answer has: nothing is kept, guessed, framed or taken from elsewhere.
void set_headers(http::response_header<>& answer, const char* type);

}  // namespace linewright::cli
