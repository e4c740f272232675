#include "scene/fields.hpp"

#include <fmt/format.h>

#include "scene/color.hpp"
#include "scene/effects_reader.hpp"
#include "scene/table_reader.hpp"
#include "scene/tables.hpp"

namespace drape {
namespace {

/// Text of a key without a value: the scene chooses.
constexpr const char* left_open = "default";

std::vector<double> numbers_of(const auto& values) { return {values.begin(), values.end()}; }

struct ValueOfTarget {
  const TomlValue* written;

  FieldValue operator()(const bool* value) const { return std::string(*value ? "true" : "false"); }
  FieldValue operator()(const int* value) const { return std::int64_t{*value}; }
  FieldValue operator()(const double* value) const { return *value; }
  FieldValue operator()(const std::string* value) const { return *value; }
  FieldValue operator()(const std::filesystem::path* value) const {
    return value->empty() ? "none" : value->filename().string();
  }
  FieldValue operator()(const Rgb* value) const { return color_text(*value); }
  FieldValue operator()(const Choice& choice) const {
    return choice.initial ? choice.names[*choice.initial] : left_open;
  }
  FieldValue operator()(const CustomValue&) const { return as_written(); }
  FieldValue operator()(const KeyframeList&) const { return as_written(); }
  FieldValue operator()(const VertexSelection&) const { return as_written(); }
  FieldValue operator()(const FormulaList&) const { return as_written(); }
  FieldValue operator()(const Eigen::Vector2i* value) const { return numbers_of(*value); }
  FieldValue operator()(const Eigen::Vector3d* value) const { return numbers_of(*value); }
  FieldValue operator()(const std::vector<int>* value) const { return numbers_of(*value); }
  template <class T>
  FieldValue operator()(const std::optional<T>* value) const {
    return *value ? (*this)(&**value) : left_open;
  }

 private:
  [[nodiscard]] FieldValue as_written() const { return written == nullptr ? "none" : toml_text(*written); }
};

const TomlValue* entry_of(const TomlValue* table, const std::string& key) {
  const TomlTable* entries = table == nullptr ? nullptr : table->as<TomlTable>();
  return entries == nullptr ? nullptr : entries->find(key);
}

}  // namespace

std::string toml_text(const TomlValue& value) {
  if (const auto* text = value.as<std::string>()) return *text;
  if (const auto* flag = value.as<bool>()) return *flag ? "true" : "false";
  if (const auto* whole = value.as<std::int64_t>()) return fmt::format("{}", *whole);
  if (const auto* number = value.as<double>()) return fmt::format("{}", *number);
  std::string text;
  if (const auto* array = value.as<TomlArray>()) {
    for (const TomlValue& item : *array) text += (text.empty() ? "" : ", ") + toml_text(item);
    return "[" + text + "]";
  }
  if (const auto* table = value.as<TomlTable>()) {
    for (const TomlEntry& entry : table->entries) {
      text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", entry.name, toml_text(entry.value));
    }
  }
  return "{ " + text + " }";
}

FieldValue field_value(const Key& key, const TomlValue* written) {
  return std::visit(ValueOfTarget{written}, key.target);
}

std::vector<SceneField> scene_fields(const std::string& name, const std::vector<TableType>& tables,
                                     const std::vector<ReadEffect>& effects, const TomlValue& document) {
  std::vector<SceneField> fields{{"scene", name}};
  for (const TableType& table : tables) {
    const TomlValue* written = find_path(document, table.name);
    for (const Key& key : table.keys.all()) {
      fields.push_back({table.name + "." + key.name, field_value(key, entry_of(written, key.name))});
    }
  }
  const std::vector<std::string> paths = effect_paths(effects);
  for (std::size_t i = 0; i < effects.size(); ++i) {
    Effect effect = effects[i].effect;
    Keys keys;
    effect.describe(keys);
    for (const Key& key : keys.all()) {
      fields.push_back({paths[i] + "." + key.name, field_value(key, entry_of(effects[i].table, key.name))});
    }
  }
  return fields;
}

}  // namespace drape
