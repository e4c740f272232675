#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "drape/scene/document.hpp"
#include "drape/sim/cloth.hpp"
#include "drape/sim/mesh.hpp"
#include "scene/mesh/source.hpp"

namespace drape {

/// The mesh of a cloth for selections of vertices: before its placement in the world.
struct SelectableMesh {
  Vertices positions;  ///< [m]
  std::vector<Triangle> triangles;
  std::filesystem::path file;  ///< source file; empty for a grid
  MeshOptions options;
};

/// The mesh of one of several cloths, for selections of its vertices.
struct PlacedSelection {
  std::string name;      ///< of the cloth; may be empty if it is the only one
  int first_vertex = 0;  ///< number of its first vertex among those of all cloths
  SelectableMesh mesh;
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

/// Initial size of a cloth, shown to users so that they can check it.
struct ClothShape {
  int pieces = 0;                              ///< connected components with at least one spring
  Eigen::Vector3d extent;                      ///< size of the bounding box [m]
  double shortest_edge = 0, longest_edge = 0;  ///< [m]

  /// Returns for example "2 pieces of 2 × 2 × 0 m together, edges of 0.1 to 0.141 m".
  [[nodiscard]] std::string text() const;

  /// Returns a warning about an unusual size, if any.
  [[nodiscard]] std::optional<std::string> size_warning() const;
};

ClothShape shape_of(const Cloth& cloth);

/// Returns true if a mesh looks y-up: flat along y, or standing above y = 0 with its depth centred on z = 0. A z-up
/// mesh may look so as well; this justifies only a hint.
bool seems_y_up(const Vertices& positions);

}  // namespace drape
