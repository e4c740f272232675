#pragma once

#include <string>

#include "scene/usd/mesh.hpp"
#include "tests/support/usage_error.hpp"

/// USD files as texts, and what becomes of them when they are read.
namespace drape::test {

/// In metres, with z up; three lines.
const std::string usd_header = "#usda 1.0\n( metersPerUnit = 1\nupAxis = \"Z\" )\n";

/// What makes a mesh of one triangle: it goes between the braces of a Mesh.
const std::string usd_triangle =
    "int[] faceVertexCounts = [3]\nint[] faceVertexIndices = [0, 1, 2]\n"
    "point3f[] points = [(0, 0, 0), (1, 0, 0), (0, 1, 0)]\n";

/// The mesh of a file that is called cloth.usda.
inline Mesh usd_mesh(const std::string& text) { return read_usd_mesh(SourceText("cloth.usda", text)); }

/// Why it cannot be read; "(no error)" if it can.
inline std::string usd_error(const std::string& text) {
  return usage_error([&] { usd_mesh(text); });
}

}  // namespace drape::test
