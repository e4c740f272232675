#include "scene/effects_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "core/nearest.hpp"
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

}  // namespace drape
