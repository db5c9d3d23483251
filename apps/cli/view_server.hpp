#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "growing_text.hpp"

namespace linewright::cli {

struct ServedLog {
  std::string name;
  std::shared_ptr<const GrowingText> text;
  bool live = false;  ///< still growing when the server starts
};

/// Serves the page that shows logs, and the logs, on 127.0.0.1 alone:
///
///     GET /           the page
///     GET /logs.json  {"logs": [{"name", "href": "logs/0", "live"}]}
///     GET /logs/N     a log, sent in pieces while it grows
///
/// GET and HEAD only. Requests whose Host or Origin is not this server are refused (403), so that
/// no other page and no name that leads here can read the logs. Headers are limited in size, bodies
/// are not taken, and who does not send its request or take its answer within seconds is cut off;
/// when there are too many connections, the one that has waited longest for its request is.
class ViewServer {
 public:
  /// Listens; `port` 0: a free one. Throws ScenarioError when it cannot.
  ViewServer(std::string page, std::vector<ServedLog> logs, std::uint16_t port);
  ~ViewServer();
  ViewServer(const ViewServer&) = delete;
  ViewServer& operator=(const ViewServer&) = delete;

  /// http://127.0.0.1:PORT/
  [[nodiscard]] std::string address() const;

  /// Serves until `go_on`, which is asked every few hundredths of a second with the number of logs
  /// that are being sent, is false. Everything runs in the calling thread.
  void run(const std::function<bool(std::size_t sending)>& go_on);

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace linewright::cli
