#include "tests/support/effects.hpp"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <type_traits>

namespace drape::test {
namespace {

[[noreturn]] void refuse(std::string_view effect, std::string_view key, const std::string& why) {
  throw std::invalid_argument("effect '" + std::string(effect) + "', key '" + std::string(key) + "': " + why);
}

/// Writes a value to a key's target; false if the key does not take such a value.
bool assign(const Key::Target& target, const KeyValue& value) {
  if (const auto* choice = std::get_if<Choice>(&target)) {
    const auto* name = std::get_if<std::string>(&value);
    const auto place = name == nullptr ? choice->names.end() : std::ranges::find(choice->names, *name);
    if (place == choice->names.end()) return false;
    choice->set(static_cast<std::size_t>(place - choice->names.begin()));
    return true;
  }
  if (const auto* list = std::get_if<KeyframeList>(&target)) {
    const auto* given = std::get_if<KeyframesValue>(&value);
    const auto name = given == nullptr ? list->names.end() : std::ranges::find(list->names, given->name);
    if (name == list->names.end()) return false;
    *list->keyframes = given->keyframes;
    if (list->name != nullptr) *list->name = static_cast<std::size_t>(name - list->names.begin());
    return true;
  }
  if (const auto* selection = std::get_if<VertexSelection>(&target)) {
    const auto* given = std::get_if<std::vector<int>>(&value);
    if (given != nullptr) *selection->vertices = *given;
    return given != nullptr;
  }
  return std::visit(
      [&](const auto& given) {
        using Value = std::decay_t<decltype(given)>;
        if constexpr (std::is_same_v<Value, KeyframesValue> || std::is_same_v<Value, std::vector<int>>) {
          return false;
        } else {
          if (const auto* plain = std::get_if<Value*>(&target)) {
            **plain = given;
            return true;
          }
          if constexpr (std::is_arithmetic_v<Value> || std::is_same_v<Value, Eigen::Vector3d>) {
            if constexpr (!std::is_same_v<Value, bool>) {
              if (const auto* optional = std::get_if<std::optional<Value>*>(&target)) {
                **optional = given;
                return true;
              }
            }
          }
          return false;
        }
      },
      value);
}

}  // namespace

ActiveEffect effect(std::string_view name, const KeyValues& values) {
  const auto types = effect_types();
  const auto type = std::ranges::find(types, name, &EffectType::name);
  if (type == types.end()) throw std::invalid_argument("no effect is called '" + std::string(name) + "'");
  std::shared_ptr<Effect> made = type->make();
  Keys keys;
  made->describe(keys);
  for (const auto& [key_name, value] : values) {
    const auto key = std::ranges::find(keys.all(), key_name, &Key::name);
    if (key == keys.all().end()) refuse(name, key_name, "no such key");
    if (!assign(key->target, value)) refuse(name, key_name, "takes another type of value");
  }
  for (const Key& key : keys.all()) {
    const auto given = [&](const std::string& wanted) {
      return std::ranges::any_of(values, [&](const auto& value) { return value.first == wanted; });
    };
    if (key.required && !given(key.name) && std::ranges::none_of(key.alternatives, given)) {
      refuse(name, key.name, "must be given");
    }
  }
  return {std::string(name), std::move(made)};
}

std::vector<std::string> problems(const ActiveEffect& active, const SimulationSettings& settings) {
  std::vector<std::string> found;
  active.effect->check(settings, [&](std::string_view key, const std::string& sentence) {
    found.push_back(std::string(key) + ": " + sentence);
  });
  return found;
}

}  // namespace drape::test
