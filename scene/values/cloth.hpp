#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/bytes.hpp"
#include "core/files.hpp"
#include "core/text.hpp"
#include "drape/core/error.hpp"
#include "drape/sim/body_shape.hpp"
#include "drape/sim/effects/self_collision.hpp"
#include "scene/cloth_reader.hpp"
#include "scene/mesh_value.hpp"
#include "scene/tables.hpp"
#include "scene/usd/motion.hpp"
#include "scene/values/json_schema.hpp"
#include "scene/values/value_kind.hpp"

namespace drape {

/// A mesh file, or a shape.
class MeshKind final : public DeferredKind<MeshKind> {
  std::string form(const Key&) const override { return "mesh"; }
  Json schema(const Key&) const override { return json_schema::reference("mesh"); }
  std::optional<std::pair<std::string, Json>> definition() const override {
    using namespace json_schema;
    const Json cells = tuple({{"type", "integer"}, {"minimum", 1}}, 2), text = of_type("string");
    const Json up{{"enum", {"y", "z"}}};
    std::vector<Json> forms{text, closed({{"file", text}, {"prim", text}, {"up", up}}, {"file"}),
                            closed({{"grid", described("Columns and rows of cells.", cells)},
                                    {"pattern", {{"enum", {"diagonal", "alternating", "x", "equilateral"}}}},
                                    {"size", tuple(positive(), 2)}},
                                   {"grid"})};
    for (std::size_t i = 0; i < mesh_shape_names().size(); ++i) {
      ParametricMesh shape{.kind = static_cast<ParametricMesh::Kind>(i)};
      forms.push_back(closed({{mesh_shape_names()[i], table(mesh_shape_keys(shape))}}, {mesh_shape_names()[i]}));
    }
    return std::pair("mesh", described("A mesh file (OBJ or ASCII USD), or a shape.", any_of(std::move(forms))));
  }
};

/// A factor on all lengths, or one for each axis.
class ScaleKind final : public DeferredKind<ScaleKind> {
  std::string form(const Key&) const override { return "number or [x, y, z], above 0"; }
  Json schema(const Key&) const override {
    return json_schema::any_of({json_schema::positive(), json_schema::tuple(json_schema::positive(), 3)});
  }
};

/// A mesh file that may move.
class MovingMeshKind final : public DescribedKind<std::shared_ptr<const MeshMotion>*> {
  /// If only a file name is given, the key `prim` beside it selects the mesh in the file.
  void read(const GivenValue& given) const override {
    std::optional<MeshName> named = read_mesh_name(given.value, given.key.name, true, given.problems);
    if (!named) return;
    const TomlValue* prim = given.value.as<std::string>() == nullptr ? nullptr : given.table.find("prim");
    if (prim != nullptr && prim->as<std::string>() != nullptr) named->options.prim = *prim->as<std::string>();
    try {
      *target(given.key) =
          std::make_shared<MeshMotion>(read_mesh_motion(given.folder / named->file, named->options, &given.files));
    } catch (const UsageError& error) {
      return given.report(fmt::format("'{}' cannot be read:\n{}", shown(named->file), error.what()));
    }
    const MeshMotion& motion = **target(given.key);
    double furthest = motion.mesh.positions.lpNorm<Eigen::Infinity>();
    for (const Vertices& sample : motion.samples) furthest = std::max(furthest, sample.lpNorm<Eigen::Infinity>());
    if (furthest <= furthest_place) return;
    given.report(fmt::format("a vertex is at {:g} m; distances beyond {:g} m overflow double precision", furthest,
                             furthest_place));
  }
  std::string text(const Key&) const override { return ""; }
  /// Hashes the motion, whatever its source.
  std::optional<std::string> hashed_text(const Key& key, const TomlValue*, const Path&) const override {
    const MeshMotion* motion = target(key)->get();
    if (motion == nullptr) return "";
    const auto of = [](const Vertices& v) { return checksum_of(v.data(), static_cast<std::size_t>(v.size())); };
    Hash hash;
    hash.add(checksum_of(motion->mesh.triangles.data(), motion->mesh.triangles.size()));
    hash.add(of(motion->mesh.positions));
    hash.add(checksum_of(motion->times.data(), motion->times.size()));
    for (const Vertices& sample : motion->samples) hash.add(of(sample));
    return fmt::format("{} vertices at {} times ({})", motion->mesh.positions.rows(), motion->times.size(),
                       hash.text());
  }
  std::string form(const Key&) const override { return "mesh file"; }
  Json schema(const Key&) const override { return json_schema::reference("moving_mesh"); }
  std::optional<std::pair<std::string, Json>> definition() const override {
    using namespace json_schema;
    const Json text = of_type("string"), up{{"enum", {"y", "z"}}};
    return std::pair(
        "moving_mesh",
        any_of({text, closed({{"file", text}, {"prim", text}, {"up", up}, {"fps", positive()}}, {"file"})}));
  }
};

/// A USD file with a moving sphere.
class TrackKind final : public DescribedKind<std::shared_ptr<const SphereTrack>*> {
  void read(const GivenValue& given) const override {
    const std::optional<std::string> file = read_string(given.value, given.key.name, given.problems);
    if (!file) return;
    given.files.push_back(given.folder / *file);
    try {
      *target(given.key) = read_sphere_track(given.folder / *file);
    } catch (const UsageError& error) {
      given.report(fmt::format("'{}' cannot be read:\n{}", *file, error.what()));
    }
  }
  std::string text(const Key&) const override { return ""; }
  /// Hashes the file's content. A pipe can be read only once, so its name is returned.
  std::optional<std::string> hashed_text(const Key&, const TomlValue* written, const Path& folder) const override {
    constexpr std::size_t most_bytes = std::size_t{1} << 31;
    const std::string* name = written == nullptr ? nullptr : written->as<std::string>();
    if (name == nullptr) return "";
    const std::filesystem::path file = folder / *name;
    if (!std::filesystem::is_regular_file(file)) return file.string();
    return "a file (" + checksum_of(read_file(file, most_bytes)) + ")";
  }
  std::string form(const Key&) const override { return "file"; }
  Json schema(const Key&) const override { return json_schema::of_type("string"); }
};

/// One file, or several.
class FilesKind final : public DeferredKind<FilesKind> {
  std::string form(const Key&) const override { return "path, or [path, …]"; }
  Json schema(const Key&) const override {
    using namespace json_schema;
    return any_of({of_type("string"), list(of_type("string"))});
  }
};

/// Vertices of the cloth that the table describes.
class PinsKind final : public DeferredKind<PinsKind> {
  std::string form(const Key&) const override { return "pins"; }
  Json schema(const Key&) const override { return json_schema::reference("pins"); }
  std::optional<std::pair<std::string, Json>> definition() const override {
    using namespace json_schema;
    const Json point = tuple(of_type("number"), 3);
    const Json ball = closed({{"center", point}, {"radius", positive()}}, {"center", "radius"});
    const Json circle = closed({{"center", point}, {"radius", positive()}, {"width", positive()}, {"normal", point}},
                               {"center", "radius", "width"});
    const std::string direction = "([xyz][+-]){1,3}";
    const Json forms{
        {"box", tuple(point, 2)},     {"ball", ball},
        {"circle", circle},           {"border", {{"type", "string"}, {"pattern", "^(all|" + direction + ")$"}}},
        {"group", of_type("string")}, {"primvar", of_type("string")}};
    std::vector<Json> items{{{"type", "integer"}, {"minimum", 0}},
                            {{"type", "string"}, {"pattern", "^(border|(corner|edge):" + direction + ")$"}}};
    for (const auto& [name, form] : forms.items()) {
      items.push_back(closed({{name, form}, {"every", {{"type", "integer"}, {"minimum", 1}}}}, {name}));
    }
    return std::pair("pins", list(any_of(std::move(items))));
  }
};

/// Vertices of the cloth that the key `cloth` beside this one names.
class VertexSelectionKind final : public DescribedKind<VertexSelection> {
  void read(const GivenValue& given) const override {
    const std::size_t before = given.problems.count();
    const PlacedSelection* mesh = selected_cloth(given);
    if (given.problems.count() != before) return;
    std::vector<int>& vertices = *target(given.key).vertices;
    vertices = read_vertices(given.value, given.key.name, mesh == nullptr ? nullptr : &mesh->mesh, given.problems);
    if (mesh == nullptr) return;
    for (int& vertex : vertices) vertex += mesh->first_vertex;
  }
  std::string text(const Key& key) const override {
    const std::vector<int>& vertices = *target(key).vertices;
    return vertices.empty() ? "" : fmt::format("[{}]", fmt::join(vertices, ", "));
  }
  std::string form(const Key&) const override { return "pins"; }
  Json schema(const Key&) const override { return json_schema::reference("pins"); }

