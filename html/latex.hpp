#pragma once

#include <string>
#include <string_view>

namespace drape::html {

/// A text that LaTeX sets as it is, whatever its fonts have.
std::string latex(std::string_view text);

/// What latex() writes for signs, as an object of JavaScript: for scripts that write LaTeX.
std::string latex_signs();

}  // namespace drape::html
