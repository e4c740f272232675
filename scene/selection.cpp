#include "scene/selection.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <vector>

#include "core/text.hpp"
#include "drape/core/error.hpp"
#include "scene/mesh_value.hpp"
#include "scene/values.hpp"

namespace drape {
namespace {

const std::vector<std::string> selection_keys = {"box", "ball", "circle", "border", "group", "primvar", "every"};

class Selection {
 public:
  Selection(const SelectableMesh* mesh, Problems& problems) : mesh_(mesh), problems_(problems) {}

  void read(const TomlEntry& entry, const std::string& name) {
    const std::size_t before = problems_.count();
    if (entry.name == "box") read_box(entry.value, name);
    if (entry.name == "ball") read_ball(entry.value, name);
    if (entry.name == "circle") read_circle(entry.value, name);
    if (entry.name == "border") read_border(entry.value, name);
    if (entry.name == "group" || entry.name == "primvar") read_named(entry, name);
    if (mesh_ == nullptr || problems_.count() != before || !vertices_.empty()) return;
    const bool of_space = entry.name == "box" || entry.name == "ball" || entry.name == "circle";
    problems_.add(entry.value.place, of_space ? fmt::format("{}: no vertex of the mesh is in this {}", name, entry.name)
                                              : fmt::format("{}: it has no vertex", name));
  }

  std::vector<int> every(std::size_t n) && {
    std::vector<int> kept;
    for (std::size_t i = 0; i < vertices_.size(); i += n) kept.push_back(vertices_[i]);
    return kept;
  }

 private:
  template <class Inside>
  void add_where(const Inside& inside) {
    for (Eigen::Index i = 0; mesh_ != nullptr && i < mesh_->positions.rows(); ++i) {
      if (inside(Eigen::Vector3d(mesh_->positions.row(i)))) vertices_.push_back(static_cast<int>(i));
    }
  }

  void read_box(const TomlValue& box, const std::string& name) {
    const TomlArray* corners = box.as<TomlArray>();
    if (corners == nullptr || corners->size() != 2) {
      problems_.add(box.place,
                    fmt::format("{}: expected two corners, [[x, y, z], [x, y, z]], found {}", name,
                                corners == nullptr ? box.kind() : fmt::format("an array of {}", corners->size())));
      return;
    }
    const auto a = read_vector((*corners)[0], name + "[0]", {}, problems_);
    const auto b = read_vector((*corners)[1], name + "[1]", {}, problems_);
    if (!a || !b) return;
    const Eigen::Array3d low = a->cwiseMin(*b), high = a->cwiseMax(*b);
    add_where([&](const Eigen::Vector3d& p) { return (p.array() >= low).all() && (p.array() <= high).all(); });
  }

  /// Returns the entry of a table; null after reporting that it is missing.
  const TomlValue* part(const TomlValue& value, const char* key, const std::string& name) {
    const TomlValue* found = value.as<TomlTable>()->find(key);
    if (found == nullptr) problems_.add(value.place, fmt::format("{}: missing key '{}'", name, key));
    return found;
  }

  /// Returns true if a value is a table with only these keys; reports a problem otherwise.
  bool is_table(const TomlValue& value, const std::vector<std::string>& keys, const std::string& name) {
    const TomlTable* table = value.as<TomlTable>();
    if (table == nullptr) {
      problems_.add(value.place, fmt::format("{}: expected {{ {} = … }}, found {}", name, keys.front(), value.kind()));
      return false;
    }
    const std::size_t before = problems_.count();
    for (const TomlEntry& entry : table->entries) {
      if (std::ranges::find(keys, entry.name) != keys.end()) continue;
      problems_.add(entry.place, fmt::format("{}: unknown key '{}'{}", name, entry.name,
                                             did_you_mean(entry.name, keys, "the keys are")));
    }
    return problems_.count() == before;
  }

  std::optional<double> length(const TomlValue& value, const char* key, const std::string& name) {
    const TomlValue* found = part(value, key, name);
    if (found == nullptr) return std::nullopt;
    return read_number(*found, fmt::format("{}.{}", name, key), {.minimum = 0, .minimum_excluded = true}, problems_);
  }

  std::optional<Eigen::Vector3d> center(const TomlValue& value, const std::string& name) {
    const TomlValue* found = part(value, "center", name);
    return found == nullptr ? std::nullopt : read_vector(*found, name + ".center", {}, problems_);
  }

  void read_ball(const TomlValue& ball, const std::string& name) {
    if (!is_table(ball, {"center", "radius"}, name)) return;
    const auto middle = center(ball, name);
    const auto radius = length(ball, "radius", name);
    if (!middle || !radius) return;
    add_where([&](const Eigen::Vector3d& p) { return (p - *middle).norm() <= *radius; });
  }

