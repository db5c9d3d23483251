#include "gantt_body.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "gantt_labels.hpp"
#include "gantt_rows.hpp"
#include "gantt_style.hpp"
#include "linewright/base/markup.hpp"

namespace linewright::gantt {
namespace {

using markup::coordinate;
using markup::escaped;

constexpr double kAxisHeight = 48.0;
constexpr double kHeadingHeight = 24.0;
constexpr double kWorkerRow = 26.0;
constexpr double kMachineRow = 21.0;
constexpr double kMarkRow = 17.0;
constexpr double kMilestoneRow = 24.0;
constexpr double kFootHeight = 20.0;
constexpr double kBusyColumn = 48.0;
constexpr double kNarrowestGutter = 90.0;
constexpr double kWidestGutter = 220.0;
constexpr double kNameSize = 12.0;
constexpr double kOverhang = 6.0;
constexpr double kThinnestBar = 1.6;  ///< so that one tick is seen in a long run

bool is_machine(GanttKind kind) {
  return kind == GanttKind::kWorking || kind == GanttKind::kHeld || kind == GanttKind::kRecovering;
}

/// Top and height of a bar relative to a row of height `row`: ways are thin, all else is full.
std::pair<double, double> bar_extent(GanttKind kind, double row) {
  const double full = row - 7.0;
  const double height = kind == GanttKind::kTravel ? 9.0 : full;
  return {(row - height) / 2.0, height};
}

/// `s`olid, `h`atched or `o`utlined.
char texture(GanttKind kind) {
  switch (kind) {
    case GanttKind::kWork:
    case GanttKind::kWorking:
      return 's';
    case GanttKind::kTravel:
    case GanttKind::kRecovering:
      return 'h';
    case GanttKind::kWaiting:
    case GanttKind::kHeld:
      return 'o';
    case GanttKind::kClosed:
      return 'h';
  }
  return 's';
}

double gutter_width(const GanttChart& chart) {
  double widest = kNarrowestGutter;
  for (const GanttSection& section : chart.sections) {
    for (const GanttRow& row : section.rows) {
      widest = std::max(widest, markup::text_width(row.name, kNameSize) + 18.0);
    }
  }
  return std::min(widest, kWidestGutter);
}

class BodyPainter {
 public:
  BodyPainter(const GanttChart& chart, const BodyOptions& options)
      : chart_(chart), options_(options), gutter_(gutter_width(chart)) {}

  Body paint() {
    y_ = kAxisHeight;
    for (const GanttSection& section : chart_.sections) paint_section(section);
    if (!chart_.milestones.empty()) paint_milestones();
    if (!chart_.marks.empty()) paint_marks();
    const double bottom = y_;
    paint_axis(bottom);
    paint_decisions();
    paint_ending(bottom);
    const double width = gutter_ + options_.plot_width + kBusyColumn;
    const double height = bottom + kFootHeight;
    // The plot is a viewport of its own, so that zooming never draws over the names. It is a little
    // wider than the run, for the marks at its ends.
    std::string svg = back_ + names_;
    svg += fmt::format(
        "<svg class=\"plot\" x=\"{0}\" y=\"0\" width=\"{1}\" height=\"{2}\" viewBox=\"{3} 0 {1} "
        "{2}\">\n"
        "{4}{5}{6}</svg>\n",
        coordinate(gutter_ - kOverhang), coordinate(options_.plot_width + 2.0 * kOverhang),
        coordinate(height), coordinate(-kOverhang), grid_, bars_, marks_);
    return {std::move(svg), width, height, gutter_, kBusyColumn};
  }

 private:
  [[nodiscard]] double x(Tick tick) const {
    return options_.plot_width * static_cast<double>(tick) / static_cast<double>(chart_.last);
  }

  void text(std::string& into, const char* style, double at_x, double at_y,
            const std::string& words) {
    into += fmt::format("<text class=\"{}\" x=\"{}\" y=\"{}\">{}</text>\n", style, coordinate(at_x),
                        coordinate(at_y), escaped(words));
  }

  // What spans the whole width is given in percent: the page may change the width.

  void rule(double at_y) {
    back_ += fmt::format("<line class=\"axis\" x1=\"0\" y1=\"{0}\" x2=\"100%\" y2=\"{0}\"/>\n",
                         coordinate(at_y));
  }

  void at_right_edge(double at_y, const std::string& words) {
    names_ +=
        fmt::format("<text class=\"small end muted\" x=\"100%\" dx=\"-6\" y=\"{}\">{}</text>\n",
                    coordinate(at_y), escaped(words));
  }

