#pragma once

#include <string>

namespace linewright::hall {

/// CSS of pictures of the hall beyond routes::style_sheet().
[[nodiscard]] std::string style_rules();

}  // namespace linewright::hall
