#include "scene/mesh_value.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/text.hpp"
#include "drape/core/error.hpp"
#include "scene/mesh/source.hpp"
#include "scene/table_reader.hpp"
#include "scene/usd/mesh.hpp"
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

namespace {

/// About 1.6 GB.
constexpr double most_numbers = 2e8;
constexpr double usual_frames_per_second = 24;

using Inputs = std::vector<std::filesystem::path>;

enum class Format { obj, usd };

std::string ending_of(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  for (char& c : ending) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return ending;
}

[[noreturn]] void fail_file(const std::filesystem::path& file, const std::string& message) {
  SourceText(file.string(), "").fail(message);
}

Format format_of(const std::filesystem::path& file) {
  const std::string ending = ending_of(file);
  if (ending == ".obj") return Format::obj;
  if (ending == ".usda" || ending == ".usd") return Format::usd;
  const std::string found = ending.empty() ? "a name without an ending" : in_quotes(file.extension().string());
  fail_file(file, "expected a mesh in an .obj, .usda or .usd file, found " + found);
}

void check_options(const std::filesystem::path& file, Format format, const MeshOptions& options) {
  if (format == Format::obj && !options.prim.empty()) fail_file(file, "an OBJ has no prims: omit 'prim'");
  if (format == Format::usd && options.up) fail_file(file, "a USD file says itself which axis is up: omit 'up'");
}

void add_inputs(const std::filesystem::path& file, const UsdStage* stage, Inputs* inputs) {
  if (inputs == nullptr) return;
  inputs->push_back(file);
  if (stage == nullptr) return;
  for (const std::filesystem::path& referenced : stage->referenced_files()) inputs->push_back(referenced);
}

Mesh read_obj(const std::filesystem::path& file, const MeshOptions& options, Inputs* inputs) {
  const SourceText source = SourceText::read(file);
  std::vector<ObjObject> objects = read_drape_objects(source);
  Mesh mesh = objects.empty() ? read_obj_mesh(source) : std::move(objects.front().mesh);
  add_inputs(file, nullptr, inputs);
  if (options.up == MeshOptions::Up::y) {  // y up: (x, y, z) → (x, −z, y), as for USD
    mesh.positions.col(1).swap(mesh.positions.col(2));
    mesh.positions.col(1) *= -1;
  }
  return mesh;
}

void require_same_triangles(const std::filesystem::path& frame, const Mesh& first, const Mesh& mesh) {
  if (mesh.positions.rows() != first.positions.rows() || mesh.triangles.size() != first.triangles.size()) {
    fail_file(frame, fmt::format(
                         "expected the {} vertices and {} triangles of the first frame, found {} vertices and {} "
                         "triangles",
                         first.positions.rows(), first.triangles.size(), mesh.positions.rows(), mesh.triangles.size()));
  }
  const auto other = std::ranges::mismatch(mesh.triangles, first.triangles);
  if (other.in1 == mesh.triangles.end()) return;
  fail_file(frame, fmt::format("expected the triangles of the first frame, but triangle {} has other vertices",
                               1 + (other.in1 - mesh.triangles.begin())));
}

MeshMotion read_sequence(const std::filesystem::path& file, const MeshOptions& options, Inputs* inputs) {
  MeshMotion motion;
  for (const std::filesystem::path& frame : frame_files(file)) {
    Mesh mesh = read_obj(frame, options, inputs);
    if (motion.samples.empty()) motion.mesh = mesh;
    require_same_triangles(frame, motion.mesh, mesh);
    motion.times.push_back(static_cast<double>(motion.samples.size()) /
                           options.frames_per_second.value_or(usual_frames_per_second));
    motion.samples.push_back(std::move(mesh.positions));
    if (static_cast<double>(motion.samples.size()) * static_cast<double>(motion.samples[0].size()) > most_numbers) {
      fail_file(frame, "so many frames and vertices take too much memory: export fewer of either");
    }
  }
  if (motion.samples.size() > 1) return motion;
  motion.times.clear();
  motion.samples.clear();
  return motion;
}

}  // namespace

bool is_obj(const std::filesystem::path& file) { return ending_of(file) == ".obj"; }

std::vector<int> read_mesh_group(const std::filesystem::path& file, const std::string& group) {
  if (file.empty() || !is_obj(file)) fail_file(file.empty() ? "grid" : file, "only an OBJ has groups");
  return read_obj_group(SourceText::read(file), group);
}

std::vector<int> read_mesh_primvar(const std::filesystem::path& file, const MeshOptions& options,
                                   const std::string& primvar) {
  if (file.empty() || is_obj(file)) fail_file(file.empty() ? "grid" : file, "only a USD file has primvars");
  const SourceText source = SourceText::read(file);
  return read_usd_primvar(UsdStage(source, {.primvar = primvar}), options.prim, primvar);
}

