#include <fmt/format.h>

#include <utility>

#include "gantt_rows.hpp"

namespace linewright::gantt {

std::vector<GanttRow> zone_rows(const LogDocument& log, std::size_t& budget) {
  std::vector<GanttRow> rows;
  std::vector<RowBuilder> builders;
  for (const LogZone& zone : log.header.zones) rows.push_back({zone.name, {}});
  for (GanttRow& row : rows) builders.emplace_back(row, log.end.tick, budget);
  std::vector<Tick> since(rows.size(), -1);
  const auto open = [&](std::size_t zone, Tick tick) {
    if (since[zone] < 0) return;
    builders[zone].add({since[zone],
                        tick,
                        GanttKind::kClosed,
                        {},
                        0,
                        "closed",
                        fmt::format("zone {} · closed", rows[zone].name),
                        "closed"});
    since[zone] = -1;
  };
  for (const LoggedEvent& event : log.events) {
    const auto* change = std::get_if<LoggedZone>(&event.what);
    if (change == nullptr) continue;
    if (change->closed) {
      since[change->zone.index()] = event.tick;
    } else {
      open(change->zone.index(), event.tick);
    }
  }
  for (std::size_t zone = 0; zone < rows.size(); ++zone) open(zone, log.end.tick);
  std::erase_if(rows, [](const GanttRow& row) { return row.intervals.empty(); });
  return rows;
}

}  // namespace linewright::gantt
