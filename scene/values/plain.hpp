#pragma once

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <type_traits>
#include <vector>

#include "core/text.hpp"
#include "drape/core/rgb.hpp"
#include "drape/core/warp_weft.hpp"
#include "scene/values/json_schema.hpp"
#include "scene/values/value_kind.hpp"

namespace drape {

/// Returns true if a value is a place or a velocity so large that products of it overflow, and reports that.
inline bool out_of_reach(const GivenValue& given, double magnitude) {
  const std::string& unit = given.key.unit;
  if ((unit != "m" && unit != "m/s" && unit != "s, m") || magnitude <= furthest_place) return false;
  given.report(fmt::format("found {:g}; beyond {:g} {} it overflows double precision", magnitude, furthest_place,
                           unit == "m/s" ? "m/s" : "m"));
  return true;
}

/// Returns a schema with a default, unless the value is null.
template <class T>
nlohmann::ordered_json with_default(nlohmann::ordered_json schema, const T* value) {
  if (value == nullptr) return schema;
  if constexpr (std::is_arithmetic_v<T>) {
    schema["default"] = *value;
  } else {
    schema["default"] = std::vector(value->begin(), value->end());
  }
  return schema;
}

class FlagKind final : public PlainKind<bool> {
  std::optional<bool> parse(const GivenValue& given) const override {
    return read_bool(given.value, given.key.name, given.problems);
  }
  std::string text_of(const bool& value) const override { return value ? "true" : "false"; }
  FieldValue field_of(const bool& value) const override { return text_of(value); }
  std::string form(const Key&) const override { return "true or false"; }
  std::vector<std::string> words(const Key&) const override { return {"true", "false"}; }
  Json schema(const Key& key) const override { return with_default(json_schema::of_type("boolean"), value_of(key)); }
};

class WholeNumberKind final : public PlainKind<int> {
  std::optional<int> parse(const GivenValue& given) const override {
    return read_int(given.value, given.key.name, given.range(), given.problems);
  }
  std::string text_of(const int& value) const override { return fmt::format("{}", value); }
  FieldValue field_of(const int& value) const override { return std::int64_t{value}; }
  std::string form(const Key&) const override { return "whole number"; }
  Json schema(const Key& key) const override {
    return with_default(json_schema::number_of(key, "integer"), value_of(key));
  }
};

class NumberKind final : public PlainKind<double> {
  std::optional<double> parse(const GivenValue& given) const override {
    const auto number = read_number(given.value, given.key.name, given.range(), given.problems);
    return number && out_of_reach(given, std::abs(*number)) ? std::nullopt : number;
  }
  std::string text_of(const double& value) const override { return fmt::format("{}", value); }
  FieldValue field_of(const double& value) const override { return value; }
  std::string form(const Key&) const override { return "number"; }
  Json schema(const Key& key) const override {
    return with_default(json_schema::number_of(key, "number"), value_of(key));
  }
};

/// Several numbers.
template <class T>
class NumbersKind : public PlainKind<T> {
  std::string text_of(const T& value) const final {
    return value.size() == 0 ? "" : fmt::format("[{}]", fmt::join(value.begin(), value.end(), ", "));
  }
  FieldValue field_of(const T& value) const final { return std::vector<double>(value.begin(), value.end()); }
};

class WholePairKind final : public NumbersKind<Eigen::Vector2i> {
  std::optional<Eigen::Vector2i> parse(const GivenValue& given) const override {
    return read_int_pair(given.value, given.key.name, given.range(), given.problems);
  }
  std::string form(const Key&) const override { return "[whole number, whole number]"; }
  Json schema(const Key& key) const override {
    return with_default(json_schema::tuple(json_schema::number_of(key, "integer"), 2), value_of(key));
  }
};

class VectorKind final : public NumbersKind<Eigen::Vector3d> {
  std::optional<Eigen::Vector3d> parse(const GivenValue& given) const override {
    const auto vector = read_vector(given.value, given.key.name, given.range(), given.problems);
    return vector && out_of_reach(given, vector->cwiseAbs().maxCoeff()) ? std::nullopt : vector;
  }
  std::string form(const Key&) const override { return "[x, y, z]"; }
  Json schema(const Key& key) const override {
    return with_default(json_schema::tuple(json_schema::number_of(key, "number"), 3), value_of(key));
  }
};

class WholeNumbersKind final : public NumbersKind<std::vector<int>> {
  std::optional<std::vector<int>> parse(const GivenValue& given) const override {
    return read_ints(given.value, given.key.name, given.range(), given.problems);
  }
  std::string form(const Key&) const override { return "[whole number, …]"; }
  Json schema(const Key& key) const override { return json_schema::list(json_schema::number_of(key, "integer")); }
};

/// One number, or two for warp and weft.
class WarpWeftKind final : public PlainKind<WarpWeft> {
  std::optional<WarpWeft> parse(const GivenValue& given) const override {
    if (given.value.as<TomlArray>() == nullptr) {
      return read_number(given.value, given.key.name, given.range(), given.problems);
    }
    const auto both = read_pair(given.value, given.key.name, given.range(), given.problems);
    return both ? std::optional(WarpWeft((*both)[0], (*both)[1])) : std::nullopt;
  }
  std::string text_of(const WarpWeft& value) const override {
    return value.isotropic() ? fmt::format("{}", value.warp) : fmt::format("[{}, {}]", value.warp, value.weft);
  }
  FieldValue field_of(const WarpWeft& value) const override {
    if (value.isotropic()) return value.warp;
    return std::vector{value.warp, value.weft};
  }
  std::string form(const Key&) const override { return "number or [warp, weft]"; }
  Json schema(const Key& key) const override {
    const Json number = json_schema::number_of(key, "number");
    return json_schema::any_of({number, json_schema::tuple(number, 2)});
  }
};

class StringKind final : public PlainKind<std::string> {
  std::optional<std::string> parse(const GivenValue& given) const override {
    return read_string(given.value, given.key.name, given.problems);
  }
  std::string text_of(const std::string& value) const override { return fmt::format("\"{}\"", value); }
  FieldValue field_of(const std::string& value) const override { return value; }
  std::string form(const Key&) const override { return "string"; }
  Json schema(const Key&) const override { return json_schema::of_type("string"); }
};

/// The name of a file, relative to the scene's folder or textures/.
class FileNameKind final : public PlainKind<std::filesystem::path> {
  std::optional<std::filesystem::path> parse(const GivenValue& given) const override {
    auto file = read_file_name(given.value, given.key.name, given.folder, given.problems);
    if (file && !file->empty()) given.files.push_back(*file);
    return file;
  }
  std::string text_of(const std::filesystem::path& value) const override { return value.string(); }
  FieldValue field_of(const std::filesystem::path& value) const override {
    return value.empty() ? "none" : value.filename().string();
  }
  std::string form(const Key&) const override { return "file"; }
  Json schema(const Key&) const override { return json_schema::of_type("string"); }
};

class ColourKind final : public PlainKind<Rgb> {
  std::optional<Rgb> parse(const GivenValue& given) const override {
    const std::string& name = given.key.name;
    const std::optional<std::string> text = read_string(given.value, name, given.problems);
    if (!text) return std::nullopt;
    const std::optional<Rgb> color = parse_color(*text);
    if (color) return color;
    given.report(text->starts_with('#')
                     ? fmt::format("expected a colour like '#d4a017' or '#fff', found '{}'", *text)
                     : fmt::format("unknown colour '{}'{}", *text,
                                   did_you_mean(*text, color_names(), "write it as '#rrggbb' or one of")));
    return std::nullopt;
  }
  std::string text_of(const Rgb& value) const override { return '"' + color_text(value) + '"'; }
  FieldValue field_of(const Rgb& value) const override { return color_text(value); }
  std::string form(const Key&) const override { return "colour"; }
  Json schema(const Key& key) const override {
    Json schema = json_schema::reference("color");
    if (const Rgb* value = value_of(key)) schema["default"] = color_text(*value);
    return schema;
  }
  std::optional<std::pair<std::string, Json>> definition() const override {
    const std::vector<std::string> names(color_names().begin(), color_names().end());
    return std::pair("color",
                     json_schema::any_of({{{"type", "string"}, {"enum", names}},
                                          {{"type", "string"}, {"pattern", "^#([0-9a-fA-F]{3}|[0-9a-fA-F]{6})$"}}}));
  }
};

class ChoiceKind final : public DescribedKind<Choice> {
  void read(const GivenValue& given) const override {
    const std::vector<std::string>& names = target(given.key).names;
    const std::optional<std::string> name = read_string(given.value, given.key.name, given.problems);
    if (!name) return;
    const auto found = std::ranges::find(names, *name);
    if (found != names.end()) return target(given.key).set(static_cast<std::size_t>(found - names.begin()));
    given.problems.add(given.value.place, fmt::format("unknown {} '{}'{}", given.key.name, *name,
                                                      did_you_mean(*name, names, "the choices are")));
  }
  std::string text(const Key& key) const override {
    const Choice& choice = target(key);
    return choice.initial ? fmt::format("\"{}\"", choice.names[*choice.initial]) : "";
  }
  FieldValue field(const Key& key, const TomlValue*) const override {
    const Choice& choice = target(key);
    return choice.initial ? choice.names[*choice.initial] : "default";
  }
  std::string form(const Key& key) const override {
    std::string text;
    for (const std::string& name : target(key).names) text += fmt::format("{}\"{}\"", text.empty() ? "" : ", ", name);
    return text;
  }
  std::vector<std::string> words(const Key& key) const override { return target(key).names; }
  Json schema(const Key& key) const override {
    const Choice& choice = target(key);
    Json schema = json_schema::of_type("string");
    schema["enum"] = choice.names;
    if (choice.initial) schema["default"] = choice.names[*choice.initial];
    return schema;
  }
};

/// The name of a cloth. A motion's hash omits it where the effect acts on all cloths.
class ClothNameKind final : public DescribedKind<ClothName> {
  void read(const GivenValue& given) const override {
    if (auto name = read_string(given.value, given.key.name, given.problems)) *target(given.key).name = *name;
  }
  std::string text(const Key& key) const override { return '"' + *target(key).name + '"'; }
  std::optional<std::string> hashed_text(const Key& key, const TomlValue*, const Path&) const override {
    return target(key).name->empty() ? std::nullopt : std::optional(text(key));
  }
  FieldValue field(const Key& key, const TomlValue*) const override { return *target(key).name; }
  std::string form(const Key&) const override { return "string"; }
  Json schema(const Key&) const override { return json_schema::of_type("string"); }
};

}  // namespace drape
