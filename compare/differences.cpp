#include "compare/differences.hpp"

#include <algorithm>
#include <array>
#include <iterator>
#include <set>
#include <string_view>

namespace drape {
namespace {

constexpr std::size_t most_named = 4;  // in a label; the page lists all differences
constexpr const char *absent = "–", *present = "there";

bool counts(const std::string& key) {
  constexpr std::array<std::string_view, 5> taken_from_first{"camera.", "video.", "caption.", "overlay.", "check."};
  return key != "scene" && std::ranges::none_of(taken_from_first, [&](auto table) { return key.starts_with(table); });
}

/// Returns the effect of an effect's key: "effects.sphere"; empty for other keys.
std::string effect_of(const std::string& key) {
  return key.starts_with("effects.") ? key.substr(0, key.rfind('.')) : std::string();
}

bool has_effect(const Scene& scene, const std::string& effect) {
  return std::ranges::any_of(scene.fields, [&](const SceneField& field) { return effect_of(field.path) == effect; });
}

std::string text_of(const Scene& scene, const std::string& key) {
  const auto field = std::ranges::find(scene.fields, key, &SceneField::path);
  return field == scene.fields.end() ? absent : format_field(field->value, "");
}

bool all_same(const std::vector<std::string>& values) {
  return std::ranges::all_of(values, [&](const std::string& value) { return value == values.front(); });
}

/// Returns distinct names: the scenes' names, else their file names, else their paths; the scenes' names by default.
std::vector<std::string> names_of(const std::vector<Scene>& scenes) {
  std::vector<std::vector<std::string>> choices(3);
  for (const Scene& scene : scenes) {
    choices[0].push_back(scene.name);
    choices[1].push_back(scene.file.filename().string());
    choices[2].push_back(scene.file.string());
  }
  for (const std::vector<std::string>& names : choices) {
    if (std::set(names.begin(), names.end()).size() == names.size()) return names;
  }
  return choices[0];
}

/// Returns "method = liu13"; the value alone for a method or scheme.
std::string difference_text(const KeyDifference& difference, std::size_t scene) {
  const std::string& value = difference.values[scene];
  if (effect_of(difference.key) == "effects") {
    return (value == absent ? "no " : "") + difference.key.substr(std::string_view("effects.").size());
  }
  const std::string name = difference.key.substr(difference.key.rfind('.') + 1);
  if (name == "method" || name == "scheme") return value;
  const bool effect = difference.key.starts_with("effects.");
  return (effect ? difference.key.substr(std::string_view("effects.").size()) : name) + " = " + value;
}

}  // namespace

std::vector<KeyDifference> differences(const std::vector<Scene>& scenes) {
  // A motion from another program has no keys to compare.
  if (std::ranges::any_of(scenes, [](const Scene& scene) { return scene.fields.empty(); })) return {};
  std::vector<std::string> keys;
  for (const Scene& scene : scenes) {
    for (const SceneField& field : scene.fields) {
      // Report an effect that some scenes lack as one difference, without its keys.
      const std::string effect = effect_of(field.path);
      const bool shared =
          effect.empty() || std::ranges::all_of(scenes, [&](const Scene& other) { return has_effect(other, effect); });
      const std::string& key = shared ? field.path : effect;
      if (counts(key) && std::ranges::find(keys, key) == keys.end()) keys.push_back(key);
    }
  }
  std::vector<KeyDifference> found;
  for (const std::string& key : keys) {
    KeyDifference difference{key, {}};
    const bool is_effect = effect_of(key) == "effects";
    for (const Scene& scene : scenes) {
      difference.values.push_back(!is_effect ? text_of(scene, key) : has_effect(scene, key) ? present : absent);
    }
    if (!all_same(difference.values)) found.push_back(std::move(difference));
  }
  return found;
}

std::vector<std::string> labels(const std::vector<Scene>& scenes, const std::vector<KeyDifference>& differences) {
  std::vector<KeyDifference> told;  // without keys of the look, which is visible
  std::ranges::copy_if(differences, std::back_inserter(told),
                       [](const KeyDifference& difference) { return !difference.key.starts_with("look."); });
  std::vector<std::string> names;
  std::ranges::transform(scenes, std::back_inserter(names), &Scene::name);
  const bool named = told.empty() || !all_same(names);
  if (told.empty()) names = names_of(scenes);
  std::vector<std::string> labels;
  for (std::size_t i = 0; i < scenes.size(); ++i) {
    std::string label = named ? names[i] : "", rest;
    for (std::size_t d = 0; d < std::min(told.size(), most_named); ++d) {
      rest += (rest.empty() ? "" : ", ") + difference_text(told[d], i);
    }
    if (told.size() > most_named) rest += ", …";
    labels.push_back(label.empty() || rest.empty() ? label + rest : label + ": " + rest);
  }
  return labels;
}

}  // namespace drape
