#include "scene/cloth_reader.hpp"

#include <fmt/format.h>
#include <Eigen/Geometry>
#include <algorithm>
#include <cctype>
#include <limits>
#include <numbers>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "drape/sim/cloth.hpp"
#include "scene/mesh_value.hpp"
#include "scene/selection.hpp"
#include "scene/table_reader.hpp"
#include "scene/values.hpp"
#include "sim/spring_network.hpp"

namespace drape {
namespace {

std::optional<Eigen::Vector3d> read_scale(const TomlValue* value, Problems& problems) {
  constexpr const char* name = "scale";
  const Range positive{.minimum = 0, .minimum_excluded = true};
  if (value == nullptr) return Eigen::Vector3d::Ones();
  if (value->as<TomlArray>() != nullptr) return read_vector(*value, name, positive, problems);
  const std::optional<double> factor = read_number(*value, name, positive, problems);
  return factor ? std::optional<Eigen::Vector3d>(Eigen::Vector3d::Constant(*factor)) : std::nullopt;
}

Eigen::Matrix3d rotation(const Eigen::Vector3d& degrees) {
  const Eigen::Vector3d angles = degrees * (std::numbers::pi / 180);
  return (Eigen::AngleAxisd(angles[2], Eigen::Vector3d::UnitZ()) *
          Eigen::AngleAxisd(angles[1], Eigen::Vector3d::UnitY()) *
          Eigen::AngleAxisd(angles[0], Eigen::Vector3d::UnitX()))
      .toRotationMatrix();
}

void scale_by(const Eigen::Vector3d& factors, Mesh& mesh) {
  for (int axis = 0; axis < 3; ++axis) mesh.positions.col(axis) *= factors[axis];
}

/// Describes how two meshes differ that should have the same vertices and triangles; empty if they match.
std::string difference(const Mesh& rest, const Mesh& mesh) {
  if (rest.positions.rows() != mesh.positions.rows()) {
    return fmt::format("it has {} vertices, mesh has {}", rest.positions.rows(), mesh.positions.rows());
  }
  if (rest.triangles.size() != mesh.triangles.size()) {
    return fmt::format("it has {} triangles, mesh has {}", rest.triangles.size(), mesh.triangles.size());
  }
  for (std::size_t t = 0; t < rest.triangles.size(); ++t) {
    const auto text = [t](const Mesh& m) { return fmt::format("({})", fmt::join(m.triangles[t], ", ")); };
    if (rest.triangles[t] != mesh.triangles[t]) {
      return fmt::format("its triangle {} is {}, in mesh it is {}", t, text(rest), text(mesh));
    }
  }
  return {};
}

/// Returns the vertices of no triangle, ascending.
std::vector<int> unused_vertices(const Mesh& mesh) {
  std::vector<char> used(static_cast<std::size_t>(mesh.positions.rows()), 0);
  for (const Triangle& triangle : mesh.triangles) {
    for (const int v : triangle) used[static_cast<std::size_t>(v)] = 1;
  }
  std::vector<int> unused;
  for (std::size_t v = 0; v < used.size(); ++v) {
    if (used[v] == 0) unused.push_back(static_cast<int>(v));
  }
  return unused;
}

/// Adds warnings about a complete cloth.
void add_doubts(const ClothTable& table, ClothAndUvs& result) {
  std::vector<std::string>& warnings = result.warnings;
  if (const auto warning = shape_of(result.cloth).size_warning()) warnings.push_back(*warning);
  const std::string* file = table.mesh->as<std::string>();  // a table may give the up axis
  const bool turned = !table.rotate.isZero(0);
  if (file != nullptr && !turned && is_obj(*file) && seems_y_up(result.mesh.positions)) {
    warnings.push_back(
        fmt::format("y seems to point up in it, and here z does: write {{ file = \"{}\", up = \"y\" }}, or "
                    "up = \"z\" to end this hint",
                    *file));
  }
}

SelectableMesh selectable_mesh(const Mesh& mesh, const TomlValue& value, const std::filesystem::path& folder) {
  SelectableMesh selectable{mesh.positions, mesh.triangles, {}, {}};
  const TomlTable* table = value.as<TomlTable>();
  if (table != nullptr && (table->find("grid") != nullptr || mesh_shape_kind(value))) return selectable;
  Problems told({}, {});  // discarded: reported when the mesh was read
  const std::optional<MeshName> named = read_mesh_name(value, "mesh", false, told);
  if (!named) return selectable;
  selectable.file = folder / named->file;
  selectable.options = named->options;
  return selectable;
}

/// Returns true if a value is a table with this key.
bool says(const TomlValue& value, const char* key) {
  const TomlTable* table = value.as<TomlTable>();
  return table != nullptr && table->find(key) != nullptr;
}

/// Returns true if a grid's cells have both diagonals, alternating or crossed.
bool has_both_diagonals(const ClothTable& table) {
  const std::optional<Grid> grid = grid_of(*table.mesh);
  return grid && (grid->pattern == GridPattern::alternating || grid->pattern == GridPattern::x) &&
         (table.rest == nullptr || grid_of(*table.rest));
}

/// Stiffens a cloth as a fabric on any mesh.
/// @param warnings gets a sentence if the mesh cannot have both moduli exactly
void stiffen_as(const Fabric& fabric, const WarpWeft& modulus, Cloth& cloth, std::vector<std::string>& warnings) {
  try {
    stiffen_as_woven(modulus, cloth);
  } catch (const std::invalid_argument& error) {
    stiffen_by_direction(modulus, cloth);
    warnings.push_back(
        fmt::format("{}: {}; each spring gets the modulus of its own direction", fabric.name, error.what()));
  }
}

/// Assigns the masses and stiffnesses that the table gives by area; returns false after problems.
bool give_material(const ClothTable& table, const TomlValue& value, ClothAndUvs& result, Problems& problems) {
  const auto by_area = [&](const char* key, bool one, const auto& other, auto of_fabric, const auto& give) {
    const bool asked = other || (!one && table.material != nullptr);
    if (!asked) return true;
    const char* blamed = other ? key : "material";
    try {
      give(other.value_or(of_fabric), result.cloth);
      return true;
    } catch (const std::invalid_argument& error) {
      problems.add(place_of(value, blamed), fmt::format("{}: {}", blamed, error.what()));
      return false;
    }
  };
  const Fabric fabric = table.material != nullptr ? *table.material : Fabric{};
  const bool massive = by_area("density", says(value, "mass"), table.density, fabric.density, share_mass_by_area);
  const auto stiffen = [&](WarpWeft modulus, Cloth& stiffened) {
    modulus.angle = table.warp * (std::numbers::pi / 180);
    if (!modulus.isotropic() && table.modulus) return stiffen_as_woven(modulus, stiffened);
    if (!modulus.isotropic()) return stiffen_as(fabric, modulus, stiffened, result.warnings);
    (has_both_diagonals(table) ? stiffen_evenly : stiffen_by_area)(modulus.warp, stiffened);
  };
  return by_area("modulus", table.stiffness.has_value(), table.modulus, fabric.modulus, stiffen) && massive;
}

/// Reports a mass or a stiffness that is given twice.
void check_said_once(const ClothTable& table, const TomlValue& value, Problems& problems) {
  const auto both = [&](const char* one, const char* other) {
    problems.add(place_of(value, other), fmt::format("{}: '{}' already sets it; give only one of them", other, one));
  };
  if (says(value, "mass") && table.density) both("mass", "density");
  if (table.stiffness && table.modulus) both("stiffness", "modulus");
}

/// Reports spring keys that do not fit together.
void check_springs(const ClothTable& table, const TomlValue& value, Problems& problems) {
  if (table.springs == ClothTable::Springs::edges) {
    for (const char* key : {"shear_stiffness", "bend_stiffness"}) {
      if (!says(value, key)) continue;
      problems.add(place_of(value, key), fmt::format("{}: only with spring = \"edges+bend\"", key));
    }
    return;
  }
  const auto wrong = [&](const char* what) {
    problems.add(place_of(value, "spring"), fmt::format("spring: \"edges+bend\" needs {}", what));
  };
  if (!table.stiffness) wrong("a 'stiffness'");
  if (table.mesh == nullptr) return;
  const std::optional<Grid> grid = grid_of(*table.mesh);
  if (!grid || grid->pattern == GridPattern::x || grid->pattern == GridPattern::equilateral) {
    wrong("a grid, of pattern \"diagonal\" or \"alternating\"");
  }
}

}  // namespace

std::optional<ClothAndUvs> read_cloth(const ClothTable& table, const TomlValue& value,
                                      const std::filesystem::path& folder, Problems& problems) {
  const std::size_t problems_before = problems.count();
  std::optional<Mesh> start, rest;
  std::vector<std::filesystem::path> inputs;
  if (table.mesh != nullptr) start = read_mesh_value(*table.mesh, "mesh", folder, inputs, problems);
  if (table.rest != nullptr) rest = read_mesh_value(*table.rest, "rest", folder, inputs, problems);
  if (start && rest) {
    const std::string differs = difference(*rest, *start);
    if (!differs.empty()) {
      problems.add(table.rest->place, "rest: expected the vertices and triangles of mesh, but " + differs);
    }
  }
  std::optional<SelectableMesh> selectable;
  if (start) selectable = selectable_mesh(*start, *table.mesh, folder);
  std::vector<int> pins;
  if (table.pins != nullptr) pins = read_vertices(*table.pins, "pins", selectable ? &*selectable : nullptr, problems);
  const std::optional<Eigen::Vector3d> scale = read_scale(table.scale, problems);
  check_said_once(table, value, problems);
  check_springs(table, value, problems);
  if (!start || !scale || problems.count() != problems_before) return std::nullopt;

  // Scale before the rest lengths are taken, rotate and translate after: these would only add rounding to them.
  scale_by(*scale, *start);
  if (!rest) rest = *start;
  if (!table.rotate.isZero(0)) start->positions = start->positions * rotation(table.rotate).transpose();
  start->positions.rowwise() += table.translate.transpose();
  if (!start->positions.allFinite()) {
    problems.add(place_of(value, "transform"), "transform: positions are no longer finite");
    return std::nullopt;
  }
  for (const Mesh* mesh : {&*start, &*rest}) {
    const double furthest = mesh->positions.cwiseAbs().maxCoeff();
    if (furthest <= furthest_place) continue;
    problems.add(place_of(value, mesh == &*start ? "mesh" : "rest"),
                 fmt::format("{}: a vertex is at {:g} m; distances beyond {:g} m overflow double precision",
                             mesh == &*start ? "mesh" : "rest", furthest, furthest_place));
    return std::nullopt;
  }

  const std::vector<int> unused = unused_vertices(*start);
  pins.insert(pins.end(), unused.begin(), unused.end());
  const auto all = static_cast<double>(start->positions.rows());
  const double mass = table.mass * all / (all - static_cast<double>(unused.size()));  // of used vertices alone
  ClothAndUvs result{make_cloth(*start, *rest, mass, table.stiffness.value_or(1), std::move(pins)),
                     std::move(start->uvs),
                     std::move(*selectable),
                     std::move(inputs),
                     {}};
  if (!give_material(table, value, result, problems)) return std::nullopt;
  if (table.springs == ClothTable::Springs::edges_and_bend) {
    const double stiffness = *table.stiffness;
    result.cloth.springs = springs_of_grid(grid_of(*table.mesh)->columns, result.cloth.rest,
                                           {.structural = stiffness,
                                            .shear = table.shear_stiffness.value_or(stiffness),
                                            .bend = table.bend_stiffness.value_or(stiffness)});
  }
  result.cloth.velocities.rowwise() = table.velocity.transpose();
  for (const int pin : result.cloth.pins) result.cloth.velocities.row(pin).setZero();
  if (!(result.cloth.masses.array() > 0).all()) {
    problems.add(place_of(value, "mass"), "mass: too small to be shared by so many vertices");
    return std::nullopt;
  }
  add_doubts(table, result);
  if (!unused.empty()) {
    result.warnings.push_back(fmt::format("{} of its {} vertices belong{} to no triangle: they stay in place",
                                          unused.size(), result.cloth.vertex_count(), unused.size() == 1 ? "s" : ""));
  }
  return result;
}

namespace {

constexpr std::string_view corner_prefix = "corner:", edge_prefix = "edge:";

class PinReader {
 public:
  PinReader(const SelectableMesh* mesh, Problems& problems)
      : mesh_(mesh), vertices_(mesh == nullptr ? nullptr : &mesh->positions), problems_(problems) {}

