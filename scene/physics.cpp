#include "scene/physics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <any>
#include <memory>
#include <optional>

#include "core/hash.hpp"
#include "core/read_file.hpp"
#include "scene/effects_reader.hpp"
#include "scene/tables.hpp"
#include "scene/value_text.hpp"
#include "sim/body_shape.hpp"
#include "sim/mesh_motion.hpp"

namespace drape {
namespace {

constexpr std::size_t most_bytes = std::size_t{1} << 31;

/// Hashes consecutive numbers.
template <class Number>
std::string hash_of(const Number* numbers, std::size_t count) {
  Hash hash;
  hash.add(numbers, count * sizeof(Number));
  return hash.text();
}

std::string hash_of(const Vertices& v) { return hash_of(v.data(), static_cast<std::size_t>(v.size())); }

std::string springs_text(const std::vector<Spring>& springs) {
  Hash hash;
  for (const Spring& spring : springs) {
    hash.add(&spring.i, sizeof spring.i);
    hash.add(&spring.j, sizeof spring.j);
    hash.add(&spring.rest_length, sizeof spring.rest_length);
    hash.add(&spring.stiffness, sizeof spring.stiffness);
  }
  return fmt::format("{} springs ({})", springs.size(), hash.text());
}

/// Returns the hash of a file's content. A pipe can be read only once, so its name is returned.
std::string file_text(const std::filesystem::path& file) {
  if (!std::filesystem::is_regular_file(file)) return file.string();
  Hash hash;
  hash.add(drape::read_file(file, most_bytes));
  return "a file (" + hash.text() + ")";
}

/// Describes a moving mesh, whatever its source.
std::string motion_text(const MeshMotion* motion) {
  if (motion == nullptr) return "";
  Hash hash;
  hash.add(hash_of(motion->mesh.triangles.data(), motion->mesh.triangles.size()));
  hash.add(hash_of(motion->mesh.positions));
  hash.add(hash_of(motion->times.data(), motion->times.size()));
  for (const Vertices& sample : motion->samples) hash.add(hash_of(sample));
  return fmt::format("{} vertices at {} times ({})", motion->mesh.positions.rows(), motion->times.size(), hash.text());
}

/// Describes the shape of a body, if it is of the key's kind.
std::string shape_text(const BodyShapeKey& key) {
  if (!*key.shape || (*key.shape)->kind != key.kind) return "";
  const BodyShape& s = **key.shape;
  return fmt::format("{} {} {} {} {} {}", s.radius, s.height, s.top, s.width, s.depth, s.segments);
}

/// Returns text for a value in a custom form of an effect; nothing for other values.
std::optional<std::string> own_text(const Key& key) {
  const auto* form = std::get_if<CustomValue>(&key.target);
  if (const auto* shape = form == nullptr ? nullptr : std::any_cast<BodyShapeKey>(&form->target)) {
    return shape_text(*shape);
  }
  auto* const* motion = form == nullptr ? nullptr : std::any_cast<std::shared_ptr<const MeshMotion>*>(&form->target);
  return motion == nullptr ? std::nullopt : std::optional(motion_text((*motion)->get()));
}

}  // namespace

std::vector<SceneValue> physics_of_tables(const std::vector<TableType>& tables, const std::vector<ReadEffect>& effects,
                                          const std::filesystem::path& folder) {
  std::vector<SceneValue> values;
  for (const TableType& table : tables) {
    if (!table.name.starts_with("cloth") && table.name != "time" && table.name != "integrator") continue;
    for (const Key& key : table.keys.all()) {
      // The cloth itself records its mesh and the vertices selected from it.
      if (std::holds_alternative<CustomValue>(key.target) || (table.name == "time" && key.name == "duration")) continue;
      values.push_back({table.name + "." + key.name, value_text(key.target)});
    }
  }
  const std::vector<std::string> paths = effect_paths(effects);
  for (std::size_t i = 0; i < effects.size(); ++i) {
    values.push_back({paths[i], "there"});
    Effect effect = effects[i].effect;
    Keys keys;
    effect.describe(keys);
    for (const Key& key : keys.all()) {
      const auto* form = std::get_if<CustomValue>(&key.target);
      if (form != nullptr && std::any_cast<BodyShapeKey>(&form->target) != nullptr && own_text(key)->empty()) continue;
      if (const auto text = own_text(key)) {
        values.push_back({paths[i] + "." + key.name, *text});
        continue;
      }
      const TomlTable* table = effects[i].table->as<TomlTable>();
      const TomlValue* given = table == nullptr ? nullptr : table->find(key.name);
      const std::string* file = given == nullptr ? nullptr : given->as<std::string>();
      const bool is_file = std::holds_alternative<CustomValue>(key.target) && file != nullptr;
      values.push_back({paths[i] + "." + key.name, is_file ? file_text(folder / *file) : value_text(key.target)});
    }
  }
  return values;
}

std::vector<SceneValue> physics_values(const Scene& scene) {
  const Cloth& cloth = scene.simulation.cloth;
  std::vector<SceneValue> values{
      {"cloth.mesh", fmt::format("{} vertices ({}), {} triangles ({})", cloth.vertex_count(), hash_of(cloth.positions),
                                 cloth.triangles.size(), hash_of(cloth.triangles.data(), cloth.triangles.size()))},
      {"cloth.rest", springs_text(cloth.springs)},
      {"cloth.pins", fmt::format("{} ({})", cloth.pins.size(), hash_of(cloth.pins.data(), cloth.pins.size()))}};
  values.insert(values.end(), scene.tables.begin(), scene.tables.end());
  return values;
}

std::string physics_hash(const std::vector<SceneValue>& values) {
  Hash hash;
  for (const SceneValue& value : values) hash.add(fmt::format("{}={}\n", value.key, value.text));
  return hash.text();
}

std::string physics_difference(const std::vector<SceneValue>& a, const std::vector<SceneValue>& b,
                               const std::string& name) {
  const auto text_in = [](const std::vector<SceneValue>& values, const std::string& key) {
    const auto found = std::ranges::find(values, key, &SceneValue::key);
    return found == values.end() || found->text.empty() ? std::string("nothing") : found->text;
  };
  std::string text;
  const auto add = [&](const std::string& key) {
    const std::string in_a = text_in(a, key), in_b = text_in(b, key);
    if (in_a != in_b) text += fmt::format("{}{}: {}, and {} in {}", text.empty() ? "" : "\n", key, in_a, in_b, name);
  };
  constexpr std::string_view springs = "cloth.rest";  // computed from other keys
  for (const SceneValue& value : a) {
    if (value.key != springs) add(value.key);
  }
  for (const SceneValue& value : b) {
    if (std::ranges::find(a, value.key, &SceneValue::key) == a.end()) add(value.key);
  }
  if (text.empty()) add(std::string(springs));
  return text;
}

}  // namespace drape
