#pragma once

#include <cstddef>
#include <string>

// Colours and textures of charts.
//
// Class names, with i = style_of(task) or `n` for what belongs to no task: `s<i>` solid, `h<i>`
// hatched, `o<i>` outlined and faint, `l<i>` text on solid. Colours are Okabe and Ito's, extended
// so that any two differ also for the colour-blind; every task also has a number, because colour
// alone never suffices.
namespace linewright::gantt {

/// Tasks beyond this many look like earlier ones; their numbers differ.
inline constexpr std::size_t kStyles = 36;

[[nodiscard]] constexpr std::size_t style_of(std::size_t task) { return task % kStyles; }

/// CSS for `tasks` tasks, light and, where the viewer prefers it, dark.
[[nodiscard]] std::string style_sheet(std::size_t tasks);

/// The `<defs>` with the hatchings that the style sheet names.
[[nodiscard]] std::string hatchings(std::size_t tasks);

}  // namespace linewright::gantt
