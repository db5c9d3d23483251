#include "linewright/training/tensorboard.hpp"

#include <bit>
#include <utility>

#include "crc32c.hpp"

namespace linewright {
namespace {

/// Wire types of protocol buffers.
enum class Wire : std::uint8_t { kVarint = 0, kFixed64 = 1, kBytes = 2, kFixed32 = 5 };

void put_varint(std::string& out, std::uint64_t value) {
  while (value >= 0x80) {
    out += static_cast<char>(value | 0x80);
    value >>= 7;
  }
  out += static_cast<char>(value);
}

/// Little-endian, on every machine.
template <class Unsigned>
void put_fixed(std::string& out, Unsigned value) {
  for (std::size_t i = 0; i < sizeof(Unsigned); ++i) {
    out += static_cast<char>((value >> (8 * i)) & 0xff);
  }
}

void put_key(std::string& out, std::uint32_t field, Wire wire) {
  put_varint(out, (field << 3) | static_cast<std::uint32_t>(wire));
}

void put_bytes(std::string& out, std::uint32_t field, std::string_view bytes) {
  put_key(out, field, Wire::kBytes);
  put_varint(out, bytes.size());
  out += bytes;
}

/// tensorflow.Event: wall_time = 1.
std::string event_at(double wall_time_s) {
  std::string event;
  put_key(event, 1, Wire::kFixed64);
  put_fixed(event, std::bit_cast<std::uint64_t>(wall_time_s));
  return event;
}

/// CRCs of data that holds CRCs are weak; TFRecord therefore rotates them and adds a constant.
std::uint32_t masked_crc(std::string_view bytes) {
  return std::rotr(crc32c(bytes), 15) + 0xa282ead8U;
}

}  // namespace

TensorBoardLog::TensorBoardLog(LogFile file) : file_(std::move(file)) {}

TensorBoardLog TensorBoardLog::create(const std::string& path, double wall_time_s) {
  TensorBoardLog log(LogFile::create(path));
  std::string event = event_at(wall_time_s);
  put_bytes(event, 3, "brain.Event:2");  // Event.file_version
  log.record(event);
  log.flush();
  return log;
}

TensorBoardLog TensorBoardLog::reopen(const std::string& path, std::uint64_t size) {
  return TensorBoardLog(LogFile::reopen(path, size));
}

void TensorBoardLog::scalar(std::string_view tag, std::int64_t step, float value,
                            double wall_time_s) {
  std::string point;  // Summary.Value: tag = 1, simple_value = 2
  put_bytes(point, 1, tag);
  put_key(point, 2, Wire::kFixed32);
  put_fixed(point, std::bit_cast<std::uint32_t>(value));
  std::string summary;  // Summary: value = 1
  put_bytes(summary, 1, point);
  std::string event = event_at(wall_time_s);
  put_key(event, 2, Wire::kVarint);  // Event.step
  put_varint(event, static_cast<std::uint64_t>(step));
  put_bytes(event, 5, summary);  // Event.summary
  record(event);
}

void TensorBoardLog::record(std::string_view event) {
  std::string header;
  put_fixed(header, static_cast<std::uint64_t>(event.size()));
  std::string framed = header;
  put_fixed(framed, masked_crc(header));
  framed += event;
  put_fixed(framed, masked_crc(event));
  file_.append(framed);
}

}  // namespace linewright
