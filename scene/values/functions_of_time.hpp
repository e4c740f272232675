#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <vector>

#include "core/text.hpp"
#include "scene/values/json_schema.hpp"
#include "scene/values/plain.hpp"
#include "scene/values/value_kind.hpp"

namespace drape {

/// Three formulas; a number is one, too.
class FormulasKind final : public DescribedKind<FormulaList> {
  void read(const GivenValue& given) const override {
    const TomlArray* array = read_array(given.value, given.key.name, 3, "formulas", given.problems);
    if (array == nullptr) return;
    std::array<std::string, 3> formulas;
    const std::size_t before = given.problems.count();
    for (std::size_t i = 0; i < 3; ++i) {
      formulas[i] = read_formula((*array)[i], item_name(given.key.name, i), target(given.key), given.problems);
    }
    if (given.problems.count() == before) *target(given.key).formulas = formulas;
  }
  std::string text(const Key& key) const override {
    return fmt::format("[\"{}\"]", fmt::join(*target(key).formulas, "\", \""));
  }
  std::string form(const Key&) const override { return "[formula, formula, formula]"; }
  Json schema(const Key&) const override { return json_schema::tuple({{"type", {"string", "number"}}}, 3); }

  static std::string read_formula(const TomlValue& item, const std::string& name, const FormulaList& list,
                                  Problems& problems) {
    if (item.as<std::int64_t>() != nullptr || item.as<double>() != nullptr) {
      return fmt::format("{}", read_number(item, name, {}, problems).value_or(0));
    }
    const std::string* formula = item.as<std::string>();
    if (formula == nullptr) {
      problems.add(item.place, fmt::format("{}: expected a formula or a number, found {}", name, item.kind()));
      return "";
    }
    if (const auto problem = list.problem(*formula)) {
      problems.add(item.place, fmt::format("{}: '{}': {}", name, *formula, *problem));
    }
    return *formula;
  }
};

/// A list of { time, NAME = [x, y, z] } at increasing times.
class KeyframesKind final : public DescribedKind<KeyframeList> {
  void read(const GivenValue& given) const override {
    const KeyframeList& list = target(given.key);
    const TomlArray* array = given.value.as<TomlArray>();
    if (array == nullptr || array->empty()) {
      given.report(fmt::format("expected an array of {{ time = …, {} = [x, y, z] }}, found {}", list.names.front(),
                               array == nullptr ? given.value.kind() : "an empty one"));
      return;
    }
    list.keyframes->clear();
    std::optional<std::size_t> used;
    bool good = true;
    for (std::size_t i = 0; i < array->size(); ++i) {
      good = read_keyframe((*array)[i], item_name(given.key.name, i), list, used, given.problems) && good;
    }
    if (!good) return;
    if (list.set_name) list.set_name(*used);
    for (const Keyframe& keyframe : *list.keyframes) {
      if (out_of_reach(given, keyframe.value.cwiseAbs().maxCoeff())) return;
    }
  }
  std::string text(const Key& key) const override {
    const KeyframeList& list = target(key);
    std::string text;
    for (const auto& [time, value] : *list.keyframes) {
      text += fmt::format("{}{{ time = {}, {} = [{}, {}, {}] }}", text.empty() ? "[" : ", ", time,
                          list.names[list.name], value[0], value[1], value[2]);
    }
    return text.empty() ? "" : text + "]";
  }
  std::string form(const Key& key) const override {
    std::string form;
    for (const std::string& name : target(key).names) {
      form += fmt::format("{}[{{ time, {} = [x, y, z] }}, …]", form.empty() ? "" : " or ", name);
    }
    return form;
  }
  Json schema(const Key& key) const override {
    std::vector<Json> forms;  // each form has one name throughout
    for (const std::string& name : target(key).names) {
      const Json time{{"type", "number"}, {"minimum", 0}};
      forms.push_back(json_schema::filled_list(json_schema::closed(
          {{"time", time}, {name, json_schema::tuple(json_schema::of_type("number"), 3)}}, {"time", name})));
    }
    return forms.size() == 1 ? forms.front() : json_schema::any_of(std::move(forms));
  }

  /// Reads one keyframe into `list`; returns false if it is not one. `used` is the name of the values, once known.
  static bool read_keyframe(const TomlValue& value, const std::string& name, const KeyframeList& list,
                            std::optional<std::size_t>& used, Problems& problems) {
    const TomlTable* table = value.as<TomlTable>();
    if (table == nullptr) {
      problems.add(value.place, fmt::format("{}: expected {{ time = …, {} = [x, y, z] }}, found {}", name,
                                            list.names.front(), value.kind()));
      return false;
    }
    const std::size_t before = problems.count();
    std::vector<std::string> known = list.names;
    known.insert(known.begin(), "time");
    const TomlValue* vector = nullptr;
    for (const TomlEntry& entry : table->entries) {
      const auto place = static_cast<std::size_t>(std::ranges::find(known, entry.name) - known.begin());
      if (place == known.size()) {
        problems.add(entry.place, fmt::format("{}: unknown key '{}'{}", name, entry.name,
                                              did_you_mean(entry.name, known, "the keys are")));
      } else if (place > 0 && used.value_or(place - 1) != place - 1) {
        problems.add(entry.place,
                     fmt::format("{}: every keyframe of a list has the same key, and before this one it was "
                                 "'{}'",
                                 name, list.names[*used]));
      } else if (place > 0) {
        used = place - 1;
        vector = &entry.value;
      }
    }
    const TomlValue* time = table->find("time");
    const std::string missing = time == nullptr     ? "time"
                                : vector == nullptr ? fmt::format("{}", fmt::join(list.names, "' or '"))
                                                    : "";
    if (problems.count() == before && !missing.empty()) {
      problems.add(value.place, fmt::format("{}: missing key '{}'", name, missing));
    }
    if (problems.count() != before) return false;
    const auto at = read_number(*time, name + ".time", {.minimum = 0}, problems);
    const auto where = read_vector(*vector, name + "." + list.names[*used], {}, problems);
    if (!at || !where) return false;
    if (!list.keyframes->empty() && *at <= list.keyframes->back().time) {
      problems.add(time->place,
                   fmt::format("{}.time: keyframes must follow each other in time, and the one before is at "
                               "{:g} s, found {:g}",
                               name, list.keyframes->back().time, *at));
      return false;
    }
    list.keyframes->push_back({*at, *where});
    return true;
  }
};

}  // namespace drape
