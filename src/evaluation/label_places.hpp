#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

// Finds places for names in a picture.
namespace linewright::labels {

/// Pixels, y downwards; x0 <= x1 and y0 <= y1.
struct Box {
  double x0 = 0.0;
  double y0 = 0.0;
  double x1 = 0.0;
  double y1 = 0.0;

  [[nodiscard]] bool meets(const Box& other) const {
    return x0 < other.x1 && other.x0 < x1 && y0 < other.y1 && other.y0 < y1;
  }
};

/// A dot that wants its name beside it.
struct Anchor {
  double x = 0.0;
  double y = 0.0;
  double dot = 0.0;    ///< radius
  double width = 0.0;  ///< of the name
  double height = 0.0;
};

/// Where a name stands. From farther away a line leads from (x, y) at the dot to (to_x, to_y) at
/// the name.
struct Place {
  Box box;
  bool led = false;
  double x = 0.0;
  double y = 0.0;
  double to_x = 0.0;
  double to_y = 0.0;
};

/// Places names so that none lies on another name or on a dot while there is room, and few on what
/// else is drawn. The same places for the same calls.
class Placer {
 public:
  Placer(double width, double height);

  /// Something is drawn here that a name should rather not cover: 0 ... 1, the larger one counts.
  void discourage(double x, double y, double weight);

  /// No name may lie here.
  void block(const Box& box) { blocked_.push_back(box); }

  /// A place for each name. To be called once.
  [[nodiscard]] std::vector<Place> place(const std::vector<Anchor>& anchors);

  /// Something else is drawn in this box: nothing that is taken later lies there.
  void occupy(const Box& box) { taken_.push_back(box); }

  /// Takes the box when neither a name nor a dot is there yet.
  [[nodiscard]] bool take(const Box& box);

 private:
  [[nodiscard]] bool outside(const Box& box) const;
  [[nodiscard]] double cost(const Place& place, double distance, std::size_t self) const;
  [[nodiscard]] double cost_of_line(const Place& place, std::size_t self) const;
  [[nodiscard]] float drawn_at(double x, double y) const;
  [[nodiscard]] double covered(const Box& box) const;
  double choose(const std::vector<Anchor>& anchors, std::size_t i);
  double arrange_in(const std::vector<Anchor>& anchors, const std::vector<std::size_t>& order);
  void arrange(const std::vector<Anchor>& anchors);

  double width_;
  double height_;
  std::size_t columns_;
  std::size_t rows_;
  std::vector<float> drawn_;  ///< by square
  std::vector<Box> blocked_;
  std::vector<Box> dots_;
  std::vector<std::optional<Place>> places_;
  std::vector<Box> taken_;  ///< after the names have their places
};

}  // namespace linewright::labels
