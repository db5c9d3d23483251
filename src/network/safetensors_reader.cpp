#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <utility>

#include "linewright/base/diagnostic.hpp"
#include "linewright/base/files.hpp"
#include "linewright/environment/json_text.hpp"
#include "linewright/network/safetensors.hpp"

namespace linewright {
namespace {

using Json = nlohmann::json;

constexpr std::size_t kLengthBytes = 8;
constexpr std::size_t kMostHeaderBytes = 100'000'000;
constexpr std::size_t kMostBytes = std::size_t{1} << 30U;
constexpr std::size_t kMostDimensions = 16;
constexpr const char* kMetadata = "__metadata__";

std::uint64_t little(std::string_view bytes) {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    value |= std::uint64_t{static_cast<unsigned char>(bytes[i])} << (8 * i);
  }
  return value;
}

/// A tensor as the header describes it; offsets count from the end of the header.
struct Entry {
  std::string name;
  std::vector<std::int64_t> shape;
  std::uint64_t begin = 0;
  std::uint64_t end = 0;
};

class Reader {
 public:
  Reader(std::string_view bytes, const std::string& file) : bytes_(bytes), file_(file) {}

  TensorFile read() {
    const Json header = parse_json(header_text(), file_, "the header", 3);
    const JsonFields fields(header, "the header", file_);
    TensorFile result;
    std::vector<Entry> entries;
    for (const auto& [name, value] : header.items()) {
      if (name == kMetadata) {
        result.metadata = metadata_of(value);
      } else {
        entries.push_back(entry_of(name, value));
      }
    }
    check_layout(entries);
    for (Entry& entry : entries) {
      std::vector<float> values = values_of(entry);
      result.tensors[entry.name] = {std::move(entry.shape), std::move(values)};
    }
    return result;
  }

 private:
  [[noreturn]] void fail(const std::string& message, const std::string& hint = "") const {
    throw ScenarioError(file_, message, hint);
  }

  [[noreturn]] void cut_off(std::uint64_t missing) const {
    fail(fmt::format("the file is cut off: {} bytes are missing", missing),
         "copy or download it again");
  }

  /// Leaves the tensors in bytes_.
  std::string_view header_text() {
    if (bytes_.size() < kLengthBytes) cut_off(kLengthBytes - bytes_.size());
    const std::uint64_t size = little(bytes_.substr(0, kLengthBytes));
    bytes_.remove_prefix(kLengthBytes);
    if (size > kMostHeaderBytes) {
      fail(fmt::format("its header would be {} bytes long: this is no safetensors file", size));
    }
    if (size > bytes_.size()) cut_off(size - bytes_.size());
    const std::string_view text = bytes_.substr(0, size);
    bytes_.remove_prefix(size);
    if (!text.starts_with('{')) fail("its header is not JSON: this is no safetensors file");
    return text;
  }

  [[nodiscard]] std::map<std::string, std::string> metadata_of(const Json& json) const {
    const JsonFields fields(json, "the metadata", file_);
    std::map<std::string, std::string> metadata;
    for (const auto& [key, value] : json.items()) {
      if (!value.is_string()) fields.fail(fmt::format("has {}: it must be text", in_quotes(key)));
      metadata[key] = value.get<std::string>();
    }
    return metadata;
  }

  [[nodiscard]] Entry entry_of(const std::string& name, const Json& json) const {
    const JsonFields fields(json, fmt::format("the tensor {}", in_quotes(name)), file_);
    fields.allow_only({"dtype", "shape", "data_offsets"});
    const std::string& type = fields.text("dtype");
    if (type != "F32") {
      fields.fail(fmt::format("is of type {}; only F32 can be read", in_quotes(type)));
    }
    Entry entry;
    entry.name = name;
    entry.shape = numbers_of(fields, "shape");
    const std::vector<std::int64_t> offsets = numbers_of(fields, "data_offsets");
    if (offsets.size() != 2) fields.fail("needs two 'data_offsets'");
    entry.begin = static_cast<std::uint64_t>(offsets[0]);
    entry.end = static_cast<std::uint64_t>(offsets[1]);
    check_length(entry, fields);
    return entry;
  }

  [[nodiscard]] static std::vector<std::int64_t> numbers_of(const JsonFields& fields,
                                                            const char* key) {
    const Json& list = fields.list(key);
    if (list.size() > kMostDimensions) fields.fail(fmt::format("has too long a '{}'", key));
    std::vector<std::int64_t> numbers;
    for (const Json& value : list) {
      if (!value.is_number_unsigned() ||
          value.get<std::uint64_t>() > std::numeric_limits<std::int64_t>::max()) {
        fields.fail(fmt::format("has '{}': it must hold whole numbers from 0 on", key));
      }
      numbers.push_back(value.get<std::int64_t>());
    }
    return numbers;
  }

  static void check_length(const Entry& entry, const JsonFields& fields) {
    std::uint64_t size = sizeof(float);
    bool fits = entry.begin <= entry.end;
    for (const std::int64_t extent : entry.shape) {
      fits = fits && !__builtin_mul_overflow(size, static_cast<std::uint64_t>(extent), &size);
    }
    if (!fits || entry.end - entry.begin != size) {
      fields.fail(fmt::format("has the shape {}, which does not fit its bytes {} to {}",
                              shape_text(entry.shape), entry.begin, entry.end));
    }
  }

  /// One behind the other, from the end of the header to the end of the file.
  void check_layout(std::vector<Entry>& entries) const {
    std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
      return std::pair(a.begin, a.end) < std::pair(b.begin, b.end);
    });
    std::uint64_t end = 0;
    for (const Entry& entry : entries) {
      if (entry.begin != end) {
        fail(fmt::format("the tensor {} {}", in_quotes(entry.name),
                         entry.begin < end ? "overlaps another" : "stands behind a gap"));
      }
      end = entry.end;
    }
    if (end > bytes_.size()) cut_off(end - bytes_.size());
    if (end < bytes_.size()) {
      fail(fmt::format("{} bytes stand behind the last tensor", bytes_.size() - end));
    }
  }

  [[nodiscard]] std::vector<float> values_of(const Entry& entry) const {
    std::vector<float> values;
    values.reserve((entry.end - entry.begin) / sizeof(float));
    for (std::size_t at = entry.begin; at < entry.end; at += sizeof(float)) {
      const auto bits = static_cast<std::uint32_t>(little(bytes_.substr(at, sizeof(float))));
      values.push_back(std::bit_cast<float>(bits));
      if (!std::isfinite(values.back())) {
        fail(fmt::format("the tensor {} holds a number that is not finite (number {})",
                         in_quotes(entry.name), values.size()),
             "the training that wrote it has failed");
      }
    }
    return values;
  }

  std::string_view bytes_;
  const std::string& file_;
};

}  // namespace

TensorFile parse_safetensors(std::string_view bytes, const std::string& file) {
  return Reader(bytes, file).read();
}

TensorFile read_safetensors(const std::string& path) {
  std::string reason;
  const std::optional<std::string> bytes = read_file(path, kMostBytes, reason);
  if (!bytes) throw ScenarioError(path, fmt::format("cannot be read: {}", reason), "");
  if (bytes->size() > kMostBytes) {
    throw ScenarioError(path, "the file is larger than 1 GiB: this is no policy", "");
  }
  return parse_safetensors(*bytes, path);
}

}  // namespace linewright
