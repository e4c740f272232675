#pragma once

#include <string>

namespace drape {

/// Opens a file or an address in its desktop application with xdg-open, without waiting. Warns if there is none.
void open_file(const std::string& what);

}  // namespace drape
