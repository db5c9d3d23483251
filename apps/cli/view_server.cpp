#include "view_server.hpp"

#include <fmt/format.h>

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core.hpp>
#include <chrono>
#include <deque>
#include <utility>

#include "linewright/base/diagnostic.hpp"
#include "view_session.hpp"

namespace linewright::cli {
namespace {

namespace asio = boost::asio;
using asio::ip::tcp;
using boost::system::error_code;

constexpr std::size_t kMostConnections = 200;
constexpr auto kPoll = std::chrono::milliseconds(50);

}  // namespace

class ViewServer::Implementation {
 public:
  Implementation(std::string page, std::vector<ServedLog> logs, std::uint16_t port) {
    listen(port);
    served_.page = std::move(page);
    served_.logs_json = logs_json_of(logs);
    served_.logs = std::move(logs);
    served_.port = acceptor_.local_endpoint().port();
  }

  [[nodiscard]] std::uint16_t port() const { return served_.port; }

  void run(const std::function<bool(std::size_t)>& go_on) {
    accept();
    poll(go_on);
    io_.run();
  }

 private:
  void listen(std::uint16_t port) {
    const tcp::endpoint here(asio::ip::address_v4::loopback(), port);
    error_code error;
    acceptor_.open(here.protocol(), error);
    if (!error) acceptor_.set_option(asio::socket_base::reuse_address(true), error);
    if (!error) acceptor_.bind(here, error);
    if (!error) acceptor_.listen(asio::socket_base::max_listen_connections, error);
    if (error) {
      throw ScenarioError(
          {}, fmt::format("the port {} of 127.0.0.1 cannot be used: {}", port, error.message()),
          "name another port, or none for a free one");
    }
  }

  void accept() {
    acceptor_.async_accept([this](error_code error, tcp::socket socket) {
      if (error == asio::error::operation_aborted) return;
      if (error) {  // out of descriptors: some will be free again soon
        retry_.expires_after(kPoll);
        retry_.async_wait([this](error_code stopped) {
          if (!stopped) accept();
        });
        return;
      }
      make_room();
      const auto session = std::make_shared<ViewSession>(std::move(socket), served_, sending_);
      sessions_.push_back(session);
      session->start();
      accept();
    });
  }

  /// Cuts off who has waited longest for its request, rather than turning away who comes now.
  void make_room() {
    std::erase_if(sessions_, [](const auto& session) { return session.expired(); });
    if (sessions_.size() < kMostConnections) return;
    for (const auto& waiting : sessions_) {
      const auto session = waiting.lock();
      if (session && session->waits()) return session->cut_off();
    }
    if (const auto oldest = sessions_.front().lock()) oldest->cut_off();
  }

  void poll(const std::function<bool(std::size_t)>& go_on) {
    timer_.expires_after(kPoll);
    timer_.async_wait([this, &go_on](error_code) {
      if (go_on(sending_)) return poll(go_on);
      io_.stop();
    });
  }

  // Sessions end with io_ at the latest, and use these.
  Served served_;
  std::size_t sending_ = 0;

  asio::io_context io_{1};
  tcp::acceptor acceptor_{io_};
  asio::steady_timer timer_{io_};
  asio::steady_timer retry_{io_};
  std::deque<std::weak_ptr<ViewSession>> sessions_;  ///< in the order in which they came
};

ViewServer::ViewServer(std::string page, std::vector<ServedLog> logs, std::uint16_t port)
    : implementation_(std::make_unique<Implementation>(std::move(page), std::move(logs), port)) {}

ViewServer::~ViewServer() = default;

std::string ViewServer::address() const {
  return fmt::format("http://127.0.0.1:{}/", implementation_->port());
}

void ViewServer::run(const std::function<bool(std::size_t)>& go_on) { implementation_->run(go_on); }

}  // namespace linewright::cli
