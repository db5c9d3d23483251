#pragma once

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>

#include "view_answers.hpp"

namespace linewright::cli {

/// One connection: reads requests and answers them, one after the other. Lives as long as
/// something is pending on it.
class ViewSession : public std::enable_shared_from_this<ViewSession> {
 public:
  /// `served` and `sending`, the number of logs that are being sent, outlive it.
  ViewSession(boost::asio::ip::tcp::socket socket, const Served& served, std::size_t& sending);
  ~ViewSession();
  ViewSession(const ViewSession&) = delete;
  ViewSession& operator=(const ViewSession&) = delete;

  void start() { read(); }

  /// Whether it has no request to answer yet.
  [[nodiscard]] bool waits() const { return waits_; }

  /// Closes the connection.
  void cut_off();

 private:
  using LogAnswer = http::response<http::buffer_body>;

  void read();
  void answer(boost::system::error_code error);
  void send(TextAnswer answer);
  void send_log(std::size_t log, bool with_body);
  void send_piece();
  void wait_for_more();
  void next(bool keep_alive);
  void close_gently();
  void discard();

  boost::beast::tcp_stream stream_;
  boost::asio::steady_timer growth_;
  const Served& served_;
  std::size_t& sending_;
  bool waits_ = false;
  boost::beast::flat_buffer buffer_;
  std::optional<http::request_parser<http::empty_body>> parser_;
  // The log that is being sent.
  std::optional<LogAnswer> log_answer_;
  std::optional<http::response_serializer<http::buffer_body>> serializer_;
  std::size_t log_ = 0;
  std::size_t offset_ = 0;
  std::string piece_;
};

}  // namespace linewright::cli
