#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "image_formats.hpp"

// PGM as netpbm defines it: "P2" or "P5", width, height and the largest value as text between which
// there is white space and comments, then the pixels: as text, or as bytes (two if the largest
// value is above 255, the higher one first).
namespace linewright::map_image {
namespace {

constexpr std::uint32_t kLargestNumber = 1'000'000'000;

bool is_space(char c) {
  return c == ' ' || c == '\t' || c == '\n' || c == '\r' || c == '\v' || c == '\f';
}

bool is_digit(char c) { return c >= '0' && c <= '9'; }

class PgmReader {
 public:
  PgmReader(std::string_view bytes, const std::string& file) : rest_(bytes), file_(file) {}

  GrayImage read() {
    const bool plain = rest_.starts_with("P2");
    rest_.remove_prefix(2);
    const std::uint32_t width = header_number("width");
    const std::uint32_t height = header_number("height");
    most_ = header_number("largest value");
    if (most_ < 1 || most_ > GrayImage::kFull) {
      fail(file_, fmt::format("the header's largest value is {}", most_),
           "write one from 1 to 65535");
    }
    check_size(file_, width, height);
    image_.width = static_cast<std::int32_t>(width);
    image_.height = static_cast<std::int32_t>(height);
    plain ? read_plain() : read_raw();
    return std::move(image_);
  }

 private:
  [[nodiscard]] std::size_t pixels() const {
    return static_cast<std::size_t>(image_.width) * static_cast<std::size_t>(image_.height);
  }

  [[noreturn]] void truncated() const { fail_truncated(file_, image_.width, image_.height); }

  void skip_space() {
    while (!rest_.empty()) {
      if (rest_.front() == '#') {
        rest_.remove_prefix(std::min(rest_.find_first_of("\r\n"), rest_.size()));
      } else if (is_space(rest_.front())) {
        rest_.remove_prefix(1);
      } else {
        return;
      }
    }
  }

  /// The digits at the front; saturates.
  std::uint32_t take_number() {
    std::uint64_t number = 0;
    while (!rest_.empty() && is_digit(rest_.front())) {
      number = std::min<std::uint64_t>(
          number * 10 + static_cast<std::uint64_t>(rest_.front() - '0'), kLargestNumber);
      rest_.remove_prefix(1);
    }
    return static_cast<std::uint32_t>(number);
  }

  std::uint32_t header_number(const char* what) {
    skip_space();
    if (rest_.empty() || !is_digit(rest_.front())) {
      fail(file_, fmt::format("the image's header has no {}", what),
           "a PGM image starts with P2 or P5, width, height and the largest value: "
           "P5 640 480 255");
    }
    return take_number();
  }

  std::uint16_t shade(std::uint32_t value) {
    if (value > most_) {
      const std::size_t at = image_.shade.size();
      const auto width = static_cast<std::size_t>(image_.width);
      fail(file_,
           fmt::format("pixel {} of row {} is {}, but the header's largest value is {}",
                       at % width + 1, at / width + 1, value, most_),
           "the header does not belong to these pixels: write the image again");
    }
    return static_cast<std::uint16_t>((value * std::uint64_t{GrayImage::kFull} + most_ / 2) /
                                      most_);
  }

  void read_plain() {
    // A pixel takes a digit and the space before it: what cannot be there is not allocated.
    if (rest_.size() < 2 * pixels()) truncated();
    image_.shade.reserve(pixels());
    while (image_.shade.size() < pixels()) {
      skip_space();
      if (rest_.empty()) truncated();
      if (!is_digit(rest_.front())) {
        fail(file_,
             fmt::format("byte 0x{:02x} among the pixels of a P2 image",
                         static_cast<unsigned char>(rest_.front())),
             "the pixels of P2 are decimal numbers; those of P5 are bytes");
      }
      image_.shade.push_back(shade(take_number()));
    }
  }

  void read_raw() {
    if (rest_.empty() || !is_space(rest_.front())) truncated();
    rest_.remove_prefix(1);  // exactly one: the next byte is a pixel, whatever it is
    const std::size_t bytes_each = most_ > 255 ? 2 : 1;
    if (rest_.size() < bytes_each * pixels()) truncated();
    image_.shade.reserve(pixels());
    const auto byte = [&](std::size_t i) {
      return static_cast<std::uint32_t>(static_cast<unsigned char>(rest_[i]));
    };
    for (std::size_t i = 0; i < pixels(); ++i) {
      image_.shade.push_back(
          shade(bytes_each == 1 ? byte(i) : byte(2 * i) * 256 + byte(2 * i + 1)));
    }
  }

  std::string_view rest_;
  const std::string& file_;
  std::uint32_t most_ = 0;
  GrayImage image_;
};

}  // namespace

bool is_pgm(std::string_view bytes) {
  return bytes.size() > 2 && (bytes.starts_with("P2") || bytes.starts_with("P5")) &&
         (is_space(bytes[2]) || bytes[2] == '#');
}

GrayImage read_pgm(std::string_view bytes, const std::string& file) {
  return PgmReader(bytes, file).read();
}

}  // namespace linewright::map_image