  void read(const TomlValue& item, const std::string& name) {
    if (item.as<std::int64_t>() != nullptr) {
      read_vertex(item, name);
    } else if (const std::string* text = item.as<std::string>()) {
      read_text(*text, item.place, name);
    } else if (item.as<TomlTable>() != nullptr) {
      const std::vector<int> selected = read_selection(item, name, mesh_, problems_);
      pins_.insert(pins_.end(), selected.begin(), selected.end());
    } else {
      problems_.add(item.place,
                    fmt::format("{}: expected a vertex number, 'corner:x-y-', 'edge:x-', 'border' or {{ box = … }}, "
                                "found {}",
                                name, item.kind()));
    }
  }

  [[nodiscard]] std::vector<int> pins() && {
    std::sort(pins_.begin(), pins_.end());
    pins_.erase(std::unique(pins_.begin(), pins_.end()), pins_.end());
    return std::move(pins_);
  }

 private:
  void read_vertex(const TomlValue& item, const std::string& name) {
    if (vertices_ == nullptr) return;
    const std::int64_t number = *item.as<std::int64_t>();
    if (number >= 0 && number < vertices_->rows()) {
      pins_.push_back(static_cast<int>(number));
    } else {
      problems_.add(item.place, fmt::format("{}: the mesh has the vertices 0 to {}, found {}", name,
                                            vertices_->rows() - 1, number));
    }
  }

