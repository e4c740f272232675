#include "scene/cloth_list.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cctype>
#include <utility>

#include "scene/cloth_reader.hpp"
#include "scene/seam_reader.hpp"

namespace drape {
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
        for (const std::string& doubt : cloth->warnings) {
          list.warnings.push_back(problems.text(place_of(*item, "mesh")) + ": mesh: " + doubt);
        }
        join(table.name, items.size() > 1, std::move(*cloth), list);
      }
    }
    list.tables.push_back(std::move(table));
  }
  const bool whole = list.meshes.size() == items.size() && !items.empty();
  for (const TomlValue* item : items_of(document, "seam")) {
    SeamTable& table = list.seams.emplace_back();
    const std::size_t found = problems.count();
    reader.read(*item, seam_table(table));
    if (!whole || problems.count() != found) continue;
    if (auto seam = read_seam(table, *item, list.cloth, list.meshes, problems)) list.cloth.seams.push_back(*seam);
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

std::vector<TableType> named_tables(ClothList& cloths, Scene& scene) {
  std::vector<TableType> tables;
  const auto add = [&](TableType table, const std::string& path) {
    table.name = path;
    tables.push_back(std::move(table));
  };
  for (ClothTable& cloth : cloths.tables) {
    const std::string path = cloths.tables.size() == 1 ? "cloth" : "cloth." + cloth.name;
    std::vector<TableType> own = cloth_tables(cloth);
    add(std::move(own[0]), path);
    add(std::move(own[1]), path + ".transform");
  }
  for (std::size_t k = 0; k < cloths.seams.size(); ++k) {
    add(seam_table(cloths.seams[k]), cloths.seams.size() == 1 ? "seam" : fmt::format("seam.{}", k));
  }
  for (TableType& table : other_tables(scene)) tables.push_back(std::move(table));
  return tables;
}

}  // namespace drape
