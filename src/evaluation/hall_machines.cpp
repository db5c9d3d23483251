#include "hall_machines.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "hall_marks.hpp"
#include "linewright/base/markup.hpp"
#include "routes_names.hpp"

namespace linewright::hall {
namespace {

using markup::coordinate;
using routes::Pixel;
using routes::View;

constexpr double kSymbol = 22.0;  // of a machine without an area, pixels
constexpr double kBar = 3.5;      // thickness of the progress

class MachinePainter {
 public:
  MachinePainter(const LogHeader& header, const HallScene& scene, const View& view)
      : header_(header), scene_(scene), view_(view), symbols_at_(header.stations.size(), 0) {}

  MachineMarks paint() {
    for (std::size_t m = 0; m < header_.machines.size(); ++m) {
      const LogMachineSite& site = header_.machine_sites[m];
      if (!site.area_m.empty()) {
        paint_area(m, site.area_m);
      } else if (site.at) {
        paint_symbol(m, *site.at);
      }
    }
    return std::move(marks_);
  }

 private:
  void paint_area(std::size_t machine, const Polygon& area) {
    paint_machine(machine, routes::outline(area, view_), routes::box_of(area, view_));
  }

  /// Small, where who stands at the station looks; several side by side.
  void paint_symbol(std::size_t machine, StationId station) {
    const auto& poses = header_.stations[station.index()].poses;
    if (poses.empty()) return;
    const Pose2& pose = poses.begin()->second;
    const Pixel at = view_.at(pose.point());
    const double ahead = std::max(view_.scale * 0.9, kSymbol + 6.0);
    const double aside = symbols_at_[station.index()]++ * (kSymbol + 3.0);
    const double x = at.x + ahead * std::cos(pose.heading_rad) - aside * std::sin(pose.heading_rad);
    const double y = at.y - ahead * std::sin(pose.heading_rad) - aside * std::cos(pose.heading_rad);
    const double half = kSymbol / 2.0;
    paint_machine(machine,
                  fmt::format("M{0} {1}h{2}v{2}h-{2}Z", coordinate(x - half), coordinate(y - half),
                              coordinate(kSymbol)),
                  {x - half, y - half, x + half, y + half});
  }

  void paint_machine(std::size_t machine, const std::string& data, const labels::Box& box) {
    const auto& doing = scene_.machines[machine];
    const std::string style = style_of(doing, "idle");
    marks_.svg += fmt::format("<path class=\"machine {}\" d=\"{}\"><title>{}</title></path>\n",
                              style, data, markup::escaped(header_.machines[machine]));
    if (doing && doing->kind == GanttKind::kWorking) paint_progress(*doing, box);
    const double x = (box.x0 + box.x1) / 2.0;
    // Above the progress where there is not much room.
    const double y = (box.y0 + box.y1) / 2.0 - (box.y1 - box.y0 < 26.0 ? 1.5 : 0.0);
    const std::string ink = style.starts_with('s') ? "l" + style.substr(1) : "";
    marks_.svg += fmt::format("<text class=\"number {}\" x=\"{}\" y=\"{}\">{}</text>\n", ink,
                              coordinate(x), coordinate(y + 3.5), machine + 1);
    marks_.boxes.push_back(box);
    marks_.numbers.push_back({x - 7.0, y - 6.0, x + 7.0, y + 6.0});
  }

  /// Along the longer side, in the direction in which one reads.
  void paint_progress(const GanttInterval& doing, const labels::Box& box) {
    const double width = box.x1 - box.x0;
    const double height = box.y1 - box.y0;
    const double share = share_passed(doing, scene_.tick);
    const auto rect = [&](const char* style, double x, double y, double w, double h) {
      marks_.svg +=
          fmt::format("<rect class=\"{}\" x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\"/>\n", style,
                      coordinate(x), coordinate(y), coordinate(w), coordinate(h));
    };
    constexpr double kInset = 2.0;
    if (width >= height) {
      const double length = std::max(0.0, width - 2.0 * kInset);
      const double y = box.y1 - kInset - kBar;
      rect("track", box.x0 + kInset, y, length, kBar);
      rect("done", box.x0 + kInset, y, length * share, kBar);
    } else {
      const double length = std::max(0.0, height - 2.0 * kInset);
      const double x = box.x0 + kInset;
      rect("track", x, box.y0 + kInset, kBar, length);
      rect("done", x, box.y1 - kInset - length * share, kBar, length * share);
    }
  }

  const LogHeader& header_;
  const HallScene& scene_;
  const View& view_;
  std::vector<int> symbols_at_;  ///< by station
  MachineMarks marks_;
};

}  // namespace

MachineMarks machine_marks(const LogHeader& header, const HallScene& scene, const View& view) {
  return MachinePainter(header, scene, view).paint();
}

double share_passed(const GanttInterval& doing, Tick tick) {
  return std::clamp(static_cast<double>(tick - doing.begin) /
                        static_cast<double>(std::max<Tick>(1, doing.end - doing.begin)),
                    0.0, 1.0);
}

}  // namespace linewright::hall
