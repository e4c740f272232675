#include <fmt/format.h>

#include "scene/color.hpp"
#include "scene/tables.hpp"
#include "scene/values.hpp"

namespace drape {
namespace {

/// What a page says about a key's value.
struct ValueText {
  std::string form;     ///< "number"
  std::string initial;  ///< what holds without the key
};

std::string vector_text(const Eigen::Vector3d& v) { return fmt::format("[{}, {}, {}]", v[0], v[1], v[2]); }

std::string choices(const Choice& choice) {
  std::string text;
  for (const std::string& name : choice.names) text += fmt::format("{}\"{}\"", text.empty() ? "" : ", ", name);
  return text;
}

struct Describe {
  ValueText operator()(const bool* value) const { return {"true or false", *value ? "true" : "false"}; }
  ValueText operator()(const int* value) const { return {"whole number", fmt::format("{}", *value)}; }
  ValueText operator()(const double* value) const { return {"number", fmt::format("{}", *value)}; }
  ValueText operator()(const std::string* value) const { return {"string", fmt::format("\"{}\"", *value)}; }
  ValueText operator()(const std::filesystem::path*) const { return {"file", ""}; }
  ValueText operator()(const Rgb* value) const { return {"colour", fmt::format("\"{}\"", color_text(*value))}; }
  ValueText operator()(const Choice& choice) const {
    return {choices(choice), choice.initial ? fmt::format("\"{}\"", choice.names[*choice.initial]) : ""};
  }
  ValueText operator()(const OwnForm& own) const { return {own.form, ""}; }
  ValueText operator()(const KeyframeList& list) const {
    std::string form;
    for (const std::string& name : list.names) {
      form += fmt::format("{}[{{ time, {} = [x, y, z] }}, …]", form.empty() ? "" : " or ", name);
    }
    return {form, ""};
  }
  ValueText operator()(const FormulaList&) const { return {"[formula, formula, formula]", ""}; }
  ValueText operator()(const VertexSelection&) const { return {"pins", ""}; }
  ValueText operator()(const Eigen::Vector2i* value) const {
    return {"[whole number, whole number]", fmt::format("[{}, {}]", (*value)[0], (*value)[1])};
  }
  ValueText operator()(const Eigen::Vector3d* value) const { return {"[x, y, z]", vector_text(*value)}; }
  ValueText operator()(const std::vector<int>*) const { return {"[whole number, …]", ""}; }
  ValueText operator()(const std::optional<Eigen::Vector2i>*) const { return {"[whole number, whole number]", ""}; }
  ValueText operator()(const std::optional<int>*) const { return {"whole number", ""}; }
  ValueText operator()(const std::optional<double>* value) const {
    return {"number", *value ? fmt::format("{}", **value) : ""};
  }
  ValueText operator()(const std::optional<Rgb>*) const { return {"colour", ""}; }
  ValueText operator()(const std::optional<Eigen::Vector3d>*) const { return {"[x, y, z]", ""}; }
};

std::string row(const Key& key) {
  const ValueText text = std::visit(Describe{}, key.target);
  const std::string range = Range{key.minimum, key.maximum, key.minimum_excluded}.text();
  const std::string form = range.empty() ? text.form : text.form + ", " + range;
  std::string initial = text.initial.empty() ? "–" : "`" + text.initial + "`";
  if (key.required) initial = "**required**";
  for (std::size_t i = 0; i < key.alternatives.size(); ++i) {
    initial += fmt::format("{} `{}`", i == 0 ? " without" : " or", key.alternatives[i]);
  }
  return fmt::format("| `{}` | {} | {} | {} | {} |\n", key.name, form, key.unit, initial, key.help);
}

std::string section(const TableType& table) {
  std::string text = table.repeatable ? fmt::format("### `[{0}]` or several `[[{0}]]`\n\n", table.name)
                                      : fmt::format("### `[{}]`\n\n", table.name);
  if (!table.help.empty()) text += table.help + "\n\n";
  text += "| key | value | unit | default | meaning |\n|---|---|---|---|---|\n";
  for (const Key& key : table.keys.all()) text += row(key);
  return text + "\n";
}

}  // namespace

std::string format_reference() {
  ClothTable cloth;
  Scene scene;
  std::string text;
  for (const TableType& table : scene_tables(cloth, scene)) text += section(table);
  for (const EffectType& type : effect_types()) {
    Effect effect = type.make();
    text += section(effect_table(type, effect));
  }
  return text;
}

}  // namespace drape
