#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "linewright/map/collision_checker.hpp"
#include "linewright/routing/path_planner.hpp"

namespace linewright {

/// A motion primitive: one piece of a path, and what it does to direction and cost.
struct Move {
  PathSegment piece;
  int turn = 0;              ///< change of the heading in steps
  float cost_m = 0.0F;       ///< without what depends on the move before
  float cost_back_m = 0.0F;  ///< the same when it is driven from its end to its start
  float dx_m = 0.0F;  ///< where it leads from heading 0 (movers without heading: in any case)
  float dy_m = 0.0F;
};

/// The moves of a mover, and for each of them the cells that it may touch, so that near obstacles a
/// few words of bits decide. The pose before a move is its cell, a quarter of the cell in each
/// direction, a heading step and a quarter of that. One set of bits covers what any pose of such a
/// box may touch: "none in a blocked cell" means free. Another one holds what every pose of the box
/// touches: "one in a blocked cell" means blocked. Between the two one has to look exactly.
class MoveTable {
 public:
  /// `checker`'s footprint includes the clearance.
  MoveTable(const CollisionChecker& checker, const Mover& mover, const PathPlannerOptions& options);

  [[nodiscard]] const std::vector<Move>& moves() const { return moves_; }
  /// Steps that headings are told apart in; 1 for a mover whose heading does not matter.
  [[nodiscard]] int headings() const { return headings_; }
  [[nodiscard]] double step_rad() const { return step_rad_; }
  /// Heading steps of which every move turns a multiple, a divisor of headings(): a search reaches
  /// headings() / lattice() headings only.
  [[nodiscard]] int lattice() const { return lattice_; }
  /// Longest way that any point of the footprint goes in one move, in cells.
  [[nodiscard]] float reach_cells() const { return reach_cells_; }

  /// Cells relative to the cell of the pose: `height` rows of bits from `first_row` on, lowest bit
  /// = `first_column`.
  struct Swept {
    const std::uint64_t* rows = nullptr;  ///< may be touched; null: too wide for a word
    const std::uint64_t* core = nullptr;  ///< are touched in any case
    std::int16_t first_row = 0;
    std::int16_t first_column = 0;
    std::int16_t height = 0;
    std::int16_t width = 0;
  };

  /// For a pose in the frame of the grid: its cell, heading step and offset from that step (-0.5
  /// ... 0.5 steps). Made when first asked for; valid until the next call.
  [[nodiscard]] Swept swept(std::size_t move, float x_cells, float y_cells, int heading,
                            int offset_quarter) {
    const int qx = static_cast<int>((x_cells - std::floor(x_cells)) * kQuarters);
    const int qy = static_cast<int>((y_cells - std::floor(y_cells)) * kQuarters);
    const std::size_t index =
        ((static_cast<std::size_t>(heading * kQuarters + offset_quarter) * moves_.size() + move) *
             kQuarters +
         static_cast<std::size_t>(qy)) *
            kQuarters +
        static_cast<std::size_t>(qx);
    const Entry& entry = table_[index];
    if (entry.state != State::kReady) return make(index, move, qx, qy, heading, offset_quarter);
    return swept_of(entry);
  }

  /// Which quarter of a heading step an offset (-0.5 ... 0.5 steps) lies in.
  [[nodiscard]] static int quarter_of(double offset);

 private:
  static constexpr int kQuarters = 4;

  [[nodiscard]] int arc_turn() const;
  void add_car_moves(const PathPlannerOptions& options);
  void add_drive_moves(const PathPlannerOptions& options);
  void add_walk_moves();
  void add(PathSegment piece, int turn, double cost_m, double cost_back_m);
  [[nodiscard]] Pose2 pose_on(const Move& move, const Pose2& from, double share) const;
  [[nodiscard]] Swept make(std::size_t index, std::size_t move, int qx, int qy, int heading,
                           int offset_quarter);
  [[nodiscard]] std::vector<Polygon> swept_areas(const Move& move, const Pose2& from) const;
  [[nodiscard]] std::vector<Polygon> core_areas(const Move& move, const Pose2& from) const;

  enum class State : std::uint8_t { kUnknown, kReady, kTooWide };
  struct Entry {
    std::uint32_t offset = 0;  ///< into pool_: rows, then core
    std::int16_t first_row = 0;
    std::int16_t first_column = 0;
    std::int16_t height = 0;
    std::int16_t width = 0;
    State state = State::kUnknown;
  };

  [[nodiscard]] Swept swept_of(const Entry& entry) const {
    const std::uint64_t* rows = &pool_[entry.offset];
    return {rows,         rows + entry.height, entry.first_row, entry.first_column,
            entry.height, entry.width};
  }

  const CollisionChecker& checker_;
  double radius_m_;
  double cell_m_;
  bool ignores_heading_;
  int headings_;
  double step_rad_;
  int lattice_;
  float reach_cells_ = 0.0F;
  std::vector<Move> moves_;
  std::vector<Entry> table_;
  std::vector<std::uint64_t> pool_;
};

}  // namespace linewright
