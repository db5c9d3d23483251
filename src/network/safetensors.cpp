#include "linewright/network/safetensors.hpp"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <cstddef>
#include <nlohmann/json.hpp>

#include "linewright/base/diagnostic.hpp"
#include "linewright/base/files.hpp"

namespace linewright {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t kAlignment = 8;

[[noreturn]] void refuse(const std::string& message) {
  throw ScenarioError("", fmt::format("cannot write tensors: {}", message), "");
}

void check_writable(const std::string& name, const Tensor& tensor) {
  std::uint64_t size = 1;
  for (const std::int64_t extent : tensor.shape) {
    const bool fits =
        extent >= 0 && !__builtin_mul_overflow(size, static_cast<std::uint64_t>(extent), &size);
    if (!fits) refuse(fmt::format("{} has an impossible shape", in_quotes(name)));
  }
  if (size != tensor.values.size()) {
    refuse(fmt::format("{} {} has {} numbers", in_quotes(name), shape_text(tensor.shape),
                       tensor.values.size()));
  }
  for (const float value : tensor.values) {
    if (!std::isfinite(value)) {
      refuse(fmt::format("{} holds a number that is not finite", in_quotes(name)));
    }
  }
}

Json header_of(const TensorFile& file) {
  Json header = Json::object();
  if (!file.metadata.empty()) header["__metadata__"] = file.metadata;
  std::size_t offset = 0;
  for (const auto& [name, tensor] : file.tensors) {
    if (name == "__metadata__") refuse("a tensor cannot have the name '__metadata__'");
    check_writable(name, tensor);
    const std::size_t end = offset + 4 * tensor.values.size();
    header[name] = {{"dtype", "F32"}, {"shape", tensor.shape}, {"data_offsets", {offset, end}}};
    offset = end;
  }
  return header;
}

void append_little(std::string& text, std::uint64_t value, int bytes) {
  for (int i = 0; i < bytes; ++i) text.push_back(static_cast<char>((value >> (8 * i)) & 0xffU));
}

std::string dumped(const Json& header) {
  try {
    return header.dump();
  } catch (const Json::exception&) {
    refuse("a name or the metadata are not UTF-8 text");
  }
}

}  // namespace

std::string to_safetensors(const TensorFile& file) {
  std::string header = dumped(header_of(file));
  header.resize((header.size() + kAlignment - 1) / kAlignment * kAlignment, ' ');
  std::string bytes;
  append_little(bytes, header.size(), 8);
  bytes += header;
  for (const auto& [name, tensor] : file.tensors) {
    for (const float value : tensor.values) {
      append_little(bytes, std::bit_cast<std::uint32_t>(value), 4);
    }
  }
  return bytes;
}

void write_safetensors(const std::string& path, const TensorFile& file) {
  write_file(path, to_safetensors(file));
}

std::string shape_text(const std::vector<std::int64_t>& shape) {
  return fmt::format("[{}]", fmt::join(shape, ", "));
}

}  // namespace linewright
