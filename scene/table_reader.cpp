#include "scene/table_reader.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <charconv>
#include <map>

#include "core/text.hpp"
#include "scene/tables.hpp"
#include "scene/values.hpp"
#include "scene/values/value_kind.hpp"
#include "sim/start_overlap.hpp"

namespace drape {
namespace {

constexpr const char* effects_table = "effects";

std::vector<std::string> key_names(const TableType& type) {
  std::vector<std::string> names;
  for (const Key& key : type.keys.all()) names.push_back(key.name);
  return names;
}

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Returns the last names of the types with tables directly within `owner`; empty means the root.
std::vector<std::string> tables_within(const std::string& owner, const std::vector<TableType>& types) {
  const std::string prefix = owner.empty() ? "" : owner + ".";
  std::vector<std::string> names;
  for (const TableType& type : types) {
    if (!type.name.starts_with(prefix)) continue;
    const std::string rest = type.name.substr(prefix.size());
    if (rest.find('.') == std::string::npos) names.push_back(rest);
  }
  return names;
}

/// Returns true if a table or the one that contains it may be written several times.
bool is_repeatable(const TableType& type, const std::vector<TableType>& types) {
  const std::string owner = type.name.substr(0, type.name.find('.'));
  return std::ranges::any_of(types, [&](const TableType& one) { return one.name == owner && one.repeatable; });
}

}  // namespace

void TableReader::read_all(const TomlValue& document, const std::vector<TableType>& types) {
  for (const TableType& type : types) {
    for (const Key& key : type.keys.all()) homes_.push_back({key.name, type.name});
  }
  std::vector<std::string> top = tables_within("", types);
  top.emplace_back(effects_table);
  for (const TomlEntry& entry : document.as<TomlTable>()->entries) {
    if (!contains(top, entry.name)) report_unknown_below_root(entry, top);
  }
  for (const TableType& type : types) {
    if (const TomlValue* value = find_path(document, type.name)) {
      if (!is_repeatable(type, types)) read(*value, type, tables_within(type.name, types));
    } else if (type.required) {
      problems_.add(document.place, fmt::format("missing table [{}]", type.name));
    }
  }
}

void TableReader::read(const TomlValue& value, const TableType& type, const std::vector<std::string>& subtables) {
  const std::size_t problems_before = problems_.count();
  if (const TomlTable* table = value.as<TomlTable>()) {
    read_entries(*table, type, subtables);
    for (const Key& key : type.keys.all()) {
      const auto given = [&](const std::string& name) { return table->find(name) != nullptr; };
      if (key.required && !given(key.name) && std::ranges::none_of(key.alternatives, given)) {
        problems_.add(value.place,
                      fmt::format("missing key {} in [{}]", quoted_or(key.name, key.alternatives), type.name));
      }
    }
  } else if (value.as<TomlArray>() != nullptr) {
    problems_.add(value.place, fmt::format("[{}] can only be given once, found an array", type.name));
  } else {
    problems_.add(value.place, fmt::format("expected a table [{}], found {}", type.name, value.kind()));
  }
  if (problems_.count() != problems_before) bad_.push_back(type.name);
}

void TableReader::read_entries(const TomlTable& table, const TableType& type,
                               const std::vector<std::string>& subtables) {
  const auto& keys = type.keys.all();
  for (const TomlEntry& entry : table.entries) {
    const auto key = std::find_if(keys.begin(), keys.end(), [&](const Key& k) { return k.name == entry.name; });
    if (key != keys.end()) {
      kind_of(*key).read({*key, entry.value, table, folder_, meshes_, problems_, files_});
    } else if (!contains(subtables, entry.name)) {
      report_unknown(entry, type, subtables);
    }
  }
}

bool TableReader::good(const std::string& table) const { return !contains(bad_, table) && !contains(bad_, ""); }

void TableReader::report_unknown(const TomlEntry& entry, const TableType& type,
                                 const std::vector<std::string>& subtables) {
  std::string message = fmt::format("unknown key '{}' in [{}]", entry.name, type.name);
  const auto& replaced_keys = type.keys.replaced();
  if (const auto replaced = replaced_keys.find(entry.name); replaced != replaced_keys.end()) {
    message = fmt::format("'{}' in [{}] no longer exists: {}", entry.name, type.name, replaced->second);
  } else if (const Home* home = home_of(entry.name)) {
    message += fmt::format("; it belongs in [{}]", home->table);
  } else {
    std::vector<std::string> names = key_names(type);
    names.insert(names.end(), subtables.begin(), subtables.end());
    message += did_you_mean(entry.name, names, "the keys are");
  }
  problems_.add(entry.place, message);
}

void TableReader::report_unknown_below_root(const TomlEntry& entry, const std::vector<std::string>& tables) {
  bad_.emplace_back();
  if (const Home* home = home_of(entry.name)) {
    problems_.add(entry.place, fmt::format("'{}' belongs in [{}]", entry.name, home->table));
  } else {
    problems_.add(entry.place,
                  fmt::format("unknown table '{}'{}", entry.name, did_you_mean(entry.name, tables, "the tables are")));
  }
}

const TableReader::Home* TableReader::home_of(const std::string& key) const {
  const auto home = std::find_if(homes_.begin(), homes_.end(), [&](const Home& h) { return h.key == key; });
  return home == homes_.end() ? nullptr : &*home;
}

Place place_of(const TomlValue& table, std::string_view key) {
  const TomlTable* entries = table.as<TomlTable>();
  const TomlValue* value = entries == nullptr ? nullptr : entries->find(key);
  return value == nullptr ? table.place : value->place;
}

const TomlValue* find_item(const TomlArray& items, std::string_view name) {
  std::size_t number = 0;
  const char* const end = name.data() + name.size();
  const auto [stop, error] = std::from_chars(name.data(), end, number);
  if (error == std::errc() && stop == end) return number < items.size() ? &items[number] : nullptr;
  const auto found = std::ranges::find_if(items, [&](const TomlValue& item) {
    const TomlTable* table = item.as<TomlTable>();
    const TomlValue* own = table == nullptr ? nullptr : table->find("name");
    const std::string* text = own == nullptr ? nullptr : own->as<std::string>();
    return text != nullptr && *text == name;
  });
  return found == items.end() ? nullptr : &*found;
}

const TomlValue* find_path(const TomlValue& document, std::string_view path) {
  const TomlValue* value = &document;
  while (value != nullptr && !path.empty()) {
    const std::size_t dot = std::min(path.find('.'), path.size());
    const TomlTable* table = value->as<TomlTable>();
    const TomlArray* items = value->as<TomlArray>();
    const std::string_view name = path.substr(0, dot);
    value = items != nullptr ? find_item(*items, name) : table == nullptr ? nullptr : table->find(name);
    path.remove_prefix(std::min(dot + 1, path.size()));
  }
  return value;
}

namespace {

/// Returns the tables of one effect: one, or several if it is repeatable.
std::vector<const TomlValue*> tables_of(const TomlValue& value, bool repeatable) {
  const TomlArray* array = value.as<TomlArray>();
  if (array == nullptr || !repeatable) return {&value};
  std::vector<const TomlValue*> tables;
  for (const TomlValue& item : *array) tables.push_back(&item);
  return tables;
}

/// Reports cloth that begins inside or across an obstacle whose effect does not allow that.
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

}  // namespace drape
