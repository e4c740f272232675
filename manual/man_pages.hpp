#pragma once

#include <string>
#include <vector>

#include "manual/command_text.hpp"
#include "scene/tables.hpp"

namespace drape {

/// A manual page: file name, "drape-render.1", and text in man macros.
struct ManPage {
  std::string file, text;
};

/// Returns a page for drape and one for each of its commands, in section 1.
std::vector<ManPage> command_pages(const CommandText& drape);

/// Returns the page of the scene format, drape-scene(5).
ManPage scene_page(const std::vector<TableText>& tables);

}  // namespace drape
