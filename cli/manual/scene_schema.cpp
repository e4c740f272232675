#include "cli/manual/scene_schema.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <any>
#include <cmath>
#include <nlohmann/json.hpp>

#include "drape/sim/body_shape.hpp"
#include "drape/sim/effects/self_collision.hpp"
#include "scene/mesh_value.hpp"
#include "scene/motion_scene.hpp"
#include "scene/tables.hpp"
#include "scene/values.hpp"

namespace drape {
namespace {

using Json = nlohmann::ordered_json;

Json of_type(const char* type) { return {{"type", type}}; }

Json reference(const char* definition) { return {{"$ref", std::string("#/definitions/") + definition}}; }

Json tuple(Json item, int count) {
  return {{"type", "array"}, {"items", std::move(item)}, {"minItems", count}, {"maxItems", count}};
}

Json list(Json item) { return {{"type", "array"}, {"items", std::move(item)}}; }

/// Returns the schema of a table with only these keys.
Json closed(Json properties, std::vector<std::string> required = {}) {
  Json table{{"type", "object"}, {"properties", std::move(properties)}, {"additionalProperties", false}};
  if (!required.empty()) table["required"] = std::move(required);
  return table;
}

Json requiring(const std::string& key) {
  Json schema;
  schema["required"] = Json::array({key});
  return schema;
}

Json any_of(std::vector<Json> forms) { return {{"anyOf", std::move(forms)}}; }

Json number_of(const Key& key, const char* type) {
  Json number = of_type(type);
  // Write whole limits as integers; editors show them without a point.
  const auto limit = [](double value) { return value == std::round(value) ? Json(std::llround(value)) : Json(value); };
  if (std::isfinite(key.minimum)) number[key.minimum_excluded ? "exclusiveMinimum" : "minimum"] = limit(key.minimum);
  if (std::isfinite(key.maximum)) number["maximum"] = limit(key.maximum);
  return number;
}

Json json_of(const auto& value) { return value; }
Json json_of(const Rgb& color) { return color_text(color); }
Json json_of(const Eigen::Vector2i& pair) { return {pair[0], pair[1]}; }
Json json_of(const Eigen::Vector3d& vector) { return {vector[0], vector[1], vector[2]}; }

Json table_of(const Keys& keys);

/// Returns the schema of ["cloth", "cloth", { friction = number }].
Json friction_schema() {
  const Json friction{{"type", "number"}, {"minimum", 0}};
  return {
      {"type", "array"},
      {"items", Json::array({of_type("string"), of_type("string"), closed({{"friction", friction}}, {"friction"})})},
      {"minItems", 3},
      {"maxItems", 3}};
}

Json shape_schema(const BodyShapeKey& key) {
  BodyShape shape{.kind = key.kind};
  return table_of(body_shape_keys(shape));
}

/// Converter of a key's target to the schema of its value, with the default.
class ValueSchema {
 public:
  explicit ValueSchema(const Key& key) : key_(key) {}

  // A null value means no default.
  Json operator()(const bool* value) const { return with_default(of_type("boolean"), value); }
  Json operator()(const int* value) const { return with_default(number_of(key_, "integer"), value); }
  Json operator()(const double* value) const { return with_default(number_of(key_, "number"), value); }
  Json operator()(const std::string*) const { return of_type("string"); }
  Json operator()(const std::filesystem::path*) const { return of_type("string"); }
  Json operator()(const Rgb* value) const { return with_default(reference("color"), value); }
  Json operator()(const Choice& choice) const {
    Json schema = of_type("string");
    schema["enum"] = choice.names;
    if (choice.initial) schema["default"] = choice.names[*choice.initial];
    return schema;
  }
  Json operator()(const CustomValue& own) const {
    if (std::any_cast<std::shared_ptr<const MeshMotion>*>(&own.target) != nullptr) return reference("moving_mesh");
    if (std::any_cast<std::vector<PixelRectangle>*>(&own.target) != nullptr) {
      return list(tuple({{"type", "integer"}, {"minimum", 0}}, 4));
    }
    if (const auto* shape = std::any_cast<BodyShapeKey>(&own.target)) return shape_schema(*shape);
    if (std::any_cast<std::vector<ClothFriction>*>(&own.target) != nullptr) return list(friction_schema());
    if (own.form.starts_with("{ cloth")) {
      return closed({{"cloth", of_type("string")}, {"along", reference("pins")}}, {"along"});
    }
    if (own.form == "mesh" || own.form == "pins") return reference(own.form.c_str());
    if (own.form == "file") return of_type("string");
    const Json positive{{"type", "number"}, {"exclusiveMinimum", 0}};  // a number or a vector
    return any_of({positive, tuple(positive, 3)});
  }
  Json operator()(const KeyframeList& keyframes) const {
    std::vector<Json> forms;  // each form has one name throughout
    for (const std::string& name : keyframes.names) {
      const Json time{{"type", "number"}, {"minimum", 0}};
      Json form = list(closed({{"time", time}, {name, tuple(of_type("number"), 3)}}, {"time", name}));
      form["minItems"] = 1;
      forms.push_back(std::move(form));
    }
    return forms.size() == 1 ? forms.front() : any_of(std::move(forms));
  }
  Json operator()(const VertexSelection&) const { return reference("pins"); }
  Json operator()(const FormulaList&) const { return tuple({{"type", {"string", "number"}}}, 3); }
  Json operator()(const Eigen::Vector2i* value) const {
    return with_default(tuple(number_of(key_, "integer"), 2), value);
  }
  Json operator()(const Eigen::Vector3d* value) const {
    return with_default(tuple(number_of(key_, "number"), 3), value);
  }
  Json operator()(const WarpWeft*) const {
    const Json number = number_of(key_, "number");
    return any_of({number, tuple(number, 2)});
  }
  Json operator()(const std::vector<int>*) const { return list(number_of(key_, "integer")); }
  template <class T>
  Json operator()(const std::optional<T>* value) const {
    return (*this)(*value ? &**value : static_cast<const T*>(nullptr));
  }

