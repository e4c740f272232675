#include "scene/cloth_reader.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <map>

#include "core/text.hpp"
#include "scene/table_reader.hpp"
#include "scene/values.hpp"

namespace drape {
namespace {

using Index = std::size_t;

constexpr double most_gathered = 4;    // ratio of the sides' lengths
constexpr double pin_distance = 1e-6;  // distance of pins that a seam may join [m]
constexpr double same_place = 1e-9;    // of a vertex and the end of an edge, as a share of the seam's length

/// A side of a seam: vertices in order, and the share of the length at each.
struct Side {
  std::vector<int> vertices;
  std::vector<double> shares;
  double length = 0;  // [m]
};

class SeamReader {
 public:
  SeamReader(const Cloth& cloth, const std::deque<PlacedSelection>& meshes, Problems& problems)
      : cloth_(cloth), meshes_(meshes), problems_(problems) {}

  /// Returns the table of a side, if its keys are known.
  const TomlTable* table_of(const TomlValue& value, const std::string& name) {
    const TomlTable* table = value.as<TomlTable>();
    if (table == nullptr) {
      problems_.add(value.place,
                    fmt::format("{}: expected {{ cloth = …, along = […] }}, found {}", name, value.kind()));
      return nullptr;
    }
    static const std::vector<std::string> keys = {"cloth", "along"};
    bool known = true;
    for (const TomlEntry& entry : table->entries) {
      if (std::ranges::find(keys, entry.name) != keys.end()) continue;
      problems_.add(entry.place, fmt::format("{}: unknown key '{}'{}", name, entry.name,
                                             did_you_mean(entry.name, keys, "the keys are")));
      known = false;
    }
    return known ? table : nullptr;
  }

  std::optional<Side> side(const TomlValue& value, const std::string& name) {
    const TomlTable* table = table_of(value, name);
    if (table == nullptr) return std::nullopt;
    const PlacedSelection* mesh = mesh_of(*table, value.place, name);
    const TomlValue* along = table->find("along");
    if (along == nullptr) problems_.add(value.place, name + ": 'along' is missing, the vertices of the side");
    if (mesh == nullptr || along == nullptr) return std::nullopt;
    const Index before = problems_.count();
    std::vector<int> selected = read_vertices(*along, name + ".along", &mesh->mesh, problems_);
    if (problems_.count() != before) return std::nullopt;
    for (int& vertex : selected) vertex += mesh->first_vertex;
    return path_of(selected, along->place, name);
  }

 private:
  const PlacedSelection* mesh_of(const TomlTable& table, const Place& place, const std::string& name) {
    const TomlValue* value = table.find("cloth");
    if (value == nullptr && meshes_.size() == 1) return &meshes_.front();
    if (value == nullptr) {
      problems_.add(place, name + ": 'cloth' is missing, the name of one of the cloths");
      return nullptr;
    }
    const auto text = read_string(*value, name + ".cloth", problems_);
    if (!text) return nullptr;
    const auto found = std::ranges::find(meshes_, *text, &PlacedSelection::name);
    if (found != meshes_.end()) return &*found;
    std::vector<std::string> names;
    for (const PlacedSelection& mesh : meshes_) {
      if (!mesh.name.empty()) names.push_back(mesh.name);
    }
    problems_.add(value->place, names.empty() ? fmt::format("{}: no cloth has a name, found '{}'", name, *text)
                                              : fmt::format("{}: unknown cloth '{}'{}", name, *text,
                                                            did_you_mean(*text, names, "the cloths are")));
    return nullptr;
  }

  /// Orders vertices along the edges between them.
  std::optional<Side> path_of(const std::vector<int>& selected, const Place& place, const std::string& name) {
    std::map<int, std::vector<int>> next = neighbours(selected, true);
    const auto is_path = [&] {
      const auto ends = std::ranges::count_if(next, [](const auto& one) { return one.second.size() == 1; });
      const bool thin = std::ranges::all_of(next, [](const auto& one) { return one.second.size() <= 2; });
      return thin && ends == 2;
    };
    if (!is_path()) next = neighbours(selected, false);
    Side side;
    if (is_path()) {
      const auto first = std::ranges::find_if(next, [](const auto& one) { return one.second.size() == 1; });
      for (int at = first->first, before = -1; at >= 0;) {
        side.vertices.push_back(at);
        const std::vector<int>& ways = next[at];
        const auto on = std::ranges::find_if(ways, [&](int to) { return to != before; });
        before = at;
        at = on == ways.end() ? -1 : *on;
      }
    }
    if (side.vertices.size() < 2 || side.vertices.size() != selected.size()) {
      problems_.add(place, fmt::format("{}: expected vertices in one open row along edges, found {} that are not", name,
                                       selected.size()));
      return std::nullopt;
    }
    measure(side);
    if (!(side.length > 0)) {
      problems_.add(place, name + ": the side has no length in the rest shape");
      return std::nullopt;
    }
    return side;
  }

  /// Returns the neighbours of each selected vertex among them.
  /// @param border true to go along border edges only
  [[nodiscard]] std::map<int, std::vector<int>> neighbours(const std::vector<int>& selected, bool border) const {
    std::map<Edge, int> uses;
    for (const Triangle& t : cloth_.triangles) {
      for (Index c = 0; c < 3; ++c) {
        const auto [i, j] = std::minmax(t[c], t[(c + 1) % 3]);
        const bool both = std::ranges::binary_search(selected, i) && std::ranges::binary_search(selected, j);
        if (both && i != j) ++uses[{i, j}];
      }
    }
    std::map<int, std::vector<int>> next;
    for (const int vertex : selected) next[vertex];
    for (const auto& [edge, count] : uses) {
      if (border && count != 1) continue;
      next[edge[0]].push_back(edge[1]);
      next[edge[1]].push_back(edge[0]);
    }
    return next;
  }

