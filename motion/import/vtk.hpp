#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "motion/import/motion_source.hpp"

namespace drape {

/// Reads a legacy VTK file (.vtk), ASCII or binary: the points and polygons of POLYDATA, or of an UNSTRUCTURED_GRID of
/// polygons. Other content is ignored.
/// @param name file name for messages
/// @throws UsageError "name: message"
MeshFrame read_vtk_legacy(const std::string& name, std::string_view text);

/// Reads a VTK XML file of PolyData or an unstructured grid of polygons (.vtp, .vtu): points, polygons, the point data
/// "velocity", and drape's field data: TimeValue, energies, spheres and grounds. Arrays may be ASCII, base64 or
/// appended, of either byte order, and compressed with zlib.
/// @param name file name for messages
/// @throws UsageError "name: message"
MeshFrame read_vtk_xml(const std::string& name, const std::string& text);

/// An entry of a .pvd.
struct PvdEntry {
  double time = 0;  ///< [s]
  int part = 0;
  std::string file;  ///< relative to the .pvd
};

/// Reads a ParaView collection. @throws UsageError as above
std::vector<PvdEntry> read_pvd(const std::string& name, const std::string& text);

}  // namespace drape
