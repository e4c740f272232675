#include "scene/value_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "scene/color.hpp"

namespace drape {
namespace {

struct WriteValue {
  std::string operator()(const bool* value) const { return *value ? "true" : "false"; }
  std::string operator()(const int* value) const { return fmt::format("{}", *value); }
  std::string operator()(const double* value) const { return fmt::format("{}", *value); }
  std::string operator()(const std::string* value) const { return fmt::format("\"{}\"", *value); }
  std::string operator()(const std::filesystem::path* value) const { return value->string(); }
  std::string operator()(const Rgb* value) const { return fmt::format("\"{}\"", color_text(*value)); }
  std::string operator()(const Choice& choice) const {
    return choice.initial ? fmt::format("\"{}\"", choice.names[*choice.initial]) : "";
  }
  std::string operator()(const OwnForm&) const { return ""; }
  std::string operator()(const KeyframeList& list) const {
    std::string text;
    for (const Keyframe& keyframe : *list.keyframes) {
      text += fmt::format("{}{{ time = {}, {} = {} }}", text.empty() ? "[" : ", ", keyframe.time, list.names[list.name],
                          (*this)(&keyframe.value));
    }
    return text.empty() ? "" : text + "]";
  }
  std::string operator()(const FormulaList& list) const {
    return fmt::format("[\"{}\"]", fmt::join(*list.formulas, "\", \""));
  }
  std::string operator()(const VertexSelection& selection) const { return (*this)(selection.vertices); }
  std::string operator()(const Eigen::Vector2i* value) const {
    return fmt::format("[{}, {}]", (*value)[0], (*value)[1]);
  }
  std::string operator()(const Eigen::Vector3d* value) const {
    return fmt::format("[{}, {}, {}]", (*value)[0], (*value)[1], (*value)[2]);
  }
  std::string operator()(const std::vector<int>* value) const {
    return value->empty() ? "" : fmt::format("[{}]", fmt::join(*value, ", "));
  }
  template <class T>
  std::string operator()(const std::optional<T>* value) const {
    return *value ? (*this)(&**value) : "";
  }
};

}  // namespace

std::string value_text(const Key::Target& target) { return std::visit(WriteValue{}, target); }

}  // namespace drape
