#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "scene/document.hpp"
#include "scene/mesh/options.hpp"
#include "scene/problems.hpp"
#include "sim/mesh.hpp"

namespace drape {

/// The mesh of a cloth for selections of vertices: before its placement in the world.
struct SelectableMesh {
  Vertices positions;  ///< [m]
  std::vector<Triangle> triangles;
  std::filesystem::path file;  ///< source file; empty for a grid
  MeshOptions options;
};

/// Parses a direction such as "x-y+": one to three axes, each once and with a sign.
std::optional<Eigen::Vector3d> parse_direction(std::string_view axes);

/// Returns the border rings, made of edges that belong to one triangle only. Each ring lists its vertices in order
/// along it, from the smallest number on.
std::vector<std::vector<int>> border_rings(const std::vector<Triangle>& triangles);

/// Reads a table that selects vertices:
///   { box = [[x, y, z], [x, y, z]] }                               between two opposite corners
///   { ball = { center, radius } }                                  at most `radius` from a point
///   { circle = { center, radius, width, normal = [0, 0, 1] } }     at most width/2 from a circle
///   { border = "z+" }, { border = "all" }                          the border ring farthest in a direction; all rings
///   { group = "waist" }                                            a group or an object of the mesh's OBJ
///   { primvar = "pinned" }                                         points where a primvar of the USD prim is not 0
/// Each takes `every = n`: the first vertex and then each n-th. The result has the order in which `every` counts.
/// @param mesh null if it could not be read: then only the form is checked
std::vector<int> read_selection(const TomlValue& value, const std::string& name, const SelectableMesh* mesh,
                                Problems& problems);

}  // namespace drape
