// The first byte chooses what the others are: `h`, a header, which then gets its length and zeros
// for tensors; else a whole file. Either it is read, and comes back from its own bytes, or a
// ScenarioError comes out; whatever is read may be a policy.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>

#include "linewright/base/diagnostic.hpp"
#include "linewright/network/policy_file.hpp"
#include "linewright/network/safetensors.hpp"

namespace {

void check(bool holds) {
  if (!holds) std::abort();
}

/// The largest number in the header below 1 MB: most likely the end of the last tensor.
std::size_t data_bytes(std::string_view header) {
  std::size_t most = 0;
  std::size_t number = 0;
  for (const char c : header) {
    const bool digit = c >= '0' && c <= '9';
    number = digit
                 ? std::min<std::size_t>(10 * number + static_cast<std::size_t>(c - '0'), 1U << 30U)
                 : 0;
    if (number < (1U << 20U)) most = std::max(most, number);
  }
  return most;
}

std::string with_length(std::string_view header) {
  std::string file;
  for (int i = 0; i < 8; ++i) {
    file.push_back(static_cast<char>((header.size() >> (8 * i)) & 0xffU));
  }
  file += header;
  file.append(data_bytes(header), '\0');
  return file;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace linewright;
  if (size == 0) return 0;
  const std::string_view rest(reinterpret_cast<const char*>(data) + 1, size - 1);
  const std::string bytes = data[0] == 'h' ? with_length(rest) : std::string(rest);
  try {
    const TensorFile file = parse_safetensors(bytes, "fuzz.safetensors");
    const std::string again = to_safetensors(file);
    check(parse_safetensors(again, "again.safetensors") == file);
    static_cast<void>(parse_policy(again, "again.safetensors").network());
  } catch (const ScenarioError&) {
  }
  return 0;
}
