#include "hall_stage.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "hall_crowd.hpp"
#include "hall_labels.hpp"
#include "hall_machines.hpp"
#include "hall_marks.hpp"
#include "linewright/base/markup.hpp"
#include "routes_hall.hpp"
#include "routes_names.hpp"

namespace linewright::hall {
namespace {

using markup::coordinate;
using markup::escaped;
using routes::Pixel;
using routes::View;

constexpr double kStationDot = 3.2;
constexpr double kCarrierRoom = 5.0;         // a carrier sticks out so far around its holder
constexpr double kLongestPiece = 2000.0;     // pixels
constexpr std::size_t kMostSteps = 500'000;  // beyond, names need not keep clear of ways either
constexpr std::size_t kMostObstacles = 300;  // beyond, names need not keep clear of them

class StagePainter {
 public:
  StagePainter(const LogDocument& log, const HallScene& scene, const View& view)
      : log_(log),
        header_(log.header),
        scene_(scene),
        view_(view),
        placer_(view.width, view.height) {}

  std::string paint() {
    paint_floor();
    paint_zones();
    const MachineMarks machines = machine_marks(header_, scene_, view_);
    svg_ += machines.svg;
    for (const labels::Box& box : machines.numbers) placer_.block(box);
    paint_ways();
    paint_stations();
    place_workers();
    paint_carriers();
    paint_workers();
    svg_ += labels_svg(labels_, placer_);
    for (const labels::Box& box : machines.boxes) placer_.occupy(box);
    paint_area_names();
    return std::move(svg_);
  }

 private:
  void paint_floor() {
    std::string obstacles;
    if (header_.hall) {
      for (const LogObstacle& obstacle : header_.hall->obstacles) {
        obstacles += routes::outline(obstacle.polygon, view_);
        if (noted_++ < kMostObstacles) discourage(obstacle.polygon);
      }
    }
    svg_ += routes::floor_svg(corners_of(view_.hall), {}, obstacles, view_);
  }

  /// Names are better read on the free floor.
  void discourage(const Polygon& polygon) {
    constexpr double kStep = 3.0;
    const labels::Box box = routes::box_of(polygon, view_);
    for (double y = std::max(box.y0, 0.0); y < std::min(box.y1, view_.height); y += kStep) {
      for (double x = std::max(box.x0, 0.0); x < std::min(box.x1, view_.width); x += kStep) {
        if (contains(polygon, view_.point({x, y}))) placer_.discourage(x, y, 0.25);
      }
    }
  }

  void paint_zones() {
    for (std::size_t z = 0; z < header_.zones.size(); ++z) {
      svg_ += fmt::format("<path class=\"zone{}\" d=\"{}\"/>\n", scene_.closed[z] ? " shut" : "",
                          routes::outline(header_.zones[z].polygon, view_));
    }
  }

  /// What is left of everyone's way, with a head where it ends.
  void paint_ways() {
    for (const SceneWorker& worker : scene_.workers) {
      if (worker.ahead.size() < 2) continue;
      const std::string style = line_style_of(worker.doing);
      std::string data;
      for (const Point2 point : worker.ahead) {
        const Pixel at = view_.at(point);
        data +=
            fmt::format("{}{} {}", data.empty() ? "M" : "L", coordinate(at.x), coordinate(at.y));
      }
      svg_ +=
          fmt::format("<path class=\"casing\" d=\"{1}\"/>\n<path class=\"ahead {0}\" d=\"{1}\"/>\n",
                      style, data);
      discourage_line(worker.ahead);
      paint_head(worker.ahead, style);
    }
  }

  void discourage_line(const std::vector<Point2>& line) {
    for (std::size_t i = 1; i < line.size(); ++i) {
      const Pixel a = view_.at(line[i - 1]);
      const Pixel b = view_.at(line[i]);
      const double length = std::min(std::hypot(b.x - a.x, b.y - a.y), kLongestPiece);
      const int steps = std::max(1, static_cast<int>(length));
      for (int s = 0; s <= steps && noted_steps_ < kMostSteps; ++s, ++noted_steps_) {
        placer_.discourage(a.x + (b.x - a.x) * s / steps, a.y + (b.y - a.y) * s / steps, 1.0);
      }
    }
  }

