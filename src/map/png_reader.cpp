#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <array>
#include <csetjmp>
#include <cstring>
#include <new>
#include <vector>

#include "image_formats.hpp"

// libpng reports errors by longjmp. So everything that it may jump out of is in guarded(), whose
// callbacks own nothing: what must be freed lives outside, and messages are kept in plain arrays.
namespace linewright::map_image {
namespace {

/// Deflate shrinks to no less than about 1/1030: an image that claims more cannot be whole.
constexpr double kBestCompression = 1100.0;

struct Source {
  const char* data = nullptr;
  std::size_t left = 0;
  std::array<char, 128> message{};
};

extern "C" {

void on_png_error(png_structp png, png_const_charp message) {
  auto* source = static_cast<Source*>(png_get_error_ptr(png));
  std::strncpy(source->message.data(), message, source->message.size() - 1);
  png_longjmp(png, 1);
}

void on_png_warning(png_structp, png_const_charp) {}  // libpng would print it

void on_png_read(png_structp png, png_bytep to, png_size_t count) {
  auto* source = static_cast<Source*>(png_get_io_ptr(png));
  if (count > source->left) png_error(png, "the data end early");
  std::memcpy(to, source->data, count);
  source->data += count;
  source->left -= count;
}

}  // extern "C"

/// One libpng reader and what it allocated.
class PngHandle {
 public:
  explicit PngHandle(std::string_view bytes) : source_{bytes.data(), bytes.size(), {}} {
    png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, &source_, on_png_error, on_png_warning);
    if (png_ == nullptr) throw std::bad_alloc();
    info_ = png_create_info_struct(png_);
    if (info_ == nullptr) {
      png_destroy_read_struct(&png_, nullptr, nullptr);
      throw std::bad_alloc();
    }
    png_set_read_fn(png_, &source_, on_png_read);
  }
  ~PngHandle() { png_destroy_read_struct(&png_, &info_, nullptr); }
  PngHandle(const PngHandle&) = delete;
  PngHandle& operator=(const PngHandle&) = delete;

  /// Whether action(png, info) came through without an error of libpng. The action and what it
  /// calls must hold nothing that needs a destructor.
  template <class Action>
  [[nodiscard]] bool guarded(const Action& action) {
    if (setjmp(png_jmpbuf(png_)) != 0) return false;
    action(png_, info_);
    return true;
  }

  [[nodiscard]] const char* message() const { return source_.message.data(); }

 private:
  Source source_;
  png_structp png_ = nullptr;
  png_infop info_ = nullptr;
};

/// How the pixels come out of libpng, once it knows what to turn them into.
struct Layout {
  std::int64_t width = 0;
  std::int64_t height = 0;
  std::size_t row_bytes = 0;
  int passes = 1;
  int channels = 1;
  int depth = 8;

  [[nodiscard]] bool has_alpha() const { return channels == 2 || channels == 4; }
};

void read_header(png_structp png, png_infop info, Layout& layout) {
  // Our own limit comes with a better message; text and colour profiles are never unpacked.
  png_set_user_limits(png, PNG_UINT_31_MAX, PNG_UINT_31_MAX);
  png_set_keep_unknown_chunks(png, PNG_HANDLE_CHUNK_NEVER, nullptr, -1);
  png_set_benign_errors(png, 1);
  png_read_info(png, info);
  layout.width = png_get_image_width(png, info);
  layout.height = png_get_image_height(png, info);
}

void choose_layout(png_structp png, png_infop info, Layout& layout) {
  png_set_expand(png);  // palettes to colours, few bits to eight, transparent colours to alpha
  layout.passes = png_set_interlace_handling(png);
  png_read_update_info(png, info);
  layout.row_bytes = png_get_rowbytes(png, info);
  layout.channels = png_get_channels(png, info);
  layout.depth = png_get_bit_depth(png, info);
}

std::uint32_t sample(const png_byte* row, std::size_t index, int depth) {
  if (depth == 8) return row[index] * 257U;
  return row[2 * index] * 256U + row[2 * index + 1];
}

void convert_row(const png_byte* row, const Layout& layout, std::size_t y, GrayImage& image) {
  const auto width = static_cast<std::size_t>(layout.width);
  const auto channels = static_cast<std::size_t>(layout.channels);
  const std::size_t colours = channels - (layout.has_alpha() ? 1 : 0);
  const auto count = static_cast<std::uint32_t>(colours);
  for (std::size_t x = 0; x < width; ++x) {
    std::uint32_t sum = 0;
    for (std::size_t c = 0; c < colours; ++c) sum += sample(row, x * channels + c, layout.depth);
    image.shade[y * width + x] = static_cast<std::uint16_t>((sum + count / 2) / count);
    if (!layout.has_alpha()) continue;
    image.alpha[y * width + x] =
        static_cast<std::uint16_t>(sample(row, x * channels + colours, layout.depth));
  }
}

/// `buffer` is one row, or the whole image where it is interlaced and comes in several passes.
void read_rows(png_structp png, const Layout& layout, png_byte* buffer, GrayImage& image) {
  const auto height = static_cast<std::size_t>(layout.height);
  for (int pass = 1; pass <= layout.passes; ++pass) {
    for (std::size_t y = 0; y < height; ++y) {
      png_byte* row = layout.passes > 1 ? buffer + y * layout.row_bytes : buffer;
      png_read_row(png, row, nullptr);
      if (pass == layout.passes) convert_row(row, layout, y, image);
    }
  }
  png_read_end(png, nullptr);
}

[[noreturn]] void fail_broken(const std::string& file, const PngHandle& png) {
  fail(file, fmt::format("the PNG image is broken: {}", png.message()),
       "the file was cut off or changed: copy or write it again");
}

}  // namespace

bool is_png(std::string_view bytes) { return bytes.starts_with("\x89PNG\r\n\x1a\n"); }

GrayImage read_png(std::string_view bytes, const std::string& file) {
  PngHandle png(bytes);
  Layout layout;
  if (!png.guarded([&](png_structp p, png_infop info) { read_header(p, info, layout); })) {
    fail_broken(file, png);
  }
  check_size(file, layout.width, layout.height);
  const auto pixels = static_cast<std::size_t>(layout.width * layout.height);
  // A pixel may take a single bit.
  if (static_cast<double>(pixels) / 8.0 > kBestCompression * static_cast<double>(bytes.size())) {
    fail_truncated(file, layout.width, layout.height);
  }
  if (!png.guarded([&](png_structp p, png_infop info) { choose_layout(p, info, layout); })) {
    fail_broken(file, png);
  }
  GrayImage image{static_cast<std::int32_t>(layout.width), static_cast<std::int32_t>(layout.height),
                  std::vector<std::uint16_t>(pixels),
                  std::vector<std::uint16_t>(layout.has_alpha() ? pixels : 0)};
  const auto rows = static_cast<std::size_t>(layout.passes > 1 ? layout.height : 1);
  std::vector<png_byte> buffer(layout.row_bytes * rows);
  if (!png.guarded([&](png_structp p, png_infop) { read_rows(p, layout, buffer.data(), image); })) {
    fail_broken(file, png);
  }
  return image;
}

}  // namespace linewright::map_image
