#include "linewright/routing/route_cache.hpp"

#include <bit>
#include <cmath>
#include <cstring>
#include <numbers>
#include <type_traits>

namespace linewright {
namespace {

constexpr std::string_view kMagic = "linewright routes\n";
/// Raise it whenever the layout changes, or the search so that it finds other paths.
constexpr std::uint32_t kVersion = 3;

/// FNV-1a, 64 bits, over little-endian bytes.
class Hash {
 public:
  void bytes(std::string_view text) {
    for (const char c : text) {
      value_ = (value_ ^ static_cast<unsigned char>(c)) * 0x100000001b3ULL;
    }
  }
  void number(std::uint64_t value) {
    for (int shift = 0; shift < 64; shift += 8) {
      value_ = (value_ ^ ((value >> shift) & 0xffU)) * 0x100000001b3ULL;
    }
  }
  void real(double value) { number(std::bit_cast<std::uint64_t>(value + 0.0)); }  // -0 is 0
  void text(std::string_view value) {
    number(value.size());
    bytes(value);
  }
  void pose(const Pose2& pose) {
    real(pose.x_m);
    real(pose.y_m);
    real(pose.heading_rad);
  }
  [[nodiscard]] std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xcbf29ce484222325ULL;
};

std::uint64_t hash_of(std::string_view bytes) {
  Hash hash;
  hash.bytes(bytes);
  return hash.value();
}

void add_options(Hash& hash, const PathPlannerOptions& o) {
  hash.real(o.clearance_m);
  hash.number(static_cast<std::uint64_t>(o.headings));
  hash.real(o.reverse_penalty);
  hash.real(o.direction_change_m);
  hash.real(o.steering_change_m);
  hash.real(o.turn_m_per_rad);
  hash.real(o.greed);
  hash.number(static_cast<std::uint64_t>(o.smoothing_passes));
  hash.number(o.most_expansions);
}

class Writer {
 public:
  void u8(std::uint8_t value) { text_.push_back(static_cast<char>(value)); }
  void u32(std::uint32_t value) { little(value, 4); }
  void u64(std::uint64_t value) { little(value, 8); }
  void real(double value) { u64(std::bit_cast<std::uint64_t>(value)); }
  [[nodiscard]] std::string take() { return std::move(text_); }

 private:
  void little(std::uint64_t value, int bytes) {
    for (int i = 0; i < bytes; ++i) text_.push_back(static_cast<char>((value >> (8 * i)) & 0xffU));
  }
  std::string text_;
};

/// Reads past the end give zeros and are remembered.
class Reader {
 public:
  explicit Reader(std::string_view bytes) : bytes_(bytes) {}
  std::uint8_t u8() { return static_cast<std::uint8_t>(little(1)); }
  std::uint32_t u32() { return static_cast<std::uint32_t>(little(4)); }
  std::uint64_t u64() { return little(8); }
  double real() { return std::bit_cast<double>(u64()); }
  [[nodiscard]] bool ok() const { return ok_; }
  [[nodiscard]] bool at_end() const { return ok_ && bytes_.empty(); }
  [[nodiscard]] std::size_t left() const { return bytes_.size(); }
  [[nodiscard]] std::string_view rest() const { return bytes_; }

