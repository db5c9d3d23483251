#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <string>

#include "growing_text.hpp"
#include "view_page.hpp"
#include "view_server.hpp"

namespace linewright::cli {

/// How a command serves the page.
struct ServeArguments {
  std::uint16_t port = 0;  ///< 0: a free one
  bool no_open = false;
};

void add_serve_options(CLI::App& app, ServeArguments& arguments);

/// Opens the address with xdg-open where there is a desktop, unless told not to.
void open_browser(const std::string& address, const ServeArguments& arguments);

}  // namespace linewright::cli
