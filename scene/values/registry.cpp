#include <fmt/format.h>
#include <map>
#include <stdexcept>

#include "scene/values/body_shape.hpp"
#include "scene/values/cloth.hpp"
#include "scene/values/functions_of_time.hpp"
#include "scene/values/plain.hpp"
#include "scene/values/rectangles.hpp"
#include "scene/values/value_kind.hpp"

namespace drape {
namespace {

template <class Kind>
const ValueKind* row() {
  static const Kind kind;
  return &kind;
}

}  // namespace

const std::vector<const ValueKind*>& value_kinds() {
  static const std::vector<const ValueKind*> kinds{
      // clang-format off
      row<FlagKind>(),
      row<WholeNumberKind>(),
      row<NumberKind>(),
      row<WholePairKind>(),
      row<VectorKind>(),
      row<WholeNumbersKind>(),
      row<WarpWeftKind>(),
      row<StringKind>(),
      row<FileNameKind>(),
      row<ChoiceKind>(),
      row<ClothNameKind>(),
      row<MeshKind>(),
      row<MovingMeshKind>(),
      row<TrackKind>(),
      row<FilesKind>(),
      row<ScaleKind>(),
      row<PinsKind>(),
      row<VertexSelectionKind>(),
      row<SeamSideKind>(),
      row<KeyframesKind>(),
      row<FormulasKind>(),
      row<BodyShapeKind>(),
      row<ClothFrictionsKind>(),
      row<RectanglesKind>(),
      row<ColourKind>(),
      // clang-format on
  };
  return kinds;
}

const ValueKind& kind_of(const Key& key) {
  static const std::map<std::type_index, const ValueKind*> by_type = [] {
    std::map<std::type_index, const ValueKind*> map;
    for (const ValueKind* kind : value_kinds()) {
      for (const std::type_index type : kind->types()) map[type] = kind;
    }
    return map;
  }();
  const auto found = by_type.find(key.target.type());
  if (found == by_type.end()) throw std::logic_error("no kind of value is registered for the key " + key.name);
  return *found->second;
}

std::optional<std::string> ValueKind::hashed_text(const Key& key, const TomlValue*, const Path&) const {
  return text(key);
}

FieldValue ValueKind::field(const Key&, const TomlValue* written) const {
  return written == nullptr ? "none" : toml_text(*written);
}

std::vector<std::string> ValueKind::words(const Key&) const { return {}; }

std::optional<std::pair<std::string, ValueKind::Json>> ValueKind::definition() const { return std::nullopt; }

}  // namespace drape