  void paint_section(const GanttSection& section) {
    text(names_, "head ink", 4.0, y_ + kHeadingHeight - 8.0, section.heading);
    rule(y_ + kHeadingHeight - 1.0);
    y_ += kHeadingHeight;
    bool striped = false;
    const bool low = section.heading == "Machines" || section.heading == kZonesHeading;
    for (const GanttRow& row : section.rows) {
      paint_row(row, low ? kMachineRow : kWorkerRow, striped);
      striped = !striped;
    }
  }

  void paint_row(const GanttRow& row, double height, bool striped) {
    if (striped) {
      back_ += fmt::format("<rect class=\"stripe\" y=\"{}\" width=\"100%\" height=\"{}\"/>\n",
                           coordinate(y_), coordinate(height));
    }
    const double base = y_ + height / 2.0 + 4.0;
    const std::string name = markup::shortened(row.name, gutter_ - 16.0, kNameSize);
    names_ +=
        fmt::format("<text class=\"end ink\" x=\"{}\" y=\"{}\">{}<title>{}</title></text>\n",
                    coordinate(gutter_ - 10.0), coordinate(base), escaped(name), escaped(row.name));
    const double busy = 100.0 * row.busy_ticks() / chart_.last;
    at_right_edge(base - 0.5, fmt::format("{:.0f} %", busy));
    bars_ += fmt::format("<g class=\"row\" data-name=\"{}\">\n", escaped(row.name));
    for (const GanttInterval& interval : row.intervals) paint_bar(interval, height);
    for (const BarLabel& label : labels_of(row)) paint_label(label, height);
    bars_ += "</g>\n";
    y_ += height;
  }

  void paint_bar(const GanttInterval& interval, double row_height) {
    const auto [top, height] = bar_extent(interval.kind, row_height);
    const std::string style = interval.task ? std::to_string(style_of(*interval.task)) : "n";
    const double width = std::max(kThinnestBar, x(interval.end) - x(interval.begin));
    bars_ += fmt::format(
        "<rect class=\"bar {}{}\" x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" rx=\"1.5\" "
        "data-b=\"{}\" data-e=\"{}\"{}><title>{}</title></rect>\n",
        texture(interval.kind), style, coordinate(x(interval.begin)), coordinate(y_ + top),
        coordinate(width), coordinate(height), interval.begin, interval.end,
        task_attribute(interval.task), escaped(interval.text));
  }

  [[nodiscard]] static std::string task_attribute(std::optional<std::size_t> task) {
    return task ? fmt::format(" data-t=\"{}\"", *task) : std::string();
  }

  void paint_label(const BarLabel& label, double row_height) {
    const std::string number = label.task && !is_machine(label.kind)
                                   ? std::to_string(chart_.tasks[*label.task].number)
                                   : "";
    const std::string words = fitting(label.words, number, x(label.end) - x(label.begin));
    if (words.empty() && !options_.all_labels) return;
    const std::string style = label.task ? std::to_string(style_of(*label.task)) : "n";
    const std::string ink = texture(label.kind) == 's'         ? "l" + style
                            : label.kind == GanttKind::kTravel ? "halo"
                                                               : "ink";
    bars_ += fmt::format("<text class=\"name {}\" x=\"{}\" y=\"{}\"", ink,
                         coordinate((x(label.begin) + x(label.end)) / 2.0),
                         coordinate(y_ + row_height / 2.0 + 3.6));
    if (options_.all_labels) {
      bars_ +=
          fmt::format(" data-b=\"{}\" data-e=\"{}\" data-l=\"{}\" data-s=\"{}\"{}", label.begin,
                      label.end, escaped(label.words), number, task_attribute(label.task));
    }
    bars_ += fmt::format(">{}</text>\n", escaped(words));
  }

  void paint_milestones() {
    text(names_, "small end muted", gutter_ - 10.0, y_ + kMilestoneRow / 2.0 + 5.0, "milestones");
    rule(y_ + 2.0);
    const double middle = y_ + kMilestoneRow / 2.0 + 1.0;
    marks_ += "<g class=\"row\" data-name=\"milestones\">\n";
    for (const GanttMilestone& milestone : chart_.milestones) {
      marks_ += fmt::format(
          "<path class=\"mark\" d=\"M0 -4.5l3.5 4.5l-3.5 4.5l-3.5 -4.5z\" "
          "transform=\"translate({} {})\" data-b=\"{}\"><title>{}</title></path>\n",
          coordinate(x(milestone.tick)), coordinate(middle), milestone.tick,
          escaped(fmt::format("{} · tick {}", milestone.name, milestone.tick)));
    }
    marks_ += "</g>\n";
    y_ += kMilestoneRow;
  }