  void read_circle(const TomlValue& circle, const std::string& name) {
    if (!is_table(circle, {"center", "radius", "width", "normal"}, name)) return;
    const auto middle = center(circle, name);
    const auto radius = length(circle, "radius", name), width = length(circle, "width", name);
    std::optional<Eigen::Vector3d> normal = Eigen::Vector3d::UnitZ();
    if (const TomlValue* given = circle.as<TomlTable>()->find("normal")) {
      normal = read_vector(*given, name + ".normal", {}, problems_);
      if (normal && !(normal->stableNorm() > 0)) {
        problems_.add(given->place, name + ".normal: expected a direction, found [0, 0, 0]");
        return;
      }
    }
    if (!middle || !radius || !width || !normal) return;
    const Eigen::Vector3d axis = normal->stableNormalized();
    add_where([&](const Eigen::Vector3d& p) {
      const double height = (p - *middle).dot(axis);
      const double out = (p - *middle - height * axis).norm() - *radius;
      return 2 * std::hypot(height, out) <= *width;
    });
  }

  void read_border(const TomlValue& value, const std::string& name) {
    const std::optional<std::string> which = read_string(value, name, problems_);
    if (!which) return;
    const std::optional<Eigen::Vector3d> direction = parse_direction(*which);
    if (!direction && *which != "all") {
      problems_.add(value.place, fmt::format("{}: expected 'all' or a direction like 'z+', found '{}'", name, *which));
      return;
    }
    if (mesh_ == nullptr) return;
    const std::vector<int>* farthest = nullptr;
    double most = -std::numeric_limits<double>::infinity();
    const std::vector<std::vector<int>> rings = border_rings(mesh_->triangles);
    for (const std::vector<int>& ring : rings) {
      if (!direction) {
        vertices_.insert(vertices_.end(), ring.begin(), ring.end());
        continue;
      }
      const double distance = mesh_->positions(ring, Eigen::all).colwise().mean().dot(*direction);
      if (farthest != nullptr && distance <= most) continue;
      farthest = &ring;
      most = distance;
    }
    if (farthest != nullptr) vertices_ = *farthest;
  }

  void read_named(const TomlEntry& entry, const std::string& name) {
    const std::optional<std::string> text = read_string(entry.value, name, problems_);
    if (!text || mesh_ == nullptr) return;
    try {
      vertices_ = entry.name == "group" ? read_mesh_group(mesh_->file, *text)
                                        : read_mesh_primvar(mesh_->file, mesh_->options, *text);
      if (!vertices_.empty() && std::ranges::max(vertices_) >= mesh_->positions.rows()) {
        problems_.add(entry.value.place, fmt::format("{}: '{}' is no part of the cloth", name, *text));
        vertices_.clear();
      }
    } catch (const UsageError& error) {
      problems_.add(entry.value.place, fmt::format("{}: {}", name, error.what()));
    }
  }

  const SelectableMesh* mesh_;
  Problems& problems_;
  std::vector<int> vertices_;
};

}  // namespace

std::optional<Eigen::Vector3d> parse_direction(std::string_view axes) {
  if (axes.empty() || axes.size() % 2 != 0) return std::nullopt;
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < axes.size(); i += 2) {
    const std::size_t axis = std::string_view("xyz").find(axes[i]);
    const char sign = axes[i + 1];
    if (axis == std::string_view::npos || (sign != '+' && sign != '-')) return std::nullopt;
    double& component = direction[static_cast<Eigen::Index>(axis)];
    if (component != 0) return std::nullopt;
    component = sign == '+' ? 1 : -1;
  }
  return direction;
}

std::vector<std::vector<int>> border_rings(const std::vector<Triangle>& triangles) {
  std::map<Edge, int> uses;
  const auto for_edges = [&](const auto& visit) {
    for (const Triangle& t : triangles) {
      for (std::size_t i = 0; i < 3; ++i) visit(t[i], t[(i + 1) % 3]);
    }
  };
  const auto edge = [](int a, int b) { return Edge{std::min(a, b), std::max(a, b)}; };
  for_edges([&](int a, int b) { ++uses[edge(a, b)]; });
  std::multimap<int, int> next;  // border edges, directed as in their triangles
  for_edges([&](int a, int b) {
    if (a != b && uses[edge(a, b)] == 1) next.emplace(a, b);
  });
  std::vector<std::vector<int>> rings;
  while (!next.empty()) {
    std::vector<int>& ring = rings.emplace_back();
    for (auto step = next.begin(); step != next.end();) {
      ring.push_back(step->first);
      const int to = step->second;
      next.erase(step);
      step = next.find(to);
    }
  }
  return rings;
}

