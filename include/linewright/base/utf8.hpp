#pragma once

#include <cstddef>
#include <string_view>

namespace linewright {

/// Index of the first byte that is not part of well-formed UTF-8 or is a control character other
/// than tab and line ends; the size of the text when there is none.
[[nodiscard]] std::size_t first_not_text(std::string_view text);

}  // namespace linewright
