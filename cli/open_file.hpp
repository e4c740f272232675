#pragma once

#include <string>

namespace drape {

/// Shows a file or an address in the program that the desktop has for it, with xdg-open, and does not wait for it.
/// Where there is none, it says so.
void open_file(const std::string& what);

}  // namespace drape
