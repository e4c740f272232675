#include "scene/mesh_file.hpp"

#include <algorithm>
#include <string>

#include "scene/mesh/obj.hpp"
#include "scene/mesh/source.hpp"
#include "scene/usd/mesh.hpp"

namespace drape {

Mesh read_mesh(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  for (char& c : ending) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  if (ending == ".obj") return read_obj_mesh(SourceText::read(file));
  if (ending == ".usda" || ending == ".usd") return read_usd_mesh(SourceText::read(file));
  const std::string found = ending.empty() ? "a name without an ending" : in_quotes(file.extension().string());
  SourceText(file.string(), "").fail("expected a mesh in an .obj, .usda or .usd file, found " + found);
}

}  // namespace drape