  void measure(Side& side) const {
    side.shares.assign(1, 0);
    for (Index k = 1; k < side.vertices.size(); ++k) {
      side.length += (cloth_.rest.row(side.vertices[k]) - cloth_.rest.row(side.vertices[k - 1])).norm();
      side.shares.push_back(side.length);
    }
    if (!(side.length > 0)) return;
    for (double& share : side.shares) share /= side.length;
  }

  const Cloth& cloth_;
  const std::deque<PlacedSelection>& meshes_;
  Problems& problems_;
};

/// Reverses the order of a side.
Side turned(Side side) {
  std::ranges::reverse(side.vertices);
  std::ranges::reverse(side.shares);
  for (double& share : side.shares) share = 1 - share;
  return side;
}

/// Returns the ties of the vertices of one side to points of the other.
std::vector<SeamTie> ties_between(const Side& fine, const Side& coarse, const Cloth& cloth) {
  std::vector<SeamTie> ties;
  for (Index k = 0, at = 0; k < fine.vertices.size(); ++k) {
    const double share = fine.shares[k];
    while (at + 2 < coarse.shares.size() && coarse.shares[at + 1] < share) ++at;
    const double from = coarse.shares[at], to = coarse.shares[at + 1];
    const double part = to > from ? std::clamp((share - from) / (to - from), 0.0, 1.0) : 0.0;
    SeamTie tie{.vertex = fine.vertices[k], .edge = {coarse.vertices[at], coarse.vertices[at + 1]}, .share = part};
    if (part * (to - from) <= same_place) tie.edge[1] = tie.edge[0];
    if ((1 - part) * (to - from) <= same_place) tie.edge[0] = tie.edge[1];
    if (tie.edge[0] == tie.edge[1]) tie.share = 0;
    const Eigen::RowVector3d point =
        (1 - tie.share) * cloth.positions.row(tie.edge[0]) + tie.share * cloth.positions.row(tie.edge[1]);
    tie.length = (cloth.positions.row(tie.vertex) - point).norm();
    const bool to_itself = tie.edge[0] == tie.vertex && tie.edge[1] == tie.vertex;  // the point of a dart
    if (!to_itself) ties.push_back(tie);
  }
  return ties;
}

double length_of(const std::vector<SeamTie>& ties) {
  double sum = 0;
  for (const SeamTie& tie : ties) sum += tie.length;
  return sum;
}

/// Reports sides that share a vertex, or pins that a seam cannot bring together.
bool check_ties(const Seam& seam, const TomlValue& value, const Cloth& cloth, Problems& problems) {
  const auto is_pinned = [&](int vertex) { return std::ranges::binary_search(cloth.pins, vertex); };
  if (seam.ties.empty()) {
    problems.add(value.place, "[seam]: both sides are the same vertices");
    return false;
  }
  for (const SeamTie& tie : seam.ties) {
    if (std::ranges::find(tie.edge, tie.vertex) != tie.edge.end()) {
      problems.add(value.place, fmt::format("[seam]: both sides have the vertex {}", tie.vertex));
      return false;
    }
    if (is_pinned(tie.vertex) && is_pinned(tie.edge[0]) && is_pinned(tie.edge[1]) && tie.length > pin_distance) {
      problems.add(value.place, fmt::format("[seam]: it cannot close: vertex {} and the point it is sewn to are pinned "
                                            "{:.3g} m apart",
                                            tie.vertex, tie.length));
      return false;
    }
  }
  return true;
}

}  // namespace

std::optional<Seam> read_seam(const SeamTable& table, const TomlValue& value, const Cloth& cloth,
                              const std::deque<PlacedSelection>& meshes, Problems& problems) {
  SeamReader reader(cloth, meshes, problems);
  if (meshes.empty()) {
    reader.table_of(*table.a, "a");
    reader.table_of(*table.b, "b");
    return std::nullopt;
  }
  const std::optional<Side> a = reader.side(*table.a, "a");
  const std::optional<Side> b = reader.side(*table.b, "b");
  if (!a || !b) return std::nullopt;
  const double ratio = std::max(a->length / b->length, b->length / a->length);
  if (ratio > most_gathered) {
    problems.add(value.place, fmt::format("[seam]: it cannot close: its sides are {:.3g} m and {:.3g} m long; a seam "
                                          "gathers at most {:g} times its length",
                                          a->length, b->length, most_gathered));
    return std::nullopt;
  }
  const auto ties = [&](const Side& other) {
    const bool first_is_fine = a->vertices.size() >= other.vertices.size();
    return first_is_fine ? ties_between(*a, other, cloth) : ties_between(other, *a, cloth);
  };
  const Side other_way = turned(*b);
  std::vector<SeamTie> ahead = ties(*b), back = ties(other_way);
  const bool turns = (length_of(back) < length_of(ahead)) != table.reverse;
  Seam seam{.time = table.time,
            .ties = std::move(turns ? back : ahead),
            .sides = {a->vertices, turns ? other_way.vertices : b->vertices}};
  if (!check_ties(seam, value, cloth, problems)) return std::nullopt;
  return seam;
}

}  // namespace drape
