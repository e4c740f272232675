#include "scene/mesh_value.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "core/error.hpp"
#include "core/nearest.hpp"
#include "core/text.hpp"
#include "scene/mesh_file.hpp"
#include "scene/mesh_shape.hpp"
#include "scene/values.hpp"

namespace drape {
namespace {

/// Largest grid: four million cells of cloth take about 1 GB before the first step; more is probably a typing error.
constexpr std::int64_t most_grid_cells = 4'000'000;

const std::vector<std::string> mesh_name_keys = {"file", "prim", "up"};
const std::vector<std::string> motion_name_keys = {"file", "prim", "up", "fps"};

/// Reads a key of a grid's table besides `grid`; returns false after a problem.
bool read_grid_key(const TomlEntry& entry, const std::string& name, Grid& grid, Problems& problems) {
  static const std::vector<std::string> keys = {"grid", "pattern", "size", "file", "disc", "strip", "tube"};
  static const std::vector<std::string> patterns = {"diagonal", "alternating", "x", "equilateral"};
  if (entry.name == "size") {
    grid.size = read_pair(entry.value, name + ".size", {.minimum = 0, .minimum_excluded = true}, problems);
    return grid.size.has_value();
  }
  if (entry.name != "pattern") {
    problems.add(entry.place, fmt::format("{}: unknown key '{}'{}", name, entry.name,
                                          did_you_mean(entry.name, keys, "a mesh has one of the keys")));
    return false;
  }
  const auto pattern = read_string(entry.value, name + ".pattern", problems);
  if (!pattern) return false;
  const auto place = std::ranges::find(patterns, *pattern);
  if (place == patterns.end()) {
    problems.add(entry.value.place, fmt::format("{}.pattern: unknown pattern '{}'{}", name, *pattern,
                                                did_you_mean(*pattern, patterns, "the patterns are")));
    return false;
  }
  grid.pattern = static_cast<GridPattern>(place - patterns.begin());
  return true;
}

std::optional<Grid> read_grid(const TomlValue& value, const std::string& name, Problems& problems) {
  const TomlTable& table = *value.as<TomlTable>();
  bool good = true;
  Grid grid;
  for (const TomlEntry& entry : table.entries) {
    if (entry.name != "grid") good = read_grid_key(entry, name, grid, problems) && good;
  }
  const TomlValue* cells = table.find("grid");
  if (cells == nullptr) {
    if (good) problems.add(value.place, name + ": missing key 'grid', 'disc', 'strip', 'tube' or 'file'");
    return std::nullopt;
  }
  const auto counts = read_int_pair(*cells, name + ".grid", {.minimum = 1}, problems);
  if (!counts || !good) return std::nullopt;
  grid.columns = (*counts)[0];
  grid.rows = (*counts)[1];
  if (std::int64_t{grid.columns} * grid.rows > most_grid_cells) {
    problems.add(cells->place, fmt::format("{}.grid: a grid has at most {} cells, found {}×{}", name, most_grid_cells,
                                           grid.columns, grid.rows));
    return std::nullopt;
  }
  return grid;
}

std::optional<Mesh> read_named(const TomlValue& value, const std::string& name, const std::filesystem::path& folder,
                               std::vector<std::filesystem::path>& inputs, Problems& problems) {
  const std::optional<MeshName> named = read_mesh_name(value, name, false, problems);
  if (!named) return std::nullopt;
  try {
    Mesh mesh = read_mesh(folder / named->file, named->options, &inputs);
    if (!mesh.triangles.empty()) return mesh;
    problems.add(value.place, fmt::format("{}: '{}' has no triangles", name, shown(named->file)));
  } catch (const UsageError& error) {
    problems.add(value.place, fmt::format("{}: '{}' cannot be read:\n{}", name, shown(named->file), error.what()));
  }
  return std::nullopt;
}

}  // namespace

std::optional<MeshName> read_mesh_name(const TomlValue& value, const std::string& name, bool may_move,
                                       Problems& problems) {
  if (const std::string* file = value.as<std::string>()) return MeshName{.file = *file, .options = {}};
  const TomlTable* table = value.as<TomlTable>();
  if (table == nullptr) {
    problems.add(value.place, fmt::format("{}: expected the name of a file or {{ file = …, prim = … }}, found {}", name,
                                          value.kind()));
    return std::nullopt;
  }
  const std::size_t before = problems.count();
  const std::vector<std::string>& keys = may_move ? motion_name_keys : mesh_name_keys;
  MeshName mesh;
  for (const TomlEntry& entry : table->entries) {
    if (std::ranges::find(keys, entry.name) == keys.end()) {
      problems.add(entry.place, fmt::format("{}: unknown key '{}'{}", name, entry.name,
                                            did_you_mean(entry.name, keys, "the keys are")));
      continue;
    }
    if (entry.name == "fps") {
      const Range positive{.minimum = 0, .minimum_excluded = true};
      mesh.options.frames_per_second = read_number(entry.value, name + ".fps", positive, problems);
      continue;
    }
    const auto text = read_string(entry.value, name + "." + entry.name, problems);
    if (!text) continue;
    if (entry.name == "file") mesh.file = *text;
    if (entry.name == "prim") mesh.options.prim = *text;
    if (entry.name != "up") continue;
    if (*text != "y" && *text != "z") {
      problems.add(entry.value.place, fmt::format("{}.up: expected 'y' or 'z', found '{}'", name, *text));
    }
    mesh.options.up = *text == "y" ? MeshOptions::Up::y : MeshOptions::Up::z;
  }
  if (problems.count() == before && mesh.file.empty()) problems.add(value.place, name + ": missing key 'file'");
  return problems.count() == before ? std::optional(mesh) : std::nullopt;
}

std::optional<Grid> grid_of(const TomlValue& value) {
  const TomlTable* table = value.as<TomlTable>();
  if (table == nullptr || table->find("grid") == nullptr) return std::nullopt;
  Problems told({}, {});  // discarded: reported when the mesh was read
  return read_grid(value, "mesh", told);
}

std::optional<Mesh> read_mesh_value(const TomlValue& value, const std::string& name,
                                    const std::filesystem::path& folder, std::vector<std::filesystem::path>& inputs,
                                    Problems& problems) {
  const TomlTable* table = value.as<TomlTable>();
  if (table == nullptr && value.as<std::string>() == nullptr) {
    problems.add(value.place, fmt::format("{}: expected the name of a file, {{ file = …, prim = … }} or {{ grid = "
                                          "[columns, rows] }}, found {}",
                                          name, value.kind()));
    return std::nullopt;
  }
  if (mesh_shape_kind(value)) return read_mesh_shape(value, name, problems);
  const bool named = table == nullptr || std::ranges::any_of(mesh_name_keys, [&](const std::string& key) {
                       return table->find(key) != nullptr;
                     });
  if (named) return read_named(value, name, folder, inputs, problems);
  const std::optional<Grid> grid = read_grid(value, name, problems);
  return grid ? std::optional(make_grid(*grid)) : std::nullopt;
}

}  // namespace drape
