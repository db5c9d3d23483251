#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <string_view>

#include "linewright/base/markup.hpp"
#include "linewright/experiments/report.hpp"
#include "report_style.hpp"

namespace linewright {
namespace {

using markup::escaped;

std::string base64(std::string_view bytes) {
  constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto byte = i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U;
      group = (group << 8U) | byte;
    }
    for (std::size_t k = 0; k < 4; ++k) {
      const bool there = i + k <= bytes.size();
      text += there ? kDigits[(group >> (18U - 6U * k)) & 63U] : '=';
    }
  }
  return text;
}

std::string anchor(std::size_t section) { return fmt::format("section-{}", section + 1); }

bool is_verdict(const std::string& text) {
  constexpr std::array<std::string_view, 3> kVerdicts{"holds", "contrary", "open"};
  for (const std::string_view verdict : kVerdicts) {
    if (text == verdict) return true;
  }
  return false;
}

std::string row_html(const ReportTable::Row& row) {
  std::string html = row.secondary ? "<tr class=\"s\">" : "<tr>";
  for (std::size_t c = 0; c < row.cells.size(); ++c) {
    const std::string& cell = row.cells[c];
    if (c == 0) {
      html += fmt::format("<th scope=\"row\">{}</th>", escaped(cell));
    } else if (is_verdict(cell)) {
      html += fmt::format("<td class=\"{0}\">{0}</td>", cell);
    } else {
      html += fmt::format("<td>{}</td>", escaped(cell));
    }
  }
  return html + "</tr>\n";
}

std::string table_html(const ReportTable& table) {
  const bool verdicts = !table.header.empty() && table.header.back() == "verdict";
  std::string html =
      fmt::format("<div class=\"wide\"><table class=\"{}{}\">\n<caption>{}</caption>\n<thead><tr>",
                  table.numbers ? "n" : "", verdicts ? " v" : "", escaped(table.caption));
  for (const std::string& column : table.header) {
    html += fmt::format("<th scope=\"col\">{}</th>", escaped(column));
  }
  html += "</tr></thead>\n<tbody>\n";
  for (const ReportTable::Row& row : table.rows) html += row_html(row);
  return html + "</tbody></table></div>\n";
}

std::string figure_html(const ReportFigure& figure) {
  const std::string caption = escaped(figure.figure.caption);
  const std::string picture =
      figure.own_style ? fmt::format("<img alt=\"{}\" src=\"data:image/svg+xml;base64,{}\">",
                                     caption, base64(figure.figure.svg))
                       : figure.figure.svg;
  return fmt::format("<figure{}>{}<figcaption>{}</figcaption></figure>\n",
                     figure.figure.wide ? " class=\"w\"" : "", picture, caption);
}

std::string section_html(const ReportSection& section, std::size_t number) {
  std::string html = fmt::format("<section id=\"{}\">\n<h2>{}. {}</h2>\n", anchor(number),
                                 number + 1, escaped(section.title));
  for (const std::string& text : section.paragraphs) {
    html += fmt::format("<p>{}</p>\n", escaped(text));
  }
  for (const ReportTable& table : section.tables) html += table_html(table);
  html += "<div class=\"figures\">\n";
  for (const ReportFigure& figure : section.figures) html += figure_html(figure);
  return html + "</div>\n</section>\n";
}

std::string contents_html(const Report& report) {
  std::string html = "<nav aria-label=\"Contents\"><ol>\n";
  for (std::size_t s = 0; s < report.sections.size(); ++s) {
    html += fmt::format("<li><a href=\"#{}\">{}</a></li>\n", anchor(s),
                        escaped(report.sections[s].title));
  }
  return html + "</ol></nav>\n";
}

std::string facts_html(const Report& report) {
  std::string html = "<dl class=\"facts\">\n";
  for (const auto& [name, value] : report.facts) {
    html += fmt::format("<dt>{}</dt><dd>{}</dd>\n", escaped(name), escaped(value));
  }
  return html + "</dl>\n";
}

}  // namespace

std::string report_html(const Report& report) {
  std::string html = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">\n"
      "<meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src "
      "'unsafe-inline'; img-src data:\">\n"
      "<title>{0}</title>\n<style>{1}</style>\n</head>\n<body>\n<h1>{0}</h1>\n",
      escaped(report.title), experiments::kReportStyle);
  if (!report.summary.empty()) html += fmt::format("<p>{}</p>\n", escaped(report.summary));
  html += facts_html(report) + contents_html(report);
  for (std::size_t s = 0; s < report.sections.size(); ++s) {
    html += section_html(report.sections[s], s);
  }
  return html + "</body>\n</html>\n";
}

}  // namespace linewright
