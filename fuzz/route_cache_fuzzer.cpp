// The first byte chooses what the others are: `f`, a whole cache file; else the payload of one,
// which then gets a sound head. Either it is usable, and encodes to the same bytes, or it is not
// and says why.

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

#include "linewright/base/hash.hpp"
#include "linewright/routing/route_cache.hpp"

namespace {

constexpr std::uint64_t kKey = 0x6b65796b65796b65;

void check(bool holds) {
  if (!holds) std::abort();
}

const std::vector<linewright::RouteRequest>& requests() {
  using namespace linewright;
  static const std::vector<RouteRequest> kRequests = {
      {.kind = "human", .mover = {Footprint::circle(0.3), 0.0}, .stops = {{"a", {}}, {"b", {}}}},
      {.kind = "robot", .mover = {Footprint::circle(0.4), 0.8}, .stops = {{"a", {1.0, 2.0, 0.5}}}}};
  return kRequests;
}

void add(std::string& text, std::uint64_t value, int bytes) {
  for (int i = 0; i < bytes; ++i) text.push_back(static_cast<char>((value >> (8 * i)) & 0xffU));
}

/// Magic and version as they are written now, and the checksum of the payload: docs/formats.
std::string with_head(std::string_view payload) {
  const std::string sound = linewright::encode_routes({}, kKey);
  constexpr std::size_t kMagicAndVersion = 18 + 4;
  std::string file = sound.substr(0, kMagicAndVersion);
  add(file, kKey, 8);
  add(file, payload.size(), 8);
  add(file, linewright::hash_of(payload), 8);
  return file + std::string(payload);
}

void decode(std::string_view file) {
  using namespace linewright;
  const CachedRoutes cached = decode_routes(file, kKey, requests());
  if (!cached.usable()) return check(cached.tables.empty());
  check(cached.tables.size() == requests().size());
  check(encode_routes(cached.tables, kKey) == file);
  for (const RouteTable& table : cached.tables) {
    static_cast<void>(table.failed());
    for (std::size_t i = 0; i < table.stops() * table.stops(); ++i) {
      const Path& path = table.path(i / table.stops(), i % table.stops());
      static_cast<void>(path.metres() + path.turned_rad());
      static_cast<void>(path.end());
    }
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  const std::string_view rest(reinterpret_cast<const char*>(data) + 1, size - 1);
  if (data[0] == 'f') {
    decode(rest);
  } else {
    const std::string file = with_head(rest);
    decode(file);
  }
  return 0;
}