  void read_text(const std::string& text, const Place& place, const std::string& name) {
    if (text == "border") {
      if (mesh_ == nullptr) return;
      for (const std::vector<int>& ring : border_rings(mesh_->triangles))
        pins_.insert(pins_.end(), ring.begin(), ring.end());
      return;
    }
    const bool edge = text.starts_with(edge_prefix), corner = text.starts_with(corner_prefix);
    std::optional<Eigen::Vector3d> direction;
    if (edge || corner) direction = parse_direction(std::string_view(text).substr(text.find(':') + 1));
    if (!direction) {
      problems_.add(place, fmt::format("{}: expected a corner like 'corner:x-y-', an edge like 'edge:x-' or 'border', "
                                       "found '{}'",
                                       name, text));
    } else if (vertices_ != nullptr && corner) {
      pins_.push_back(farthest_vertex(*direction));
    } else if (vertices_ != nullptr) {
      add_edge(*direction);
    }
  }

  /// Pins every vertex that is farthest in a direction, up to rounding.
  void add_edge(const Eigen::Vector3d& direction) {
    const Eigen::VectorXd distances = *vertices_ * direction;
    constexpr double rounding = 1e-6;
    const double least = distances.maxCoeff() - rounding * (distances.maxCoeff() - distances.minCoeff());
    for (Eigen::Index i = 0; i < distances.size(); ++i) {
      if (distances[i] >= least) pins_.push_back(static_cast<int>(i));
    }
  }

