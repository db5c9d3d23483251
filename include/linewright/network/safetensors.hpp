#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace linewright {

/// Numbers in row-major order; `values` holds the product of `shape` (1 for a scalar, which has no
/// dimensions).
struct Tensor {
  std::vector<std::int64_t> shape;
  std::vector<float> values;

  friend bool operator==(const Tensor&, const Tensor&) = default;
};

using TensorMap = std::map<std::string, Tensor>;

/// What a safetensors file holds.
struct TensorFile {
  std::map<std::string, std::string> metadata;
  TensorMap tensors;

  friend bool operator==(const TensorFile&, const TensorFile&) = default;
};

/// The file in the safetensors format (github.com/huggingface/safetensors): the length of the
/// header (8 bytes, little-endian), the header (JSON), padded with spaces to 8 bytes, then the
/// tensors as F32, little-endian, without gaps in the order of their names. The same tensors give
/// the same bytes everywhere. Throws ScenarioError for what parse_safetensors would refuse: a shape
/// that does not fit the values, a value that is not finite, text that is not UTF-8.
[[nodiscard]] std::string to_safetensors(const TensorFile& file);

/// Reads a file in that format, whoever wrote it. Refused by ScenarioError, which names `file` and
/// the tensor: a file that is cut off or too long, a header above 100 MB, anything in the header
/// that the format does not know, keys given twice, tensors that overlap or leave gaps, lengths
/// that do not fit the shape, other types than F32, and values that are not finite.
[[nodiscard]] TensorFile parse_safetensors(std::string_view bytes, const std::string& file);

/// parse_safetensors of a file of at most 1 GiB.
[[nodiscard]] TensorFile read_safetensors(const std::string& path);

/// Writes to_safetensors by write_file: whole or not at all.
void write_safetensors(const std::string& path, const TensorFile& file);

/// "[3, 64]", for messages.
[[nodiscard]] std::string shape_text(const std::vector<std::int64_t>& shape);

}  // namespace linewright
