#pragma once

#include <string>
#include <string_view>

namespace drape {

/// A text that every report can hold: U+FFFD stands for each byte that is no UTF-8 and for each character that HTML or
/// XML does not allow, which are the control characters but for newline and tab.
std::string printable(std::string_view text);

}  // namespace drape