  [[nodiscard]] int farthest_vertex(const Eigen::Vector3d& direction) const {
    Eigen::Index farthest = 0;
    double most = -std::numeric_limits<double>::infinity();
    for (Eigen::Index i = 0; i < vertices_->rows(); ++i) {
      const double distance = vertices_->row(i).dot(direction);
      if (distance > most) {
        most = distance;
        farthest = i;
      }
    }
    return static_cast<int>(farthest);
  }

  const SelectableMesh* mesh_;
  const Vertices* vertices_;
  Problems& problems_;
  std::vector<int> pins_;
};

}  // namespace

std::vector<int> read_vertices(const TomlValue& value, const std::string& name, const SelectableMesh* mesh,
                               Problems& problems) {
  const TomlArray* items = value.as<TomlArray>();
  if (items == nullptr) {
    problems.add(value.place, name + ": expected an array, found " + value.kind());
    return {};
  }
  PinReader reader(mesh, problems);
  for (std::size_t i = 0; i < items->size(); ++i) reader.read((*items)[i], fmt::format("{}[{}]", name, i));
  return std::move(reader).pins();
}

namespace {

/// Returns the tables of a name: none, one, or those of an array.
std::vector<const TomlValue*> items_of(const TomlValue& document, const char* name) {
  const TomlValue* value = find_path(document, name);
  if (value == nullptr) return {};
  const TomlArray* array = value->as<TomlArray>();
  if (array == nullptr) return {value};
  std::vector<const TomlValue*> items;
  for (const TomlValue& item : *array) items.push_back(&item);
  return items;
}

/// Returns true for a name that can be part of a path: "table_cloth".
bool is_name(const std::string& text) {
  const auto letter = [](unsigned char c) { return std::isalpha(c) != 0 || c == '_'; };
  const auto sign = [&](unsigned char c) { return letter(c) || std::isdigit(c) != 0 || c == '-'; };
  return !text.empty() && letter(static_cast<unsigned char>(text[0])) && std::ranges::all_of(text, sign);
}

/// Reports a cloth without a proper name of its own.
void check_name(const TomlValue& item, const std::string& name, const std::deque<ClothTable>& before, bool several,
                Problems& problems) {
  const Place place = place_of(item, "name");
  if (name.empty()) {
    if (several) problems.add(place, "name: each of several cloths needs one");
  } else if (!is_name(name)) {
    problems.add(place, fmt::format("name: expected letters, digits, '_' and '-' after a letter, found '{}'", name));
  } else if (name == "transform") {
    problems.add(place, "name: 'transform' is the name of a table");
  } else if (std::ranges::any_of(before, [&](const ClothTable& other) { return other.name == name; })) {
    problems.add(place, fmt::format("name: there are two cloths '{}'", name));
  }
}

/// Appends the texture coordinates of a cloth, after `before` triangles.
void append_uvs(std::vector<std::array<float, 2>> uvs, std::size_t before, std::size_t triangles,
                std::vector<std::array<float, 2>>& all) {
  if (uvs.empty() && all.empty()) return;
  all.resize(3 * before, {0, 0});
  all.insert(all.end(), uvs.begin(), uvs.end());
  all.resize(3 * (before + triangles), {0, 0});
}

/// Adds a cloth that was read to those before it.
void join(const std::string& name, bool several, ClothAndUvs read, ClothList& list) {
  const std::size_t before = list.cloth.triangles.size(), triangles = read.cloth.triangles.size();
  append_uvs(std::move(read.uvs), before, triangles, list.uvs);
  list.meshes.push_back({name, list.cloth.vertex_count(), std::move(read.mesh)});
  list.inputs.insert(list.inputs.end(), read.inputs.begin(), read.inputs.end());
  if (several || !name.empty()) {
    append(name, read.cloth, list.cloth);
  } else {
    list.cloth = std::move(read.cloth);
  }
}

void read_transform(const TomlValue& item, const TableType& type, TableReader& reader) {
  if (const TomlValue* transform = find_path(item, "transform")) reader.read(*transform, type);
}

}  // namespace

ClothList read_cloths(const TomlValue& document, TableReader& reader, const std::filesystem::path& folder,
                      Problems& problems) {
  ClothList list;
  const std::vector<const TomlValue*> items = items_of(document, "cloth");
  const std::size_t before = problems.count();
  const TomlValue* written = find_path(document, "cloth");
  if (written != nullptr && items.empty()) problems.add(written->place, "cloth: expected at least one");
  for (const TomlValue* item : items) {
    ClothTable table;
    const std::vector<TableType> types = cloth_tables(table);
    reader.read(*item, types[0], {"transform"});
    read_transform(*item, types[1], reader);
    check_name(*item, table.name, list.tables, items.size() > 1, problems);
    if (item->as<TomlTable>() != nullptr) {
      if (auto cloth = read_cloth(table, *item, folder, problems)) {
        for (const std::string& warning : cloth->warnings) {
          list.warnings.push_back(problems.text(place_of(*item, "mesh")) + ": mesh: " + warning);
        }
        join(table.name, items.size() > 1, std::move(*cloth), list);
      }
    }
    list.tables.push_back(std::move(table));
  }
  const bool whole = list.meshes.size() == items.size() && !items.empty();
  for (const TomlValue* item : items_of(document, "seam")) {
    SeamTable& table = list.seams.emplace_back();
    reader.read(*item, seam_table(table));
    if (table.a == nullptr || table.b == nullptr) continue;
    static const std::deque<PlacedSelection> none;
    const auto& meshes = whole ? list.meshes : none;
    if (auto seam = read_seam(table, *item, list.cloth, meshes, problems)) list.cloth.seams.push_back(*seam);
  }
  list.good = whole && problems.count() == before;
  return list;
}

std::vector<ClothLook> cloth_looks(const ClothList& cloths, const Cloth& cloth, const TomlValue& document,
                                   const Problems& problems, Look& look) {
  std::vector<ClothLook> looks;
  const std::vector<const TomlValue*> items = items_of(document, "cloth");
  for (std::size_t k = 0; k < cloths.tables.size(); ++k) {
    const ClothTable& table = cloths.tables[k];
    ClothLook one{.color = table.color.value_or(look.color), .texture = table.texture, .place = {}};
    if (!table.texture.empty()) one.place = problems.text(place_of(*items[k], "texture"));
    if (table.texture.empty() && !table.color) one.texture = look.texture;
    if (k < cloth.pieces.size()) one.first_triangle = cloth.pieces[k].first_triangle;
    looks.push_back(std::move(one));
  }
  if (looks.size() != 1) return looks;
  look.color = looks.front().color;
  look.texture = looks.front().texture;
  return {};
}

}  // namespace drape
