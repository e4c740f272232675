#include "scene/effects_reader.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <map>

#include "core/text.hpp"
#include "scene/table_reader.hpp"
#include "scene/tables.hpp"
#include "scene/values.hpp"
#include "sim/start_overlap.hpp"

namespace drape {
namespace {

/// Returns the tables of one effect: one, or several if it is repeatable.
std::vector<const TomlValue*> tables_of(const TomlValue& value, bool repeatable) {
  const TomlArray* array = value.as<TomlArray>();
  if (array == nullptr || !repeatable) return {&value};
  std::vector<const TomlValue*> tables;
  for (const TomlValue& item : *array) tables.push_back(&item);
  return tables;
}

/// Looks whether the cloth begins where an effect may not let it be.
void check_start(const SimulationSettings& settings, std::size_t effect, const ProblemSink& problem) {
  if (allows_overlap(settings.effects[effect])) return;
  const auto overlap = find_overlap(settings, effect, settings.cloth.positions, 0);
  if (!overlap || !overlap->contact) return;
  problem("", fmt::format("the cloth begins with {}: move one of the two, or set allow_overlap = true to have them "
                          "separated step by step",
                          describe(StartOverlap{effect, *overlap}, settings)));
}

}  // namespace

std::vector<ReadEffect> read_effects(const TomlValue& document, TableReader& reader, Problems& problems) {
  const TomlValue* value = find_path(document, "effects");
  if (value == nullptr) return {};
  const TomlTable* table = value->as<TomlTable>();
  if (table == nullptr) {
    problems.add(value->place, "effects: expected tables like [effects.gravity], found " + value->kind());
    return {};
  }
  std::vector<std::string> names;
  for (const EffectType& type : effect_types()) names.emplace_back(type.name);
  for (const TomlEntry& entry : table->entries) {
    if (std::find(names.begin(), names.end(), entry.name) == names.end()) {
      problems.add(entry.place, fmt::format("unknown effect '{}'{}", entry.name,
                                            did_you_mean(entry.name, names, "the effects are")));
    }
  }

  std::vector<ReadEffect> effects;
  for (const EffectType& type : effect_types()) {
    const TomlValue* written = table->find(type.name);
    if (written == nullptr) continue;
    for (const TomlValue* item : tables_of(*written, type.repeatable)) {
      const std::size_t before = problems.count();
      Effect effect = type.make();
      reader.read(*item, effect_table(type, effect));
      effects.push_back({std::move(effect), item, problems.count() == before});
    }
  }
  return effects;
}

std::vector<std::string> effect_paths(const std::vector<ReadEffect>& effects) {
  std::map<std::string_view, int> counts, numbers;
  for (const ReadEffect& read : effects) ++counts[read.effect.name()];
  std::vector<std::string> paths;
  for (const ReadEffect& read : effects) {
    const std::string_view name = read.effect.name();
    paths.push_back(counts[name] == 1 ? fmt::format("effects.{}", name)
                                      : fmt::format("effects.{}.{}", name, numbers[name]++));
  }
  return paths;
}

void check_effects(const std::vector<ReadEffect>& effects, const SimulationSettings& settings, Problems& problems) {
  for (std::size_t i = 0; i < effects.size(); ++i) {
    const ReadEffect& read = effects[i];
    if (!read.good) continue;
    const std::size_t before = problems.count();
    const auto add = [&](std::string_view key, const std::string& sentence) {
      problems.add(place_of(*read.table, key), key.empty()
                                                   ? fmt::format("[effects.{}]: {}", read.effect.name(), sentence)
                                                   : fmt::format("{}: {}", key, sentence));
    };
    settings.effects[i].check(settings, add);
    if (problems.count() == before) check_start(settings, i, add);
  }
}

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
  FieldValue operator()(const WarpWeft* value) const {
    if (value->isotropic()) return value->warp;
    return std::vector{value->warp, value->weft};
  }
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
