#include "hall_caption.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "hall_marks.hpp"
#include "linewright/base/markup.hpp"

namespace linewright::hall {
namespace {

using markup::coordinate;
using markup::escaped;

constexpr double kRow = 17.0;
constexpr double kHead = 22.0;
constexpr double kText = 12.0;
constexpr double kIndent = 22.0;
constexpr double kGap = 28.0;
constexpr double kLeftShare = 0.52;
constexpr std::size_t kMostRows = 40;        // per list; the rest is counted
constexpr std::size_t kManyMachines = 24;    // beyond, idle ones are left out
constexpr std::size_t kMostMaterial = 2000;  // letters

/// Rows of one column, from the top down.
class Column {
 public:
  Column(double x, double width) : x_(x), width_(width) {}

  void head(const std::string& words) {
    if (y_ > 0.0) y_ += kRow / 2.0;
    svg_ += fmt::format("<text class=\"head muted\" x=\"{}\" y=\"{}\">{}</text>\n", coordinate(x_),
                        coordinate(y_ + 14.0), escaped(words));
    y_ += kHead;
  }

  /// A swatch in the style (none when empty), a number in it, the name, and words beside it.
  void row(const std::string& style, const std::string& number, const std::string& name,
           const std::string& words, const std::string& muted) {
    const double base = y_ + 12.5;
    if (!style.empty()) {
      svg_ += fmt::format(
          "<rect class=\"machine {}\" x=\"{}\" y=\"{}\" width=\"16\" height=\"13\" rx=\"2\"/>\n",
          style, coordinate(x_), coordinate(base - 10.5));
    }
    if (!number.empty()) {
      const std::string ink = style.starts_with('s') ? "l" + style.substr(1) : "";
      svg_ += fmt::format("<text class=\"number {}\" x=\"{}\" y=\"{}\">{}</text>\n", ink,
                          coordinate(x_ + 8.0), coordinate(base - 0.5), number);
    }
    const double name_width = markup::text_width(name, kText) * 1.12;
    const double room = width_ - kIndent - name_width - 8.0;
    const std::string said = markup::shortened(words, room, kText);
    const std::string rest =
        markup::shortened(muted, room - markup::text_width(said + " ", kText), kText);
    svg_ += fmt::format(
        "<text class=\"ink\" x=\"{}\" y=\"{}\"><tspan class=\"strong\">{}</tspan><tspan "
        "dx=\"8\">{}</tspan>{}</text>\n",
        coordinate(x_ + kIndent), coordinate(base), escaped(name), escaped(said),
        muted.empty() ? ""
                      : fmt::format("<tspan class=\"muted\" dx=\"5\">{}</tspan>", escaped(rest)));
    y_ += kRow;
  }

  void more(std::size_t count, const char* of) {
    if (count > 0) row("", "", fmt::format("and {} more {}", count, of), "", "");
  }

  /// Entries one after the other, in as many lines as they need.
  void flow(const std::vector<std::string>& entries) {
    std::string line;
    const auto write = [&] {
      svg_ += fmt::format("<text class=\"ink\" x=\"{}\" y=\"{}\">{}</text>\n", coordinate(x_),
                          coordinate(y_ + 12.5), escaped(line));
      y_ += kRow;
      line.clear();
    };
    for (const std::string& entry : entries) {
      const std::string longer = line.empty() ? entry : line + " · " + entry;
      if (!line.empty() && markup::text_width(longer, kText) > width_) {
        write();
        line = entry;
      } else {
        line = longer;
      }
    }
    if (!line.empty()) write();
  }

  [[nodiscard]] const std::string& svg() const { return svg_; }
  [[nodiscard]] double height() const { return y_; }

 private:
  double x_;
  double width_;
  double y_ = 0.0;
  std::string svg_;
};

std::string passed(const GanttInterval& doing, Tick tick) {
  return fmt::format("{}/{} ticks", tick - doing.begin, doing.end - doing.begin);
}

class CaptionWriter {
 public:
  CaptionWriter(const LogDocument& log, const HallScene& scene, double width)
      : header_(log.header),
        scene_(scene),
        left_(0.0, width * kLeftShare - kGap),
        right_(width * kLeftShare, width * (1.0 - kLeftShare)) {}