  void paint_head(const std::vector<Point2>& line, const std::string& style) {
    constexpr double kLength = 7.0;
    constexpr double kHalf = 4.0;
    const Pixel tip = view_.at(line.back());
    Pixel before = tip;
    for (auto point = line.rbegin(); point != line.rend(); ++point) {
      before = view_.at(*point);
      if (std::hypot(tip.x - before.x, tip.y - before.y) > kLength) break;
    }
    const double length = std::hypot(tip.x - before.x, tip.y - before.y);
    if (length < 1.0) return;
    const double dx = (tip.x - before.x) / length;
    const double dy = (tip.y - before.y) / length;
    const Pixel foot{tip.x - dx * kLength, tip.y - dy * kLength};
    svg_ += fmt::format("<path class=\"head-of-way {}\" d=\"M{} {}L{} {}L{} {}\"/>\n", style,
                        coordinate(foot.x - dy * kHalf), coordinate(foot.y + dx * kHalf),
                        coordinate(tip.x), coordinate(tip.y), coordinate(foot.x + dy * kHalf),
                        coordinate(foot.y - dx * kHalf));
  }

  void paint_stations() {
    for (std::size_t s = 0; s < header_.stations.size(); ++s) paint_station(s);
  }

  /// A dot with its heading for each kind's pose, joined when there are several, and one name.
  void paint_station(std::size_t index) {
    const LogStation& station = header_.stations[index];
    if (station.poses.empty()) return;
    std::string dots;
    std::string link;
    for (const auto& [kind, pose] : station.poses) {
      const Pixel at = view_.at(pose.point());
      if (!dots.empty()) placer_.block({at.x - 5.0, at.y - 5.0, at.x + 5.0, at.y + 5.0});
      dots += fmt::format(
          "<path class=\"tick\" d=\"M{0} {1}L{2} {3}\"/><circle class=\"station\" cx=\"{0}\" "
          "cy=\"{1}\" r=\"{4}\"/>\n",
          coordinate(at.x), coordinate(at.y), coordinate(at.x + 8.0 * std::cos(pose.heading_rad)),
          coordinate(at.y - 8.0 * std::sin(pose.heading_rad)), coordinate(kStationDot));
      link += fmt::format("{}{} {}", link.empty() ? "M" : "L", coordinate(at.x), coordinate(at.y));
    }
    if (station.poses.size() > 1) svg_ += fmt::format("<path class=\"link\" d=\"{}\"/>\n", link);
    svg_ += dots;
    const Pixel at = view_.at(station.poses.begin()->second.point());
    labels_.push_back({station.name, false, tokens_at(StationId(index)), at, kStationDot + 1.0});
  }

  [[nodiscard]] std::vector<TokenMark> tokens_at(StationId station) const {
    std::vector<TokenMark> marks;
    for (std::size_t p = 0; p < header_.places.size(); ++p) {
      const LogPlace& place = header_.places[p];
      if (place.at != station || !place.berth.empty()) continue;
      marks.push_back({scene_.tokens[p], place.capacity});
    }
    return marks;
  }

  /// Of the circle that keeps others away, with the carrier that the kind can hold.
  [[nodiscard]] double room_of(const std::string& kind, const Shape& shape) const {
    const bool carries =
        std::any_of(scene_.carriers.begin(), scene_.carriers.end(),
                    [&](const SceneCarrier& carrier) { return carrier.moved_by == kind; });
    return std::max(shape.length, shape.width) / 2.0 + (carries ? kCarrierRoom : 0.0);
  }

  void place_workers() {
    for (std::size_t w = 0; w < scene_.workers.size(); ++w) {
      const std::string& kind = header_.workers[w].kind;
      shapes_.push_back(shape_of(header_, kind, view_.scale));
      spots_.push_back(
          crowd_.spot(view_.at(scene_.workers[w].pose.point()), room_of(kind, shapes_.back())));
    }
  }

  void paint_carriers() {
    Crowd loose;  // one that nobody holds may well stand where a worker stands
    for (std::size_t c = 0; c < scene_.carriers.size(); ++c) {
      const SceneCarrier& carrier = scene_.carriers[c];
      if (carrier.holder) {
        paint_held(carrier);
      } else {
        paint_loose(c, carrier, loose);
      }
    }
  }