  /// Returns the cloth that `cloth` beside the key names, or the only one; null after a problem and without cloths.
  static const PlacedSelection* selected_cloth(const GivenValue& given) {
    if (given.meshes == nullptr || given.meshes->empty()) return nullptr;
    const TomlValue* name = given.table.find("cloth");
    const std::string* text = name == nullptr ? nullptr : name->as<std::string>();
    if (name == nullptr && given.meshes->size() == 1) return &given.meshes->front();
    if (name == nullptr) given.report("there are several cloths: say which one with 'cloth'");
    if (text == nullptr) return nullptr;
    const auto found = std::ranges::find(*given.meshes, *text, &PlacedSelection::name);
    if (found != given.meshes->end()) return &*found;
    std::vector<std::string> names;
    for (const PlacedSelection& mesh : *given.meshes) names.push_back(mesh.name);
    given.problems.add(name->place,
                       fmt::format("unknown cloth '{}'{}", *text, did_you_mean(*text, names, "the cloths are")));
    return nullptr;
  }
};

/// A side of a seam.
class SeamSideKind final : public DeferredKind<SeamSideKind> {
  std::string form(const Key&) const override { return "{ cloth = name, along = pins }"; }
  Json schema(const Key&) const override {
    using namespace json_schema;
    return closed({{"cloth", of_type("string")}, {"along", reference("pins")}}, {"along"});
  }
};

/// Friction of pairs of cloths. A motion's hash omits an empty list.
class ClothFrictionsKind final : public DescribedKind<std::vector<ClothFriction>*> {
  void read(const GivenValue& given) const override {
    std::vector<ClothFriction>& frictions = *target(given.key);
    frictions.clear();
    const TomlArray* list = given.value.as<TomlArray>();
    if (list == nullptr) return given.report(fmt::format("expected {}, found {}", form(given.key), given.value.kind()));
    for (const TomlValue& item : *list) {
      if (auto friction = read_item(item, given)) frictions.push_back(*std::move(friction));
    }
  }
  std::string text(const Key&) const override { return ""; }
  std::optional<std::string> hashed_text(const Key& key, const TomlValue*, const Path&) const override {
    std::string text;
    for (const auto& [cloths, friction] : *target(key)) {
      text += fmt::format("{} {} {}; ", cloths[0], cloths[1], friction);
    }
    return text.empty() ? std::nullopt : std::optional(text);
  }
  std::string form(const Key&) const override { return "[[cloth, cloth, { friction = number }], …]"; }
  Json schema(const Key&) const override {
    using namespace json_schema;
    const Json friction{{"type", "number"}, {"minimum", 0}};
    return list(
        {{"type", "array"},
         {"items", Json::array({of_type("string"), of_type("string"), closed({{"friction", friction}}, {"friction"})})},
         {"minItems", 3},
         {"maxItems", 3}});
  }

  static std::optional<ClothFriction> read_item(const TomlValue& item, const GivenValue& given) {
    const TomlArray* parts = item.as<TomlArray>();
    const TomlTable* table = parts == nullptr || parts->size() != 3 ? nullptr : (*parts)[2].as<TomlTable>();
    const TomlValue* value = table == nullptr ? nullptr : table->find("friction");
    const std::string* first = value == nullptr ? nullptr : (*parts)[0].as<std::string>();
    const std::string* second = value == nullptr ? nullptr : (*parts)[1].as<std::string>();
    if (first == nullptr || second == nullptr || table->entries.size() != 1) {
      given.problems.add(item.place, given.key.name + ": expected [\"cloth\", \"cloth\", { friction = number }]");
      return std::nullopt;
    }
    const auto friction = read_number(*value, given.key.name + ".friction", {.minimum = 0}, given.problems);
    if (!friction) return std::nullopt;
    return ClothFriction{.cloths = {*first, *second}, .friction = *friction};
  }
};

}  // namespace drape
