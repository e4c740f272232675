#pragma once

#include <string>
#include <string_view>

#include "import/mesh_frame.hpp"

namespace drape {

/// Reads a legacy VTK file (.vtk), ASCII or binary: the points and polygons of POLYDATA, or of an UNSTRUCTURED_GRID of
/// polygons. Other content is ignored.
/// @param name file name for messages
/// @throws UsageError "name: message"
MeshFrame read_vtk_legacy(const std::string& name, std::string_view text);

}  // namespace drape
