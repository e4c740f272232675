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

/// The cloth's mesh as selections of its vertices refer to it: before it is placed in the world.
struct SelectableMesh {
  Vertices positions;  ///< [m]
  std::vector<Triangle> triangles;
  std::filesystem::path file;  ///< that it is from; empty for a grid
  MeshOptions options;
};

/// The direction that "x-y+" means: one to three axes, each once and with a sign.
std::optional<Eigen::Vector3d> parse_direction(std::string_view axes);

/// The rings of edges that belong to one triangle only: the vertices of each in their order along it, from the smallest
/// number on.
std::vector<std::vector<int>> border_rings(const std::vector<Triangle>& triangles);

/// Reads a table that selects vertices, in the order in which `every` counts:
///   { box = [[x, y, z], [x, y, z]] }                               between two opposite corners
///   { ball = { center, radius } }                                  not farther from a point
///   { circle = { center, radius, width, normal = [0, 0, 1] } }     not farther from a circle than half the width
///   { border = "z+" }, { border = "all" }                          the ring of the border that is farthest there; all
///   { group = "waist" }                                            a group or an object of the mesh's OBJ
///   { primvar = "pinned" }                                         where a primvar of the mesh's USD prim is not 0
/// and beside each of these `every = n`: the first and then each n-th.
/// @param mesh null if it could not be read: then only the form is checked
std::vector<int> read_selection(const TomlValue& value, const std::string& name, const SelectableMesh* mesh,
                                Problems& problems);

}  // namespace drape
