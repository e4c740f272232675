#pragma once

#include <string>
#include <vector>

#include "manual/command_text.hpp"
#include "scene/tables.hpp"

namespace drape {

/// A manual page: its file's name, "drape-render.1", and its text in the man macros.
struct ManPage {
  std::string file, text;
};

/// A page for drape and one for each of its commands, in section 1.
std::vector<ManPage> command_pages(const CommandText& drape);

/// The page of the scene format, drape-scene(5).
ManPage scene_page(const std::vector<TableText>& tables);

}  // namespace drape