Mesh read_mesh(const std::filesystem::path& file, const MeshOptions& options, Inputs* inputs) {
  const Format format = format_of(file);
  check_options(file, format, options);
  if (format == Format::obj) return read_obj(file, options, inputs);
  const SourceText source = SourceText::read(file);
  const UsdStage stage(source);
  add_inputs(file, &stage, inputs);
  return read_usd_mesh(stage, options.prim);
}

MeshMotion read_mesh_motion(const std::filesystem::path& file, const MeshOptions& options, Inputs* inputs) {
  const Format format = format_of(file);
  check_options(file, format, options);
  if (format == Format::obj && names_frames(file)) return read_sequence(file, options, inputs);
  if (options.frames_per_second) {
    fail_file(file, format == Format::obj ? "a single OBJ does not move: omit 'fps', or name its frames as in "
                                            "body_{frame:04}.obj"
                                          : "a USD file says itself when its samples are: omit 'fps'");
  }
  if (format == Format::obj) return {.mesh = read_obj(file, options, inputs)};
  const SourceText source = SourceText::read(file);
  const UsdStage stage(source, {.moving_points = true});
  add_inputs(file, &stage, inputs);
  return read_usd_mesh_motion(stage, options.prim);
}

namespace {

constexpr double most_triangles = 8e6;  // same limit as for a grid

/// Returns the number of cells of the given length that fill a distance, at least one.
int cells_in(double distance, double length) {
  const double count = std::max(std::round(distance / length), 1.0);
  if (!(count < most_triangles)) throw std::invalid_argument("a mesh has at most 8 million triangles");
  return static_cast<int>(count);
}

void require_size(double triangles) {
  if (triangles > most_triangles) throw std::invalid_argument("a mesh has at most 8 million triangles");
}

/// Adds texture coordinates that cover a mesh once.
/// @param at the texture coordinates of a vertex
void cover(Mesh& mesh, const std::function<std::array<float, 2>(int)>& at) {
  for (const Triangle& triangle : mesh.triangles) {
    for (const int vertex : triangle) mesh.uvs.push_back(at(vertex));
  }
}

/// Makes rings of 6, 12, 18 … vertices around the centre, joined by triangles that are nearly equilateral.
Mesh make_disc(double radius, int rings) {
  require_size(6.0 * rings * rings);
  Mesh mesh;
  mesh.positions.setZero(1 + Eigen::Index{3} * rings * (rings + 1), 3);
  const auto first = [](int ring) { return ring == 0 ? 0 : 1 + 3 * ring * (ring - 1); };
  for (int ring = 1; ring <= rings; ++ring) {
    for (int i = 0; i < 6 * ring; ++i) {
      const double angle = std::numbers::pi * i / (3 * ring), r = radius * ring / rings;
      mesh.positions.row(first(ring) + i) << r * std::cos(angle), r * std::sin(angle), 0;
    }
  }
  for (int ring = 1; ring <= rings; ++ring) {
    const int inner = 6 * (ring - 1), outer = 6 * ring;
    const auto in = [&](int i) { return first(ring - 1) + (inner == 0 ? 0 : i % inner); };
    const auto out = [&](int i) { return first(ring) + i % outer; };
    for (int sixth = 0; sixth < 6; ++sixth) {
      for (int i = 0; i < ring; ++i) {
        const int o = sixth * ring + i, n = sixth * (ring - 1) + i;
        mesh.triangles.push_back({out(o), out(o + 1), in(n)});
        if (i + 1 < ring) mesh.triangles.push_back({in(n), out(o + 1), in(n + 1)});
      }
    }
  }
  cover(mesh, [&](int vertex) -> std::array<float, 2> {
    return {static_cast<float>((mesh.positions(vertex, 0) / radius + 1) / 2),
            static_cast<float>((mesh.positions(vertex, 1) / radius + 1) / 2)};
  });
  return mesh;
}

Mesh make_strip(double length, double width, int across) {
  const int along = cells_in(length, width / across);
  require_size(2.0 * along * across);
  Mesh mesh = make_grid(along, across);
  mesh.positions.col(0) *= length / 2;
  mesh.positions.col(1) *= width / 2;
  return mesh;
}

/// Makes the side of a frustum, open at both ends, counterclockwise seen from outside.
Mesh make_tube(const ParametricMesh& shape) {
  const double hem = shape.hem.value_or(shape.radius);
  const double slope = std::hypot(shape.length, hem - shape.radius);
  const double cell = std::numbers::pi * (hem + shape.radius) / shape.around;
  const int around = shape.around, rows = cells_in(slope, cell);
  require_size(2.0 * around * rows);
  Mesh mesh;
  mesh.positions.resize(Eigen::Index{around} * (rows + 1), 3);
  for (int row = 0; row <= rows; ++row) {
    const double t = static_cast<double>(row) / rows, r = hem + t * (shape.radius - hem);
    for (int i = 0; i < around; ++i) {
      const double angle = 2 * std::numbers::pi * i / around;
      mesh.positions.row(row * around + i) << r * std::cos(angle), r * std::sin(angle), (t - 0.5) * shape.length;
    }
  }
  const auto add = [&](int row, int i, std::array<std::array<int, 2>, 3> corners) {
    Triangle triangle{};
    for (std::size_t c = 0; c < 3; ++c) {
      const int column = i + corners[c][0], line = row + corners[c][1];
      triangle[c] = line * around + column % around;
      mesh.uvs.push_back({static_cast<float>(column) / static_cast<float>(around),
                          static_cast<float>(line) / static_cast<float>(rows)});
    }
    mesh.triangles.push_back(triangle);
  };
  for (int row = 0; row < rows; ++row) {
    for (int i = 0; i < around; ++i) {
      add(row, i, {{{1, 0}, {0, 1}, {0, 0}}});
      add(row, i, {{{1, 0}, {1, 1}, {0, 1}}});
    }
  }
  return mesh;
}

}  // namespace

