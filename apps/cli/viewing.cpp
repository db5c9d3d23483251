#include "viewing.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <unistd.h>

#include <array>
#include <cstdlib>

namespace linewright::cli {

void add_serve_options(CLI::App& app, ServeArguments& arguments) {
  app.add_option("--port", arguments.port, "Port on 127.0.0.1 (default: a free one)")
      ->check(CLI::Range(1, 65535))
      ->type_name("N");
  app.add_flag("--no-open", arguments.no_open, "Do not open the browser");
}

void open_browser(const std::string& address, const ServeArguments& arguments) {
  const bool is_desktop =
      std::getenv("DISPLAY") != nullptr || std::getenv("WAYLAND_DISPLAY") != nullptr;
  if (arguments.no_open || !is_desktop) return;
  // Its own words are nobody's business here; when it is missing, the address has been printed.
  posix_spawn_file_actions_t quiet;
  posix_spawn_file_actions_init(&quiet);
  posix_spawn_file_actions_addopen(&quiet, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&quiet, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  std::string program = "xdg-open";
  std::string url = address;
  const std::array<char*, 3> words{program.data(), url.data(), nullptr};
  pid_t child = 0;
  posix_spawnp(&child, program.c_str(), &quiet, nullptr, words.data(), environ);
  posix_spawn_file_actions_destroy(&quiet);
}

}  // namespace linewright::cli