  /// The labels below one another where they are close, each with a line across the rows.
  void paint_marks() {
    text(names_, "small end muted", gutter_ - 10.0, y_ + kMarkRow - 4.0, "marks");
    rule(y_ + 2.0);
    std::vector<double> free_from;  // by line
    for (const GanttMark& mark : chart_.marks) {
      const double at = x(mark.tick);
      const double half = markup::text_width(mark.label, kNameSize) / 2.0 + 2.0;
      std::size_t line = 0;
      while (line < free_from.size() && at - half < free_from[line]) ++line;
      if (line == free_from.size()) free_from.push_back(0.0);
      free_from[line] = at + half;
      const double base = y_ + kMarkRow * static_cast<double>(line + 1);
      marks_ += fmt::format(
          "<g class=\"pointer\" data-b=\"{0}\" transform=\"translate({1} 0)\"><path "
          "class=\"finish\" stroke-dasharray=\"2 3\" d=\"M0 {2}V{3}\"/><text class=\"mid ink "
          "strong\" y=\"{4}\">{5}</text></g>\n",
          mark.tick, coordinate(at), coordinate(kAxisHeight), coordinate(base - 14.0),
          coordinate(base - 3.0), escaped(mark.label));
    }
    y_ += kMarkRow * static_cast<double>(free_from.size()) + 4.0;
  }

  void paint_axis(double bottom) {
    text(names_, "small end muted", gutter_ - 10.0, 13.0, "tick");
    at_right_edge(40.0, "busy");
    rule(bottom);
    grid_ +=
        fmt::format("<g class=\"ticks\" data-bottom=\"{}\" data-top=\"18\">\n", coordinate(bottom));
    const Tick step = grid_step(chart_.last, options_.plot_width);
    for (std::int64_t tick = 0; tick <= chart_.last; tick += step) {
      const double at = x(static_cast<Tick>(tick));
      grid_ += fmt::format("<path class=\"grid\" d=\"M{} 18V{}\"/>\n", coordinate(at),
                           coordinate(bottom));
      // The end of the run has a label of its own.
      const bool crowded = !chart_.ending.empty() && options_.plot_width - at < 86.0;
      if (!crowded) text(grid_, "small mid muted", at, 13.0, std::to_string(tick));
      text(grid_, "small mid muted", at, bottom + 14.0, std::to_string(tick));
    }
    grid_ += "</g>\n";
  }

  /// A mark per decision, with its number where there is room.
  void paint_decisions() {
    text(names_, "small end muted", gutter_ - 10.0, 40.0, "decisions");
    marks_ += "<g class=\"row\" data-name=\"decisions\">\n";
    double free_from = -kOverhang;
    for (const GanttDecision& decision : chart_.decisions) {
      const double at = x(decision.tick);
      marks_ += fmt::format(
          "<path class=\"bar s{}\" d=\"M0 0l-4 -8h8z\" transform=\"translate({} 45)\" "
          "data-b=\"{}\" data-n=\"{}\" data-t=\"{}\"><title>{}</title></path>\n",
          style_of(decision.task), coordinate(at), decision.tick, decision.n, decision.task,
          escaped(decision.text));
      const std::string number = std::to_string(decision.n);
      const double half = markup::text_width(number, 10.0) / 2.0;
      const bool room = at - half >= free_from;
      if (room) free_from = at + half + 3.0;
      if (room || options_.all_labels) {
        marks_ += fmt::format(
            "<text class=\"small mid muted\" x=\"{}\" y=\"32\" data-b=\"{}\">{}</text>\n",
            coordinate(at), decision.tick, number);
      }
    }
    marks_ += "</g>\n";
  }

  void paint_ending(double bottom) {
    if (chart_.ending.empty()) return;
    marks_ += fmt::format(
        "<g class=\"done{}\" data-b=\"{}\" transform=\"translate({} 0)\"><path class=\"finish\" "
        "d=\"M0 2V{}\"/>"
        "<text class=\"small end ink strong\" x=\"-5\" y=\"13\">{}</text></g>\n",
        chart_.finished ? "" : " failed", chart_.last, coordinate(options_.plot_width),
        coordinate(bottom), escaped(chart_.ending));
  }

  const GanttChart& chart_;
  const BodyOptions& options_;
  double gutter_;
  double y_ = 0.0;
  std::string back_;
  std::string names_;
  std::string grid_;
  std::string bars_;
  std::string marks_;
};

}  // namespace

Body draw_body(const GanttChart& chart, const BodyOptions& options) {
  return BodyPainter(chart, options).paint();
}

}  // namespace linewright::gantt
