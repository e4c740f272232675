#pragma once

#include <string>
#include <string_view>

namespace drape {

/// The text as Markdown shows it, also in a cell of a table: on one line, and none of its signs means anything.
std::string markdown(std::string_view text);

/// The text as code in a line of Markdown, whatever is in it.
std::string markdown_code(std::string_view text);

/// A file's name as the target of a link (RFC 3986).
std::string link_target(std::string_view file);

}  // namespace drape