std::vector<int> read_selection(const TomlValue& value, const std::string& name, const SelectableMesh* mesh,
                                Problems& problems) {
  const std::size_t before = problems.count();
  const TomlEntry* form = nullptr;
  int every = 1;
  for (const TomlEntry& entry : value.as<TomlTable>()->entries) {
    if (std::ranges::find(selection_keys, entry.name) == selection_keys.end()) {
      problems.add(entry.place, fmt::format("{}: unknown key '{}'{}", name, entry.name,
                                            did_you_mean(entry.name, selection_keys, "the keys are")));
    } else if (entry.name == "every") {
      every = read_int(entry.value, name + ".every", {.minimum = 1}, problems).value_or(1);
    } else if (form != nullptr) {
      problems.add(entry.place, fmt::format("{}: a selection has one form, and '{}' is given", name, form->name));
    } else {
      form = &entry;
    }
  }
  if (form == nullptr && problems.count() == before) problems.add(value.place, name + ": expected { box = … }");
  if (form == nullptr) return {};
  Selection selection(mesh, problems);
  selection.read(*form, name + "." + form->name);
  return std::move(selection).every(static_cast<std::size_t>(every));
}

namespace {

constexpr double large = 100, small = 1e-3;  // warning limits [m]

/// Disjoint sets of vertices; the vertices of one piece have one root.
class Pieces {
 public:
  explicit Pieces(int count) : parents_(static_cast<std::size_t>(count)) {
    std::iota(parents_.begin(), parents_.end(), 0);
  }
  int root(int vertex) {
    while (parent(vertex) != vertex) {
      parent(vertex) = parent(parent(vertex));  // path compression
      vertex = parent(vertex);
    }
    return vertex;
  }
  /// Joins the sets of two vertices; returns true if they were separate.
  bool join(int a, int b) {
    const int from = root(a), to = root(b);
    parent(from) = to;
    return from != to;
  }

 private:
  int& parent(int vertex) { return parents_[static_cast<std::size_t>(vertex)]; }

  std::vector<int> parents_;
};

}  // namespace

ClothShape shape_of(const Cloth& cloth) {
  ClothShape shape;
  shape.extent = (cloth.positions.colwise().maxCoeff() - cloth.positions.colwise().minCoeff()).transpose();
  Pieces pieces(cloth.vertex_count());
  std::vector<bool> held(static_cast<std::size_t>(cloth.vertex_count()));
  for (const Spring& spring : cloth.springs) {
    for (const int end : {spring.i, spring.j}) {
      if (held[static_cast<std::size_t>(end)]) continue;
      held[static_cast<std::size_t>(end)] = true;
      ++shape.pieces;
    }
    if (pieces.join(spring.i, spring.j)) --shape.pieces;
    const double length = (cloth.positions.row(spring.i) - cloth.positions.row(spring.j)).norm();
    const bool first = &spring == &cloth.springs.front();
    shape.shortest_edge = first ? length : std::min(shape.shortest_edge, length);
    shape.longest_edge = std::max(shape.longest_edge, length);
  }
  return shape;
}

std::string ClothShape::text() const {
  constexpr double rounding = 1e-12;  // relative to the largest extent: thinner is flat
  const Eigen::Vector3d shown = (extent.array() > rounding * extent.maxCoeff()).select(extent, 0.0);
  return fmt::format("{} {} of {:.3g} × {:.3g} × {:.3g} m{}, edges of {:.3g} to {:.3g} m", pieces,
                     pieces == 1 ? "piece" : "pieces", shown.x(), shown.y(), shown.z(), pieces == 1 ? "" : " together",
                     shortest_edge, longest_edge);
}

std::optional<std::string> ClothShape::size_warning() const {
  const double size = extent.maxCoeff();
  if (size <= large && size >= small) return std::nullopt;
  return fmt::format("the cloth is {:.3g} m {}: are its coordinates metres? [cloth.transform] scale changes them", size,
                     size > large ? "large" : "small");
}

bool seems_y_up(const Vertices& positions) {
  if (positions.rows() == 0) return false;
  const Eigen::RowVector3d low = positions.colwise().minCoeff(), high = positions.colwise().maxCoeff();
  const Eigen::RowVector3d extent = high - low, middle = (low + high) / 2;
  constexpr double thin = 0.3, centred = 0.25;
  const bool lies = extent.y() < thin * std::min(extent.x(), extent.z());
  const bool stands = low.y() > 0 && extent.y() > extent.z() && std::abs(middle.z()) < centred * extent.z();
  return lies || stands;
}

}  // namespace drape