const std::vector<std::string>& mesh_shape_names() {
  static const std::vector<std::string> names{"disc", "strip", "tube"};
  return names;
}

Keys mesh_shape_keys(ParametricMesh& shape) {
  using Kind = ParametricMesh::Kind;
  constexpr int most = 2000;
  Keys keys;
  switch (shape.kind) {
    case Kind::disc:
      keys.add("radius", &shape.radius, "m", "Its radius.").above(0);
      keys.add("rings", &shape.rings, "", "Edges from the centre to the border.").at_least(1).at_most(most);
      break;
    case Kind::strip:
      keys.add("length", &shape.length, "m", "Along x.").above(0);
      keys.add("width", &shape.width, "m", "Along y.").above(0);
      keys.add("across", &shape.across, "", "Cells along y; along x as many as make them square.")
          .at_least(1)
          .at_most(most);
      break;
    case Kind::tube:
      keys.add("radius", &shape.radius, "m", "Radius of its upper end.").above(0);
      keys.add("hem", &shape.hem, "m", "Radius of its lower end. Default: the same.").above(0);
      keys.add("length", &shape.length, "m", "Along z.").above(0);
      keys.add("around", &shape.around, "", "Cells around its axis; along it as many as make them square.")
          .at_least(3)
          .at_most(most);
      break;
  }
  return keys;
}

Mesh make_mesh_shape(const ParametricMesh& shape) {
  switch (shape.kind) {
    case ParametricMesh::Kind::strip:
      return make_strip(shape.length, shape.width, shape.across);
    case ParametricMesh::Kind::tube:
      return make_tube(shape);
    case ParametricMesh::Kind::disc:
      break;
  }
  return make_disc(shape.radius, shape.rings);
}

std::optional<ParametricMesh::Kind> mesh_shape_kind(const TomlValue& value) {
  const TomlTable* table = value.as<TomlTable>();
  for (std::size_t i = 0; table != nullptr && i < mesh_shape_names().size(); ++i) {
    if (table->find(mesh_shape_names()[i]) != nullptr) return static_cast<ParametricMesh::Kind>(i);
  }
  return std::nullopt;
}

std::optional<Mesh> read_mesh_shape(const TomlValue& value, const std::string& name, Problems& problems) {
  const std::size_t before = problems.count();
  ParametricMesh shape{.kind = *mesh_shape_kind(value)};
  const std::string& kind = mesh_shape_names()[static_cast<std::size_t>(shape.kind)];
  for (const TomlEntry& entry : value.as<TomlTable>()->entries) {
    if (entry.name == kind) continue;
    problems.add(entry.place, fmt::format("{}: '{}' is given, so '{}' cannot be", name, kind, entry.name));
  }
  TableReader(std::filesystem::path(), problems)
      .read(*value.as<TomlTable>()->find(kind),
            {.name = name + "." + kind, .help = {}, .keys = mesh_shape_keys(shape)});
  if (problems.count() != before) return std::nullopt;
  try {
    return make_mesh_shape(shape);
  } catch (const std::invalid_argument& error) {
    problems.add(value.place, fmt::format("{}.{}: {}", name, kind, error.what()));
    return std::nullopt;
  }
}

}  // namespace drape
