#pragma once

#include <fmt/format.h>
#include <string>

#include "drape/sim/body_shape.hpp"
#include "scene/table_reader.hpp"
#include "scene/values/json_schema.hpp"
#include "scene/values/value_kind.hpp"

namespace drape {

/// A table of a shape's lengths.
class BodyShapeKind final : public DescribedKind<BodyShapeKey> {
  void read(const GivenValue& given) const override {
    const auto& [kind, shape] = target(given.key);
    if (*shape) {
      const std::string& other = body_shape_names()[static_cast<std::size_t>((*shape)->kind)];
      given.problems.add(given.value.place, fmt::format("give only one of '{}' and '{}': each is the body's shape",
                                                        other, given.key.name));
      return;
    }
    const std::size_t before = given.problems.count();
    BodyShape lengths{.kind = kind};
    TableReader(given.folder, given.problems)
        .read(given.value, {.name = given.key.name, .help = {}, .keys = body_shape_keys(lengths)});
    if (given.problems.count() != before) return;
    if (const auto problem = body_shape_problem(lengths)) return given.report(*problem);
    *shape = lengths;
  }
  std::string text(const Key&) const override { return ""; }
  /// Lists the lengths; omits shapes of other kinds.
  std::optional<std::string> hashed_text(const Key& key, const TomlValue*, const Path&) const override {
    const auto& [kind, shape] = target(key);
    if (!*shape || (*shape)->kind != kind) return std::nullopt;
    const BodyShape& s = **shape;
    return fmt::format("{} {} {} {} {} {}", s.radius, s.height, s.top, s.width, s.depth, s.segments);
  }
  std::string form(const Key& key) const override {
    BodyShape shape{.kind = target(key).kind};
    const Keys keys = body_shape_keys(shape);
    std::string names;
    for (const Key& one : keys.all()) {
      if (one.unit == "m") names += (names.empty() ? "" : ", ") + one.name;
    }
    return "{ " + names + " }";
  }
  Json schema(const Key& key) const override {
    BodyShape shape{.kind = target(key).kind};
    return json_schema::table(body_shape_keys(shape));
  }
};

}  // namespace drape