 private:
  template <class T>
  static Json with_default(Json schema, const T* value) {
    if (value != nullptr) schema["default"] = json_of(*value);
    return schema;
  }

  const Key& key_;
};

/// Returns the meaning of a key with its unit: "Length of a time step. Unit: s".
std::string description(const Key& key) {
  return key.unit.empty() ? key.help : fmt::format("{} Unit: {}.", key.help, key.unit);
}

Json key_schema(const Key& key) {
  Json schema = std::visit(ValueSchema(key), key.target);
  // Draft 7 ignores all siblings of a reference.
  if (schema.contains("$ref")) {
    Json all{{"allOf", Json::array({{{"$ref", schema["$ref"]}}})}};
    if (schema.contains("default")) all["default"] = schema["default"];
    schema = std::move(all);
  }
  schema["description"] = description(key);
  return schema;
}

Json table_of(const Keys& keys) {
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

Json table_schema(const TableType& table) {
  Json schema = table_of(table.keys);
  if (!table.help.empty()) schema["description"] = table.help;
  return schema;
}

/// Returns the schema of one table or an array of tables.
Json repeatable(const Json& table) {
  Json several = list(table);
  several["minItems"] = 1;
  return any_of({table, std::move(several)});
}

Json text_and(const char* help, Json schema) {
  schema["description"] = help;
  return schema;
}

Json mesh_schema() {
  const Json cells = tuple({{"type", "integer"}, {"minimum", 1}}, 2), text = of_type("string");
  const Json up{{"enum", {"y", "z"}}};
  std::vector<Json> forms{text, closed({{"file", text}, {"prim", text}, {"up", up}}, {"file"}),
                          closed({{"grid", text_and("Columns and rows of cells.", cells)},
                                  {"pattern", {{"enum", {"diagonal", "alternating", "x", "equilateral"}}}},
                                  {"size", tuple({{"type", "number"}, {"exclusiveMinimum", 0}}, 2)}},
                                 {"grid"})};
  for (std::size_t i = 0; i < mesh_shape_names().size(); ++i) {
    ParametricMesh shape{.kind = static_cast<ParametricMesh::Kind>(i)};
    forms.push_back(closed({{mesh_shape_names()[i], table_of(mesh_shape_keys(shape))}}, {mesh_shape_names()[i]}));
  }
  return text_and("A mesh file (OBJ or ASCII USD), or a shape.", any_of(std::move(forms)));
}

Json moving_mesh_schema() {
  const Json text = of_type("string"), up{{"enum", {"y", "z"}}}, fps{{"type", "number"}, {"exclusiveMinimum", 0}};
  return any_of({text, closed({{"file", text}, {"prim", text}, {"up", up}, {"fps", fps}}, {"file"})});
}

Json pins_schema() {
  const Json point = tuple(of_type("number"), 3), positive{{"type", "number"}, {"exclusiveMinimum", 0}};
  const Json ball = closed({{"center", point}, {"radius", positive}}, {"center", "radius"});
  const Json circle = closed({{"center", point}, {"radius", positive}, {"width", positive}, {"normal", point}},
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
  return list(any_of(std::move(items)));
}

Json color_schema() {
  return any_of({{{"type", "string"}, {"enum", std::vector<std::string>(color_names().begin(), color_names().end())}},
                 {{"type", "string"}, {"pattern", "^#([0-9a-fA-F]{3}|[0-9a-fA-F]{6})$"}}});
}

/// Returns the schema of the table for `drape sweep`.
Json sweep_schema() {
  const Json texts = any_of({of_type("string"), list(of_type("string"))});
  return text_and("Runs of `drape sweep`; nothing else reads them.",
                  closed({{"scenes", texts},
                          {"set", texts},
                          {"vary", text_and("Keys with the values that each takes.", of_type("object"))},
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

std::string scene_schema() {
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
  read["properties"]["body"] =
      text_and("Obstacles, in the same formats.", any_of({of_type("string"), list(of_type("string"))}));
  const Json one = root["properties"]["cloth"];
  Json several = list(one);
  several["minItems"] = 1;
  root["properties"]["cloth"] = any_of({one, std::move(several), std::move(read)});
  root["properties"]["seam"] = repeatable(root["properties"]["seam"]);
  Json effects = Json::object();
  for (const EffectType& type : effect_types()) {
    Effect effect = type.make();
    const Json table = table_schema(effect_table(type, effect));
    effects[std::string(type.name)] = type.repeatable ? repeatable(table) : table;
  }
  root["properties"]["effects"] = text_and("Effects on the cloth: a table for each.", closed(effects));
  root["properties"]["sweep"] = sweep_schema();
  root["definitions"] = {{"mesh", mesh_schema()},
                         {"moving_mesh", moving_mesh_schema()},
                         {"pins", pins_schema()},
                         {"color", color_schema()}};
  return root.dump(1) + "\n";
}

}  // namespace drape
