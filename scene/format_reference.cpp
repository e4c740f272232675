#include <fmt/format.h>

#include "scene/tables.hpp"
#include "scene/value_text.hpp"
#include "scene/values.hpp"

namespace drape {
namespace {

/// Name of a value's form in the reference.
struct Form {
  std::string operator()(const bool*) const { return "true or false"; }
  std::string operator()(const int*) const { return "whole number"; }
  std::string operator()(const double*) const { return "number"; }
  std::string operator()(const std::string*) const { return "string"; }
  std::string operator()(const std::filesystem::path*) const { return "file"; }
  std::string operator()(const Rgb*) const { return "colour"; }
  std::string operator()(const Choice& choice) const {
    std::string text;
    for (const std::string& name : choice.names) text += fmt::format("{}\"{}\"", text.empty() ? "" : ", ", name);
    return text;
  }
  std::string operator()(const CustomValue& own) const { return own.form; }
  std::string operator()(const KeyframeList& list) const {
    std::string form;
    for (const std::string& name : list.names) {
      form += fmt::format("{}[{{ time, {} = [x, y, z] }}, …]", form.empty() ? "" : " or ", name);
    }
    return form;
  }
  std::string operator()(const FormulaList&) const { return "[formula, formula, formula]"; }
  std::string operator()(const VertexSelection&) const { return "pins"; }
  std::string operator()(const Eigen::Vector2i*) const { return "[whole number, whole number]"; }
  std::string operator()(const Eigen::Vector3d*) const { return "[x, y, z]"; }
  std::string operator()(const std::vector<int>*) const { return "[whole number, …]"; }
  template <class T>
  std::string operator()(const std::optional<T>*) const {
    return (*this)(static_cast<const T*>(nullptr));
  }
};

/// Returns the accepted words of a key, if they are a fixed set.
std::vector<std::string> values_of(const Key::Target& target) {
  if (const auto* choice = std::get_if<Choice>(&target)) return choice->names;
  if (std::holds_alternative<bool*>(target)) return {"true", "false"};
  return {};
}

KeyText text_of(const Key& key) {
  const std::string value = std::visit(Form{}, key.target);
  const std::string range = Range{key.minimum, key.maximum, key.minimum_excluded}.text();
  return {.name = key.name,
          .form = range.empty() ? value : value + ", " + range,
          .values = values_of(key.target),
          .unit = key.unit,
          .initial = value_text(key.target),
          .help = key.help,
          .required = key.required,
          .alternatives = key.alternatives};
}

TableText text_of(const TableType& table) {
  TableText text{.name = table.name, .help = table.help, .repeatable = table.repeatable, .keys = {}};
  for (const Key& key : table.keys.all()) text.keys.push_back(text_of(key));
  return text;
}

std::string row(const KeyText& key) {
  std::string initial = key.initial.empty() ? "–" : "`" + key.initial + "`";
  if (key.required) initial = "**required**";
  for (std::size_t i = 0; i < key.alternatives.size(); ++i) {
    initial += fmt::format("{} `{}`", i == 0 ? " without" : " or", key.alternatives[i]);
  }
  return fmt::format("| `{}` | {} | {} | {} | {} |\n", key.name, key.form, key.unit, initial, key.help);
}

std::string section(const TableText& table) {
  std::string text = table.repeatable ? fmt::format("### `[{0}]` or several `[[{0}]]`\n\n", table.name)
                                      : fmt::format("### `[{}]`\n\n", table.name);
  if (!table.help.empty()) text += table.help + "\n\n";
  text += "| key | value | unit | default | meaning |\n|---|---|---|---|---|\n";
  for (const KeyText& key : table.keys) text += row(key);
  return text + "\n";
}

}  // namespace

std::vector<TableText> reference_tables() {
  ClothTable cloth;
  Scene scene;
  std::vector<TableText> tables;
  for (const TableType& table : scene_tables(cloth, scene)) tables.push_back(text_of(table));
  for (const EffectType& type : effect_types()) {
    Effect effect = type.make();
    tables.push_back(text_of(effect_table(type, effect)));
  }
  return tables;
}

std::string format_reference() {
  std::string text;
  for (const TableText& table : reference_tables()) text += section(table);
  return text;
}

}  // namespace drape
