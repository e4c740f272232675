#include "scene/values/json_schema.hpp"

#include <fmt/format.h>
#include <cmath>

#include "scene/motion_scene.hpp"
#include "scene/tables.hpp"
#include "scene/values/value_kind.hpp"

namespace drape::json_schema {
namespace {

/// Returns the meaning of a key with its unit: "Length of a time step. Unit: s."
std::string description(const Key& key) {
  return key.unit.empty() ? key.help : fmt::format("{} Unit: {}.", key.help, key.unit);
}

/// Returns a table with this key.
Json requiring(const std::string& key) { return {{"required", Json::array({key})}}; }

Json key_schema(const Key& key) {
  Json schema = kind_of(key).schema(key);
  // Draft 7 ignores all siblings of a reference.
  if (schema.contains("$ref")) {
    Json all{{"allOf", Json::array({{{"$ref", schema["$ref"]}}})}};
    if (schema.contains("default")) all["default"] = schema["default"];
    schema = std::move(all);
  }
  return described(description(key), std::move(schema));
}

}  // namespace

Json of_type(const char* type) { return {{"type", type}}; }

Json reference(const std::string& definition) { return {{"$ref", "#/definitions/" + definition}}; }

Json tuple(Json item, int count) {
  return {{"type", "array"}, {"items", std::move(item)}, {"minItems", count}, {"maxItems", count}};
}

Json list(Json item) { return {{"type", "array"}, {"items", std::move(item)}}; }

Json filled_list(Json item) {
  Json schema = list(std::move(item));
  schema["minItems"] = 1;
  return schema;
}

Json closed(Json properties, std::vector<std::string> required) {
  Json table{{"type", "object"}, {"properties", std::move(properties)}, {"additionalProperties", false}};
  if (!required.empty()) table["required"] = std::move(required);
  return table;
}

Json any_of(std::vector<Json> forms) { return {{"anyOf", std::move(forms)}}; }

Json described(const std::string& text, Json schema) {
  schema["description"] = text;
  return schema;
}

Json positive() { return {{"type", "number"}, {"exclusiveMinimum", 0}}; }

Json number_of(const Key& key, const char* type) {
  Json number = of_type(type);
  // Write whole limits as integers; editors show them without a point.
  const auto limit = [](double value) { return value == std::round(value) ? Json(std::llround(value)) : Json(value); };
  if (std::isfinite(key.minimum)) number[key.minimum_excluded ? "exclusiveMinimum" : "minimum"] = limit(key.minimum);
  if (std::isfinite(key.maximum)) number["maximum"] = limit(key.maximum);
  return number;
}

Json table(const Keys& keys) {
  Json properties = Json::object();
  std::vector<std::string> required;
  Json conditions = Json::array();
  for (const Key& key : keys.all()) {
    properties[key.name] = key_schema(key);
    if (key.required && key.alternatives.empty()) required.push_back(key.name);
    if (key.alternatives.empty()) continue;
    std::vector<Json> one{requiring(key.name)};
    for (const std::string& other : key.alternatives) one.push_back(requiring(other));
    conditions.push_back(any_of(std::move(one)));
  }
  Json schema = closed(std::move(properties), std::move(required));
  if (!conditions.empty()) schema["allOf"] = std::move(conditions);
  return schema;
}

namespace {

Json table_schema(const TableType& type) {
  Json schema = json_schema::table(type.keys);
  if (!type.help.empty()) schema["description"] = type.help;
  return schema;
}

/// Returns the schema of one table or an array of tables.
Json repeatable(const Json& table) { return any_of({table, filled_list(table)}); }

/// Returns the schema of the table for `drape sweep`.
Json sweep_schema() {
  const Json texts = any_of({of_type("string"), list(of_type("string"))});
  return described("Runs of `drape sweep`; nothing else reads them.",
                   closed({{"scenes", texts},
                           {"set", texts},
                           {"vary", described("Keys with the values that each takes.", of_type("object"))},
                           {"zip", of_type("boolean")},
                           {"film", texts},
                           {"motion", of_type("boolean")},
                           {"steps", {{"type", "integer"}, {"minimum", 0}}}}));
}

/// Adds a table's schema to the properties of its parent table.
void add_table(Json& root, const std::string& name, Json schema) {
  const std::size_t dot = name.find('.');
  if (dot == std::string::npos) {
    root["properties"][name] = std::move(schema);
  } else {
    add_table(root["properties"][name.substr(0, dot)], name.substr(dot + 1), std::move(schema));
  }
}

}  // namespace

std::string scene() {
  Json root{{"$schema", "http://json-schema.org/draft-07/schema#"},
            {"title", "A scene of drape"},
            {"description",
             "A cloth, what acts on it, how its motion is computed, and what it looks like. Lengths are "
             "in metres, masses in kilograms, times in seconds, angles in degrees; z points up."}};
  root.update(closed(Json::object()));
  root.update(any_of({requiring("cloth"), requiring("sweep")}));
  ClothTable cloth;
  SeamTable seam;
  Scene scene;
  for (const TableType& table : scene_tables(cloth, seam, scene)) add_table(root, table.name, table_schema(table));
  // Alternatives: a simulated cloth, or a motion that is read.
  NamedMotion motion;
  const TomlValue* body = nullptr;
  Json read = table_schema(named_motion_table(motion, body));
  const Json one = root["properties"]["cloth"];
  root["properties"]["cloth"] = any_of({one, filled_list(one), std::move(read)});
  root["properties"]["seam"] = repeatable(root["properties"]["seam"]);
  Json effects = Json::object();
  for (const EffectType& type : effect_types()) {
    Effect effect = type.make();
    const Json table = table_schema(effect_table(type, effect));
    effects[std::string(type.name)] = type.repeatable ? repeatable(table) : table;
  }
  root["properties"]["effects"] = described("Effects on the cloth: a table for each.", closed(effects));
  root["properties"]["sweep"] = sweep_schema();
  for (const ValueKind* kind : value_kinds()) {
    if (auto definition = kind->definition()) root["definitions"][definition->first] = std::move(definition->second);
  }
  return root.dump(1) + "\n";
}

}  // namespace drape::json_schema