  Caption write() {
    write_workers();
    write_carriers();
    write_machines();
    write_material();
    return {left_.svg() + right_.svg(), std::max(left_.height(), right_.height())};
  }

 private:
  void write_workers() {
    left_.head("WHO DOES WHAT");
    const std::size_t count = std::min(scene_.workers.size(), kMostRows);
    for (std::size_t w = 0; w < count; ++w) write_worker(w);
    left_.more(scene_.workers.size() - count, "workers");
  }

  void write_worker(std::size_t w) {
    const SceneWorker& worker = scene_.workers[w];
    const std::string& id = header_.workers[w].id;
    const std::string style = style_of(worker.doing, "free");
    if (!worker.doing) {
      left_.row(style, "", id, "free at " + header_.stations[worker.station.index()].name, "");
      return;
    }
    const GanttInterval& doing = *worker.doing;
    const std::string task = doing.task ? header_.tasks[*doing.task].name : "free, to rest";
    const std::string when = doing.kind == GanttKind::kWaiting
                                 ? fmt::format("since tick {}", doing.begin)
                                 : passed(doing, scene_.tick);
    left_.row(style, "", id, task + ": " + doing.what, when);
  }

  void write_carriers() {
    const std::size_t count = std::min(scene_.carriers.size(), kMostRows);
    for (std::size_t c = 0; c < count; ++c) {
      const SceneCarrier& carrier = scene_.carriers[c];
      const std::string where = carrier.holder
                                    ? "with " + header_.workers[carrier.holder->index()].id
                                    : "at " + header_.stations[carrier.station.index()].name;
      const std::string load =
          carrier.items > 0 ? fmt::format("{} × {}", carrier.items, carrier.of) : "empty";
      left_.row("", "", header_.carriers[c].id, where + ": " + load, "");
    }
    left_.more(scene_.carriers.size() - count, "carriers");
  }

  void write_machines() {
    if (header_.machines.empty()) return;
    right_.head("MACHINES");
    const bool all = header_.machines.size() <= kManyMachines;
    std::size_t written = 0;
    std::size_t left_out = 0;
    for (std::size_t m = 0; m < header_.machines.size(); ++m) {
      const auto& doing = scene_.machines[m];
      if ((!all && !doing) || written >= kMostRows) {
        ++left_out;
        continue;
      }
      ++written;
      const bool timed = doing && doing->kind != GanttKind::kHeld;
      right_.row(style_of(doing, "idle"), std::to_string(m + 1), header_.machines[m],
                 doing ? (doing->label.empty() ? doing->what : doing->label) : "idle",
                 timed ? passed(*doing, scene_.tick) : "");
    }
    right_.more(left_out, all ? "machines" : "machines, idle or not shown");
  }

  /// What is anywhere but in carriers.
  void write_material() {
    std::vector<std::string> entries;
    std::size_t letters = 0;
    for (std::size_t p = 0; p < header_.places.size() && letters < kMostMaterial; ++p) {
      const LogPlace& place = header_.places[p];
      if (!place.berth.empty() || scene_.tokens[p] == 0) continue;
      const bool limited = place.capacity && *place.capacity > 1;
      entries.push_back(fmt::format("{} {}{}", place.name, scene_.tokens[p],
                                    limited ? fmt::format("/{}", *place.capacity) : ""));
      letters += entries.back().size();
    }
    if (entries.empty()) return;
    left_.head("MATERIAL");
    left_.flow(entries);
  }

  const LogHeader& header_;
  const HallScene& scene_;
  Column left_;
  Column right_;
};

}  // namespace

Caption caption_of(const LogDocument& log, const HallScene& scene, double width) {
  return CaptionWriter(log, scene, width).write();
}

}  // namespace linewright::hall
