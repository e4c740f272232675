#include "scene/scene_values.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <stdexcept>

#include "core/bytes.hpp"
#include "core/text.hpp"
#include "scene/values/value_kind.hpp"

namespace drape {

std::vector<WrittenTable> written_tables(ClothList& cloths, Scene& scene, std::vector<ReadEffect>& effects,
                                         const TomlValue& document) {
  std::vector<WrittenTable> tables;
  const auto add = [&](TableType type, const std::string& path) {
    type.name = path;
    tables.push_back({std::move(type), find_path(document, path)});
  };
  for (ClothTable& cloth : cloths.tables) {
    const std::string path = cloths.tables.size() == 1 ? "cloth" : "cloth." + cloth.name;
    std::vector<TableType> types = cloth_tables(cloth);
    add(std::move(types[0]), path);
    add(std::move(types[1]), path + ".transform");
  }
  for (std::size_t k = 0; k < cloths.seams.size(); ++k) {
    add(seam_table(cloths.seams[k]), cloths.seams.size() == 1 ? "seam" : fmt::format("seam.{}", k));
  }
  for (TableType& type : other_tables(scene)) add(type, type.name);
  const std::vector<std::string> paths = effect_paths(effects);
  for (std::size_t i = 0; i < effects.size(); ++i) {
    TableType type{.name = paths[i], .help = {}, .keys = {}};
    effects[i].effect.describe(type.keys);
    tables.push_back({std::move(type), effects[i].table, true});
  }
  return tables;
}

namespace {

const TomlValue* entry_of(const TomlValue* table, const std::string& key) {
  const TomlTable* entries = table == nullptr ? nullptr : table->as<TomlTable>();
  return entries == nullptr ? nullptr : entries->find(key);
}

std::string springs_text(const std::vector<Spring>& springs) {
  Hash hash;
  for (const Spring& spring : springs) {
    hash.add(&spring.i, sizeof spring.i);
    hash.add(&spring.j, sizeof spring.j);
    hash.add(&spring.rest_length, sizeof spring.rest_length);
    hash.add(&spring.stiffness, sizeof spring.stiffness);
  }
  return fmt::format("{} springs ({})", springs.size(), hash.text());
}

std::string seam_text(const Seam& seam) {
  Hash hash;
  for (const SeamTie& tie : seam.ties) {
    hash.add(&tie.vertex, sizeof tie.vertex);
    hash.add(tie.edge.data(), sizeof tie.edge);
    hash.add(&tie.share, sizeof tie.share);
    hash.add(&tie.length, sizeof tie.length);
  }
  return fmt::format("{} ties ({}), closed at {} s", seam.ties.size(), hash.text(), seam.time);
}

}  // namespace

std::string toml_text(const TomlValue& value) {
  if (const auto* text = value.as<std::string>()) return *text;
  if (const auto* flag = value.as<bool>()) return *flag ? "true" : "false";
  if (const auto* whole = value.as<std::int64_t>()) return fmt::format("{}", *whole);
  if (const auto* number = value.as<double>()) return fmt::format("{}", *number);
  std::string text;
  if (const auto* array = value.as<TomlArray>()) {
    for (const TomlValue& item : *array) text += (text.empty() ? "" : ", ") + toml_text(item);
    return "[" + text + "]";
  }
  if (const auto* table = value.as<TomlTable>()) {
    for (const TomlEntry& entry : table->entries) {
      text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", entry.name, toml_text(entry.value));
    }
  }
  return "{ " + text + " }";
}

std::vector<SceneField> scene_fields(const std::string& name, const std::vector<WrittenTable>& tables) {
  std::vector<SceneField> fields{{"scene", name}};
  for (const auto& [type, written, effect] : tables) {
    for (const Key& key : type.keys.all()) {
      fields.push_back({type.name + "." + key.name, kind_of(key).field(key, entry_of(written, key.name))});
    }
  }
  return fields;
}

std::vector<SceneValue> physics_of_tables(const std::vector<WrittenTable>& tables,
                                          const std::filesystem::path& folder) {
  std::vector<SceneValue> values;
  for (const auto& [type, written, effect] : tables) {
    if (type.affects != TableType::Affects::motion) continue;
    if (effect) values.push_back({type.name, "there"});
    for (const Key& key : type.keys.all()) {
      if (!key.hashed) continue;
      auto text = kind_of(key).hashed_text(key, entry_of(written, key.name), folder);
      if (text) values.push_back({type.name + "." + key.name, *std::move(text)});
    }
  }
  return values;
}

std::vector<SceneValue> physics_values(const LoadedScene& scene) {
  const Cloth& cloth = scene.simulation.cloth;
  std::vector<SceneValue> values{
      {"cloth.mesh", fmt::format("{} vertices ({}), {} triangles ({})", cloth.vertex_count(),
                                 checksum_of(cloth.positions.data(), static_cast<std::size_t>(cloth.positions.size())),
                                 cloth.triangles.size(), checksum_of(cloth.triangles.data(), cloth.triangles.size()))},
      {"cloth.rest", springs_text(cloth.springs)},
      {"cloth.pins", fmt::format("{} ({})", cloth.pins.size(), checksum_of(cloth.pins.data(), cloth.pins.size()))}};
  for (const ClothPiece& piece : cloth.pieces) {
    if (cloth.pieces.size() < 2) break;
    values.push_back(
        {"cloth." + piece.name, fmt::format("{} vertices from {}", piece.vertex_count, piece.first_vertex)});
  }
  for (std::size_t k = 0; k < cloth.seams.size(); ++k) {
    values.push_back({fmt::format("seam.{}", k), seam_text(cloth.seams[k])});
  }
  values.insert(values.end(), scene.source.tables.begin(), scene.source.tables.end());
  return values;
}

std::string physics_hash(const std::vector<SceneValue>& values) {
  Hash hash;
  for (const SceneValue& value : values) hash.add(fmt::format("{}={}\n", value.key, value.text));
  return hash.text();
}

std::string physics_difference(const std::vector<SceneValue>& a, const std::vector<SceneValue>& b,
                               const std::string& name) {
  const auto text_in = [](const std::vector<SceneValue>& values, const std::string& key) {
    const auto found = std::ranges::find(values, key, &SceneValue::key);
    return found == values.end() || found->text.empty() ? std::string("nothing") : found->text;
  };
  std::string text;
  const auto add = [&](const std::string& key) {
    const std::string in_a = text_in(a, key), in_b = text_in(b, key);
    if (in_a != in_b) text += fmt::format("{}{}: {}, and {} in {}", text.empty() ? "" : "\n", key, in_a, in_b, name);
  };
  constexpr std::string_view springs = "cloth.rest";  // computed from other keys
  for (const SceneValue& value : a) {
    if (value.key != springs) add(value.key);
  }
  for (const SceneValue& value : b) {
    if (std::ranges::find(a, value.key, &SceneValue::key) == a.end()) add(value.key);
  }
  if (text.empty()) add(std::string(springs));
  return text;
}

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

/// Finds a field by its path. The path of an effect that is not repeated may contain the number 0, as in --set.
std::vector<SceneField>::const_iterator find_field(const std::vector<SceneField>& fields, std::string path) {
  const auto found = std::ranges::find(fields, path, &SceneField::path);
  const std::size_t number = path.starts_with("effects.") ? path.find(".0.") : std::string::npos;
  if (found != fields.end() || number == std::string::npos) return found;
  return std::ranges::find(fields, path.erase(number, 2), &SceneField::path);
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
      const auto field = find_field(fields, piece.text);
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