  /// Around the shape of who holds it, or could.
  void paint_frame(Pixel at, double heading_rad, const Shape& shape, const char* style) {
    const double length = shape.length + 2.0 * kCarrierRoom;
    const double width = shape.width + 2.0 * kCarrierRoom;
    svg_ += fmt::format(
        "<rect class=\"carrier {}\" transform=\"translate({} {}) rotate({})\" x=\"{}\" y=\"{}\" "
        "width=\"{}\" height=\"{}\" rx=\"3\"/>\n",
        style, coordinate(at.x), coordinate(at.y),
        coordinate(-heading_rad * 180.0 / std::numbers::pi), coordinate(-length / 2.0),
        coordinate(-width / 2.0), coordinate(length), coordinate(width));
  }

  void paint_held(const SceneCarrier& carrier) {
    const std::size_t w = carrier.holder->index();
    paint_frame(spots_[w], carrier.pose.heading_rad, shapes_[w], "held");
  }

  void paint_loose(std::size_t index, const SceneCarrier& carrier, Crowd& loose) {
    const Shape shape = shape_of(header_, carrier.moved_by, view_.scale);
    const double room = room_of(carrier.moved_by, shape);
    const Pixel at = loose.spot(view_.at(carrier.pose.point()), room);
    paint_frame(at, carrier.pose.heading_rad, shape, "loose");
    labels_.push_back({header_.carriers[index].id, true, load_of(CarrierId(index)), at, room});
  }

  [[nodiscard]] std::vector<TokenMark> load_of(CarrierId id) const {
    return {{scene_.carriers[id.index()].items, header_.carriers[id.index()].capacity}};
  }

  void paint_workers() {
    for (std::size_t w = 0; w < scene_.workers.size(); ++w) {
      const SceneWorker& worker = scene_.workers[w];
      const Pixel at = spots_[w];
      svg_ += fmt::format(
          "<g class=\"worker\" transform=\"translate({} {}) rotate({})\"><title>{}</title>{}</g>\n",
          coordinate(at.x), coordinate(at.y),
          coordinate(-worker.pose.heading_rad * 180.0 / std::numbers::pi),
          escaped(header_.workers[w].id), worker_mark(shapes_[w], style_of(worker.doing, "free")));
      Label label{
          header_.workers[w].id, true, {}, at, room_of(header_.workers[w].kind, shapes_[w]) + 2.0};
      if (worker.carrier) {
        label.text += " + " + header_.carriers[worker.carrier->index()].id;
        label.tokens = load_of(*worker.carrier);
      }
      labels_.push_back(std::move(label));
    }
  }

  void paint_area_names() {
    for (std::size_t z = 0; z < header_.zones.size(); ++z) {
      const std::string state = scene_.closed[z] ? ": closed" : "";
      svg_ += routes::name_within(header_.zones[z].polygon, header_.zones[z].name + state, view_,
                                  placer_);
    }
    if (!header_.hall) return;
    std::vector<const LogObstacle*> without_room;
    for (const LogObstacle& obstacle : header_.hall->obstacles) {
      const std::string name = routes::name_within(obstacle.polygon, obstacle.name, view_, placer_);
      if (name.empty()) without_room.push_back(&obstacle);
      svg_ += name;
    }
    if (header_.hall->obstacles.size() > kMostObstacles) return;
    for (const LogObstacle& obstacle : header_.hall->obstacles) {
      placer_.occupy(routes::box_of(obstacle.polygon, view_));
    }
    for (const LogObstacle* obstacle : without_room) {
      svg_ += routes::name_beside(obstacle->polygon, obstacle->name, view_, placer_);
    }
  }

  const LogDocument& log_;
  const LogHeader& header_;
  const HallScene& scene_;
  const View& view_;
  labels::Placer placer_;
  Crowd crowd_;
  std::vector<Shape> shapes_;  ///< by worker
  std::vector<Pixel> spots_;   ///< by worker
  std::vector<Label> labels_;
  std::size_t noted_ = 0;        ///< obstacles that names keep clear of
  std::size_t noted_steps_ = 0;  ///< of ways that names keep clear of
  std::string svg_;
};

}  // namespace

std::string stage_svg(const LogDocument& log, const HallScene& scene, const View& view) {
  return StagePainter(log, scene, view).paint();
}

}  // namespace linewright::hall
