#include "scene/caption.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <stdexcept>

#include "core/text.hpp"

namespace drape {
namespace {

struct MomentField {
  const char* name;
  bool asked_for;  ///< frames carry it only on request
  FieldValue (*value)(const Frame& frame, double step);
};

Energies energies_of(const Frame& frame) { return frame.energies.value_or(Energies{}); }

const std::array moments{
    MomentField{"time", false, [](const Frame& frame, double) -> FieldValue { return frame.time; }},
    MomentField{"frame", false, [](const Frame& frame, double) -> FieldValue { return std::int64_t{frame.index}; }},
    MomentField{"step", false,
                [](const Frame& frame, double step) -> FieldValue {
                  return static_cast<std::int64_t>(std::ceil(frame.time / step - 1e-6));
                }},
    MomentField{"iterations", true,
                [](const Frame& frame, double) -> FieldValue { return std::int64_t{frame.iterations}; }},
    MomentField{"energy.total", true,
                [](const Frame& frame, double) -> FieldValue { return energies_of(frame).total(); }},
    MomentField{"energy.kinetic", true,
                [](const Frame& frame, double) -> FieldValue { return energies_of(frame).kinetic; }},
    MomentField{"energy.gravity", true,
                [](const Frame& frame, double) -> FieldValue { return energies_of(frame).gravity; }},
    MomentField{"energy.elastic", true,
                [](const Frame& frame, double) -> FieldValue { return energies_of(frame).elastic; }},
};

const MomentField* find_moment(const std::string& name) {
  const auto found = std::find_if(moments.begin(), moments.end(), [&](const auto& m) { return m.name == name; });
  return found == moments.end() ? nullptr : &*found;
}

/// Suggests an existing name for an unknown one: the nearest name, or one that ends in it.
std::string suggestion(const std::string& name, const std::vector<SceneField>& fields) {
  std::vector<std::string> names = moment_fields();
  for (const SceneField& field : fields) names.push_back(field.path);
  std::string meant = nearest_name(name, names);
  const auto ends = std::find_if(names.begin(), names.end(), [&](const auto& n) { return n.ends_with("." + name); });
  if (meant.empty() && !name.empty() && ends != names.end()) meant = *ends;
  if (!meant.empty()) return fmt::format("; did you mean '{}'?", meant);
  return fmt::format("; values that change with time are {}; scene keys are written as in 'integrator.method'",
                     quoted_list(moment_fields()));
}

}  // namespace

std::vector<std::string> moment_fields() {
  std::vector<std::string> names;
  for (const MomentField& moment : moments) names.emplace_back(moment.name);
  return names;
}

FieldValue moment_value(const std::string& name, const Frame& frame, double step) {
  const MomentField* moment = find_moment(name);
  if (moment == nullptr) throw std::invalid_argument("a moment has no " + name);
  return moment->value(frame, step);
}

bool needs_motion_facts(const TextTemplate& text) {
  return std::any_of(text.pieces().begin(), text.pieces().end(), [](const TextTemplate::Piece& piece) {
    const MomentField* moment = piece.is_field ? find_moment(piece.text) : nullptr;
    return moment != nullptr && moment->asked_for;
  });
}

TextTemplate fill_caption(const std::string& text, const std::vector<SceneField>& fields, const Place& place,
                          Problems& problems) {
  TextTemplate filled;
  try {
    filled = TextTemplate(text);
  } catch (const std::invalid_argument& error) {
    problems.add(place, fmt::format("text: {}", error.what()));
    return {};
  }
  for (std::size_t i = 0; i < filled.pieces().size(); ++i) {
    const TextTemplate::Piece piece = filled.pieces()[i];
    if (!piece.is_field) continue;
    try {
      const auto field =
          std::find_if(fields.begin(), fields.end(), [&](const auto& f) { return f.path == piece.text; });
      if (find_moment(piece.text) != nullptr) {
        format_field(moment_value(piece.text, Frame{}, 1), piece.format);
      } else if (field != fields.end()) {
        // An open value is a word; others have a number there. No format suits both.
        const bool open = field->value == FieldValue("default");
        filled.replace(i, format_field(field->value, open ? "" : piece.format));
      } else {
        problems.add(place, fmt::format("text: unknown name '{}'{}", piece.text, suggestion(piece.text, fields)));
      }
    } catch (const std::invalid_argument& error) {
      problems.add(place, fmt::format("text: {{{}:{}}}: {}", piece.text, piece.format, error.what()));
    }
  }
  return filled;
}

}  // namespace drape