 private:
  std::uint64_t little(std::size_t count) {
    if (bytes_.size() < count) {
      ok_ = false;
      bytes_ = {};
      return 0;
    }
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < count; ++i) {
      value |= std::uint64_t{static_cast<unsigned char>(bytes_[i])} << (8 * i);
    }
    bytes_.remove_prefix(count);
    return value;
  }
  std::string_view bytes_;
  bool ok_ = true;
};

void write_path(Writer& out, const Path& path) {
  out.u8(static_cast<std::uint8_t>(path.status));
  out.real(path.turning_radius_m);
  out.u32(static_cast<std::uint32_t>(path.segments.size()));
  for (const PathSegment& segment : path.segments) {
    out.u8(static_cast<std::uint8_t>(segment.kind));
    out.real(segment.amount);
  }
}

/// Metres or radians; arcs: turning radii, too.
constexpr double kLongestPiece = 1e6;

bool read_path(Reader& in, const Pose2& start, Path& path) {
  const std::uint8_t status = in.u8();
  path.turning_radius_m = in.real();
  const std::uint32_t segments = in.u32();
  constexpr std::size_t kBytesPerSegment = 9;
  if (!in.ok() || status > static_cast<std::uint8_t>(PathStatus::kSearchLimit) ||
      !(path.turning_radius_m >= 0.0 && path.turning_radius_m <= kLongestPiece) ||
      segments > in.left() / kBytesPerSegment) {
    return false;
  }
  path.status = static_cast<PathStatus>(status);
  path.start = start;
  path.segments.resize(segments);
  for (PathSegment& segment : path.segments) {
    const std::uint8_t kind = in.u8();
    segment.amount = in.real();
    if (kind > static_cast<std::uint8_t>(PathSegment::Kind::kTurn)) return false;
    segment.kind = static_cast<PathSegment::Kind>(kind);
    const bool arc =
        segment.kind == PathSegment::Kind::kLeft || segment.kind == PathSegment::Kind::kRight;
    // Whatever is drawn or timed later takes as many steps as this is long.
    if (!(std::abs(segment.amount) <= kLongestPiece)) return false;
    if (arc && !(std::abs(segment.amount) <= kLongestPiece * path.turning_radius_m)) return false;
  }
  return in.ok();
}

bool leads_to(const Path& path, const Pose2& goal) {
  constexpr double kRounding = 1e-6;
  const Pose2 end = path.end();
  return distance_m(end.point(), goal.point()) <= kRounding &&
         std::abs(std::remainder(end.heading_rad - goal.heading_rad, 2 * std::numbers::pi)) <=
             kRounding;
}

bool read_tables(std::string_view payload, const std::vector<RouteRequest>& requests,
                 std::vector<RouteTable>& tables) {
  Reader in(payload);
  if (in.u32() != requests.size()) return false;
  for (const RouteRequest& request : requests) {
    const std::size_t stops = request.stops.size();
    if (in.u32() != stops) return false;
    RouteTable& table = tables.emplace_back(stops);
    for (std::size_t from = 0; from < stops; ++from) {
      for (std::size_t to = 0; to < stops; ++to) {
        Path path;
        if (!read_path(in, request.stops[from].pose, path)) return false;
        if (path.found() && !leads_to(path, request.stops[to].pose)) return false;
        table.set(from, to, std::move(path));
      }
    }
  }
  return in.at_end();
}

}  // namespace

std::uint64_t route_key(const OccupancyGrid& grid, const std::vector<RouteRequest>& requests) {
  Hash hash;
  hash.number(kVersion);
  hash.pose(grid.frame().origin);
  hash.real(grid.cell_m());
  hash.number(static_cast<std::uint64_t>(grid.columns()));
  hash.number(static_cast<std::uint64_t>(grid.rows()));
  const auto& cells = grid.cells();
  static_assert(sizeof(CellState) == 1);
  hash.bytes({reinterpret_cast<const char*>(cells.data()), cells.size()});
  for (const RouteRequest& request : requests) {
    hash.text(request.kind);
    hash.text(request.planner);
    hash.real(request.mover.turning_radius_m);
    hash.real(request.mover.footprint.circumscribed_m());
    for (const Point2 corner : request.mover.footprint.corners()) {
      hash.real(corner.x_m);
      hash.real(corner.y_m);
    }
    add_options(hash, request.options);
    hash.number(request.stops.size());
    for (const RouteStop& stop : request.stops) {
      hash.text(stop.name);
      hash.pose(stop.pose);
    }
  }
  return hash.value();
}

std::string encode_routes(const std::vector<RouteTable>& tables, std::uint64_t key) {
  Writer payload;
  payload.u32(static_cast<std::uint32_t>(tables.size()));
  for (const RouteTable& table : tables) {
    payload.u32(static_cast<std::uint32_t>(table.stops()));
    for (std::size_t from = 0; from < table.stops(); ++from) {
      for (std::size_t to = 0; to < table.stops(); ++to) write_path(payload, table.path(from, to));
    }
  }
  const std::string body = payload.take();
  Writer head;
  head.u32(kVersion);
  head.u64(key);
  head.u64(body.size());
  head.u64(hash_of(body));
  return std::string(kMagic) + head.take() + body;
}

CachedRoutes decode_routes(std::string_view bytes, std::uint64_t key,
                           const std::vector<RouteRequest>& requests) {
  CachedRoutes cached;
  if (bytes.substr(0, kMagic.size()) != kMagic) {
    cached.complaint = "it is no file of routes";
    return cached;
  }
  Reader in(bytes.substr(kMagic.size()));
  const std::uint32_t version = in.u32();
  const std::uint64_t its_key = in.u64();
  const std::uint64_t size = in.u64();
  const std::uint64_t checksum = in.u64();
  if (in.ok() && version != kVersion) {
    cached.outdated = true;
  } else if (!in.ok() || in.left() != size || hash_of(in.rest()) != checksum) {
    cached.complaint = "it is damaged";
  } else if (its_key != key) {
    cached.outdated = true;
  } else if (!read_tables(in.rest(), requests, cached.tables)) {
    cached.tables.clear();
    cached.complaint = "its contents do not fit the scenario";
  }
  return cached;
}

}  // namespace linewright
