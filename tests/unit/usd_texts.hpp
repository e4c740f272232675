#pragma once

#include <string>

#include "scene/usd/mesh.hpp"
#include "tests/support/usage_error.hpp"

/// USD files as texts, and the results of reading them.
namespace drape::test {

/// A header in metres, with z up; three lines.
const std::string usd_header = "#usda 1.0\n( metersPerUnit = 1\nupAxis = \"Z\" )\n";

/// A mesh of one triangle, to insert between the braces of a Mesh.
const std::string usd_triangle =
    "int[] faceVertexCounts = [3]\nint[] faceVertexIndices = [0, 1, 2]\n"
    "point3f[] points = [(0, 0, 0), (1, 0, 0), (0, 1, 0)]\n";

/// Reads the mesh of a file named cloth.usda.
inline Mesh usd_mesh(const std::string& text) { return read_usd_mesh(SourceText("cloth.usda", text)); }

/// Returns the error of reading it; "(no error)" if there is none.
inline std::string usd_error(const std::string& text) {
  return usage_error([&] { usd_mesh(text); });
}

}  // namespace drape::test
