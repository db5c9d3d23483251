#include "view_session.hpp"

#include <chrono>
#include <utility>

namespace linewright::cli {
namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
using boost::system::error_code;

constexpr std::size_t kMostHeader = 8U << 10U;
constexpr std::size_t kPiece = 64U << 10U;
constexpr std::size_t kMostDiscarded = 1U << 20U;
constexpr auto kRequestTime = std::chrono::seconds(5);  // for a whole request, or between two
constexpr auto kSendTime = std::chrono::seconds(20);    // for every piece
constexpr auto kGrowth = std::chrono::milliseconds(40);
constexpr auto kLastWords = std::chrono::seconds(1);

}  // namespace

ViewSession::ViewSession(asio::ip::tcp::socket socket, const Served& served, std::size_t& sending)
    : stream_(std::move(socket)),
      growth_(stream_.get_executor()),
      served_(served),
      sending_(sending),
      buffer_(2 * kMostHeader) {}

ViewSession::~ViewSession() {
  if (serializer_) --sending_;
}

void ViewSession::cut_off() {
  growth_.cancel();
  stream_.close();
}

void ViewSession::read() {
  waits_ = true;
  parser_.emplace();
  parser_->header_limit(kMostHeader);
  stream_.expires_after(kRequestTime);
  http::async_read_header(stream_, buffer_, *parser_,
                          [self = shared_from_this()](error_code error, std::size_t) {
                            self->waits_ = false;
                            self->answer(error);
                          });
}

void ViewSession::answer(error_code error) {
  const auto& in_text = http::make_error_code(http::error::bad_method).category();
  const bool is_gone =
      error == http::error::end_of_stream || (error && error.category() != in_text);
  if (is_gone) return close_gently();
  if (error == http::error::header_limit || error == http::error::buffer_overflow) {
    return send(refusal(http::status::request_header_fields_too_large, "The request is too long."));
  }
  if (error) return send(refusal(http::status::bad_request, "This is no request."));
  if (!parser_->is_done()) {  // a body would follow; it is not waited for
    return send(refusal(http::status::payload_too_large, "A request has no body here."));
  }
  const Request& request = parser_->get();
  if (const auto log = log_asked_for(request, served_)) {
    return send_log(*log, request.method() == http::verb::get);
  }
  send(answer_to(request, served_));
}

void ViewSession::send(TextAnswer answer) {
  const auto sent = std::make_shared<TextAnswer>(std::move(answer));
  stream_.expires_after(kSendTime);
  http::async_write(stream_, *sent,
                    [self = shared_from_this(), sent](error_code error, std::size_t) {
                      if (!error) self->next(sent->keep_alive());
                    });
}

void ViewSession::send_log(std::size_t log, bool with_body) {
  const Request& request = parser_->get();
  const bool in_chunks = request.version() >= 11;  // else the end of the connection ends the log
  log_answer_.emplace(http::status::ok, request.version());
  set_headers(*log_answer_, "application/jsonl; charset=utf-8");
  log_answer_->chunked(in_chunks);
  log_answer_->keep_alive(in_chunks && request.keep_alive());
  log_answer_->body().data = nullptr;
  log_answer_->body().more = true;
  if (!serializer_) ++sending_;
  serializer_.emplace(*log_answer_);
  log_ = log;
  offset_ = 0;
  stream_.expires_after(kSendTime);
  http::async_write_header(stream_, *serializer_,
                           [self = shared_from_this(), with_body](error_code error, std::size_t) {
                             if (error) return;
                             if (with_body) return self->send_piece();
                             const bool keep_alive = self->log_answer_->keep_alive();
                             self->serializer_.reset();
                             --self->sending_;
                             self->next(keep_alive);
                           });
}

void ViewSession::send_piece() {
  bool at_end = false;
  piece_ = served_.logs[log_].text->read(offset_, kPiece, at_end);
  if (piece_.empty() && !at_end) return wait_for_more();
  offset_ += piece_.size();
  auto& body = log_answer_->body();
  body.data = piece_.empty() ? nullptr : piece_.data();
  body.size = piece_.size();
  body.more = !at_end;
  stream_.expires_after(kSendTime);
  http::async_write(stream_, *serializer_,
                    [self = shared_from_this(), at_end](error_code error, std::size_t) {
                      if (error == http::error::need_buffer) error = {};
                      if (error) return;
                      if (!at_end) return self->send_piece();
                      const bool keep_alive = self->log_answer_->keep_alive();
                      self->serializer_.reset();
                      --self->sending_;
                      self->next(keep_alive);
                    });
}

void ViewSession::wait_for_more() {
  stream_.expires_never();
  growth_.expires_after(kGrowth);
  growth_.async_wait([self = shared_from_this()](error_code error) {
    if (!error) self->send_piece();
  });
}

void ViewSession::next(bool keep_alive) {
  if (keep_alive) return read();
  close_gently();
}

/// Says that nothing more will come and throws away what still comes in: closing at once could
/// take the answer away from who is still sending.
void ViewSession::close_gently() {
  error_code ignored;
  stream_.socket().shutdown(asio::ip::tcp::socket::shutdown_send, ignored);
  offset_ = 0;
  stream_.expires_after(kLastWords);
  discard();
}

void ViewSession::discard() {
  if (offset_ > kMostDiscarded) return;
  buffer_.clear();
  stream_.async_read_some(buffer_.prepare(kMostHeader),
                          [self = shared_from_this()](error_code error, std::size_t size) {
                            if (error) return;
                            self->offset_ += size;
                            self->discard();
                          });
}

}  // namespace linewright::cli
