#include "smoothing.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

namespace linewright {
namespace {

using Kind = PathSegment::Kind;

/// A path cut into short pieces: pose i stands before piece i.
struct Pieces {
  std::vector<Pose2> poses;
  std::vector<PathSegment> pieces;
};

Pieces cut(const Path& path, double length_m) {
  Pieces cut{{path.start}, {}};
  for (const PathSegment& segment : path.segments) {
    const double size = std::abs(segment.amount);
    const int parts =
        segment.kind == Kind::kTurn ? 1 : std::max(1, static_cast<int>(std::ceil(size / length_m)));
    for (int i = 0; i < parts; ++i) {
      cut.pieces.push_back({segment.kind, segment.amount / parts});
      cut.poses.push_back(
          advanced(cut.poses.back(), segment.kind, segment.amount / parts, path.turning_radius_m));
    }
  }
  return cut;
}

/// One pass: from each pose, a shortcut to the farthest pose that one leads to.
class Pass {
 public:
  Pass(const Path& path, const Steering& steering, double length_m)
      : steering_(steering), cut_(cut(path, length_m)) {
    made_ = path;
    made_.segments.clear();
  }

  Path run() {
    for (std::size_t i = 0; i < cut_.pieces.size();) i = step(i);
    return std::move(made_);
  }

 private:
  /// Appends a shortcut or the next piece, and returns the pose that was reached.
  std::size_t step(std::size_t i) {
    const std::size_t end = cut_.pieces.size();
    for (std::size_t ahead = end - i; ahead >= 2; ahead = ahead * 2 / 3) {
      const Connection connection = steering_.connect(cut_.poses[i], cut_.poses[i + ahead]);
      const std::span<const PathSegment> replaced(&cut_.pieces[i], ahead);
      if (connection.cost_m >= steering_.cost_m(replaced) - 1e-6) continue;
      if (!steering_.free(cut_.poses[i], connection.curve.segments())) continue;
      for (const PathSegment& piece : connection.curve.segments()) append_segment(made_, piece);
      return i + ahead;
    }
    append_segment(made_, cut_.pieces[i]);
    return i + 1;
  }

  const Steering& steering_;
  Pieces cut_;
  Path made_;
};

}  // namespace

void append_segment(Path& path, const PathSegment& piece) {
  if (std::abs(piece.amount) < 1e-12) return;
  if (!path.segments.empty()) {
    PathSegment& last = path.segments.back();
    const bool turn = piece.kind == Kind::kTurn;
    if (last.kind == piece.kind && (turn || last.amount * piece.amount > 0.0)) {
      last.amount += piece.amount;
      if (std::abs(last.amount) < 1e-12) path.segments.pop_back();
      return;
    }
  }
  path.segments.push_back(piece);
}

void take_short_turns(Path& path) {
  for (PathSegment& segment : path.segments) {
    if (segment.kind == Kind::kTurn) {
      segment.amount = std::remainder(segment.amount, 2.0 * std::numbers::pi);
    }
  }
}

void smooth(Path& path, const Steering& steering, int passes) {
  for (int pass = 0; pass < passes; ++pass) {
    const double before = steering.cost_m(path.segments);
    const double metres = path.metres();
    if (path.segments.size() <= 3 &&
        metres <= distance_m(path.start.point(), path.end().point()) + 1e-9) {
      return;  // straight there
    }
    // Other joints in each pass, so that corners are cut closer and closer.
    constexpr int kPieces = 24;
    const double length_m = std::max(metres / (kPieces + 7 * pass), 0.1);
    Path next = Pass(path, steering, length_m).run();
    if (steering.cost_m(next.segments) >= before) return;
    path = std::move(next);
    if (steering.cost_m(path.segments) > before * 0.999) return;
  }
}

}  // namespace linewright
