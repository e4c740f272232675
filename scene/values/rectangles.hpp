#pragma once

#include <fmt/format.h>
#include <vector>

#include "drape/scene/scene.hpp"
#include "scene/values/json_schema.hpp"
#include "scene/values/value_kind.hpp"

namespace drape {

/// Rectangles of a picture's pixels.
class RectanglesKind final : public DescribedKind<std::vector<PixelRectangle>*> {
  void read(const GivenValue& given) const override {
    constexpr int largest = 8192;  // limit of [check] size
    std::vector<PixelRectangle>& rectangles = *target(given.key);
    rectangles.clear();
    const TomlArray* list = given.value.as<TomlArray>();
    if (list == nullptr) return given.report(fmt::format("expected {}, found {}", form(given.key), given.value.kind()));
    for (const TomlValue& item : *list) {
      const auto numbers = read_ints(item, given.key.name, {.minimum = 0, .maximum = largest}, given.problems);
      if (!numbers) continue;
      if (numbers->size() != 4 || (*numbers)[2] == 0 || (*numbers)[3] == 0) {
        given.problems.add(item.place,
                           given.key.name + ": expected [x, y, width, height], with a width and a height above 0");
        continue;
      }
      rectangles.push_back({(*numbers)[0], (*numbers)[1], (*numbers)[2], (*numbers)[3]});
    }
  }
  std::string text(const Key&) const override { return ""; }
  std::string form(const Key&) const override { return "[[x, y, width, height], …]"; }
  Json schema(const Key&) const override {
    return json_schema::list(json_schema::tuple({{"type", "integer"}, {"minimum", 0}}, 4));
  }
};

}  // namespace drape
