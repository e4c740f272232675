#include "scene/table_reader.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <any>
#include <charconv>
#include <cmath>

#include "core/text.hpp"
#include "drape/core/error.hpp"
#include "drape/scene/scene.hpp"
#include "drape/sim/body_shape.hpp"
#include "drape/sim/effects/self_collision.hpp"
#include "scene/cloth_reader.hpp"
#include "scene/mesh_value.hpp"
#include "scene/usd/motion.hpp"
#include "scene/values.hpp"

namespace drape {
namespace {

constexpr const char* effects_table = "effects";

/// Reads a list of [x, y, width, height].
std::vector<PixelRectangle> read_rectangles(const TomlValue& value, const std::string& name, Problems& problems) {
  constexpr int largest = 8192;  // limit of [check] size
  std::vector<PixelRectangle> rectangles;
  const TomlArray* list = value.as<TomlArray>();
  if (list == nullptr) {
    problems.add(value.place, fmt::format("{}: expected [[x, y, width, height], …], found {}", name, value.kind()));
    return rectangles;
  }
  for (const TomlValue& item : *list) {
    const auto numbers = read_ints(item, name, {.minimum = 0, .maximum = largest}, problems);
    if (!numbers) continue;
    if (numbers->size() != 4 || (*numbers)[2] == 0 || (*numbers)[3] == 0) {
      problems.add(item.place, name + ": expected [x, y, width, height], with a width and a height above 0");
      continue;
    }
    rectangles.push_back({(*numbers)[0], (*numbers)[1], (*numbers)[2], (*numbers)[3]});
  }
  return rectangles;
}

/// Reads an item of [[cloth, cloth, { friction = number }], …]; returns nothing after a problem.
std::optional<ClothFriction> read_friction(const TomlValue& item, const std::string& name, Problems& problems) {
  const TomlArray* parts = item.as<TomlArray>();
  const TomlTable* table = parts == nullptr || parts->size() != 3 ? nullptr : (*parts)[2].as<TomlTable>();
  const TomlValue* value = table == nullptr ? nullptr : table->find("friction");
  const std::string* first = value == nullptr ? nullptr : (*parts)[0].as<std::string>();
  const std::string* second = value == nullptr ? nullptr : (*parts)[1].as<std::string>();
  if (first == nullptr || second == nullptr || table->entries.size() != 1) {
    problems.add(item.place, name + ": expected [\"cloth\", \"cloth\", { friction = number }]");
    return std::nullopt;
  }
  const auto friction = read_number(*value, name + ".friction", {.minimum = 0}, problems);
  if (!friction) return std::nullopt;
  return ClothFriction{.cloths = {*first, *second}, .friction = *friction};
}

/// Reads the friction of pairs of cloths.
std::vector<ClothFriction> read_frictions(const TomlValue& value, const std::string& name, Problems& problems) {
  std::vector<ClothFriction> frictions;
  const TomlArray* list = value.as<TomlArray>();
  if (list == nullptr) {
    problems.add(value.place, fmt::format("{}: expected [[cloth, cloth, {{ friction = number }}], …], found {}", name,
                                          value.kind()));
    return frictions;
  }
  for (const TomlValue& item : *list) {
    if (auto friction = read_friction(item, name, problems)) frictions.push_back(*std::move(friction));
  }
  return frictions;
}

/// Reader of a key's value into its target, for every type of target.
class KeyReader {
 public:
  /// @param table table that contains the key
  KeyReader(const TomlTable& table, const TomlValue& value, const Key& key, const std::filesystem::path& folder,
            const std::deque<PlacedSelection>* meshes, Problems& problems, std::vector<std::filesystem::path>& files)
      : table_(table),
        value_(value),
        key_(key),
        range_{key.minimum, key.maximum, key.minimum_excluded},
        folder_(folder),
        meshes_(meshes),
        problems_(problems),
        files_(files) {}

  void operator()(bool* target) const { assign(target, read_bool(value_, key_.name, problems_)); }
  void operator()(int* target) const { assign(target, read_int(value_, key_.name, range_, problems_)); }
  void operator()(double* target) const { assign(target, in_reach(read_number(value_, key_.name, range_, problems_))); }
  void operator()(std::string* target) const { assign(target, read_string(value_, key_.name, problems_)); }
  void operator()(std::filesystem::path* target) const {
    const std::optional<std::filesystem::path> file = read_file_name(value_, key_.name, folder_, problems_);
    assign(target, file);
    if (file && !file->empty()) files_.push_back(*file);
  }
  void operator()(Rgb* target) const { assign(target, read_color()); }
  void operator()(Eigen::Vector2i* target) const {
    assign(target, read_int_pair(value_, key_.name, range_, problems_));
  }
  void operator()(Eigen::Vector3d* target) const {
    assign(target, in_reach(read_vector(value_, key_.name, range_, problems_)));
  }
  void operator()(std::vector<int>* target) const { assign(target, read_ints(value_, key_.name, range_, problems_)); }
  void operator()(std::optional<Eigen::Vector2i>* target) const {
    assign(target, read_int_pair(value_, key_.name, range_, problems_));
  }
  void operator()(std::optional<int>* target) const { assign(target, read_int(value_, key_.name, range_, problems_)); }
  void operator()(std::optional<double>* target) const {
    assign(target, in_reach(read_number(value_, key_.name, range_, problems_)));
  }
  void operator()(std::optional<WarpWeft>* target) const {
    if (value_.as<TomlArray>() == nullptr) {
      assign(target, read_number(value_, key_.name, range_, problems_));
    } else if (const auto both = read_pair(value_, key_.name, range_, problems_)) {
      *target = WarpWeft((*both)[0], (*both)[1]);
    }
  }
  void operator()(std::optional<Rgb>* target) const { assign(target, read_color()); }
  void operator()(std::optional<Eigen::Vector3d>* target) const {
    assign(target, in_reach(read_vector(value_, key_.name, range_, problems_)));
  }
  void operator()(const CustomValue& form) const {
    if (auto* const* track = std::any_cast<std::shared_ptr<const SphereTrack>*>(&form.target)) {
      read_track(**track);
    } else if (auto* const* moving = std::any_cast<std::shared_ptr<const MeshMotion>*>(&form.target)) {
      read_moving_mesh(**moving);
    } else if (const auto* shape = std::any_cast<BodyShapeKey>(&form.target)) {
      read_shape(*shape);
    } else if (auto* const* frictions = std::any_cast<std::vector<ClothFriction>*>(&form.target)) {
      **frictions = read_frictions(value_, key_.name, problems_);
    } else if (auto* const* rectangles = std::any_cast<std::vector<PixelRectangle>*>(&form.target)) {
      **rectangles = read_rectangles(value_, key_.name, problems_);
    } else {
      *std::any_cast<const TomlValue**>(form.target) = &value_;  // the describer of the table reads it
    }
  }
  void operator()(const KeyframeList& list) const {
    const std::size_t before = problems_.count();
    read_keyframes(value_, key_.name, list, problems_);
    if (problems_.count() != before) return;
    for (const Keyframe& keyframe : *list.keyframes) {
      if (!in_reach(std::optional(keyframe.value))) return;
    }
  }
  void operator()(const VertexSelection& selection) const {
    const std::size_t before = problems_.count();
    const PlacedSelection* mesh = selected_cloth();
    if (problems_.count() != before) return;
    *selection.vertices = read_pins(value_, mesh == nullptr ? nullptr : &mesh->mesh, problems_);
    if (mesh == nullptr) return;
    for (int& vertex : *selection.vertices) vertex += mesh->first_vertex;
  }

  void operator()(const FormulaList& list) const {
    if (const auto formulas = read_formulas(value_, key_.name, list.problem, problems_)) *list.formulas = *formulas;
  }

  void operator()(const Choice& choice) const {
    const std::optional<std::string> name = read_string(value_, key_.name, problems_);
    if (!name) return;
    const auto found = std::find(choice.names.begin(), choice.names.end(), *name);
    if (found != choice.names.end()) {
      choice.set(static_cast<std::size_t>(found - choice.names.begin()));
    } else {
      problems_.add(value_.place, fmt::format("unknown {} '{}'{}", key_.name, *name,
                                              did_you_mean(*name, choice.names, "the choices are")));
    }
  }

 private:
  template <class Target, class Result>
  static void assign(Target* target, const std::optional<Result>& result) {
    if (result) *target = *result;
  }

  /// Returns the cloth that `cloth` beside the key names, or the only one; null after a problem and without cloths.
  [[nodiscard]] const PlacedSelection* selected_cloth() const {
    if (meshes_ == nullptr || meshes_->empty()) return nullptr;
    const TomlValue* name = table_.find("cloth");
    const std::string* text = name == nullptr ? nullptr : name->as<std::string>();
    if (name == nullptr && meshes_->size() == 1) return &meshes_->front();
    if (name == nullptr) {
      problems_.add(value_.place, key_.name + ": there are several cloths: say which one with 'cloth'");
    }
    if (text == nullptr) return nullptr;
    const auto found = std::ranges::find(*meshes_, *text, &PlacedSelection::name);
    if (found != meshes_->end()) return &*found;
    std::vector<std::string> names;
    for (const PlacedSelection& mesh : *meshes_) names.push_back(mesh.name);
    problems_.add(name->place,
                  fmt::format("unknown cloth '{}'{}", *text, did_you_mean(*text, names, "the cloths are")));
    return nullptr;
  }

  static double magnitude(double number) { return std::abs(number); }
  static double magnitude(const Eigen::Vector3d& vector) { return vector.cwiseAbs().maxCoeff(); }

  /// Rejects positions and velocities so large that their products overflow.
  template <class Value>
  std::optional<Value> in_reach(const std::optional<Value>& value) const {
    const bool of_place = key_.unit == "m" || key_.unit == "m/s" || key_.unit == "s, m";
    if (!value || !of_place || magnitude(*value) <= furthest_place) return value;
    problems_.add(value_.place, fmt::format("{}: found {:g}; beyond {:g} {} it overflows double precision", key_.name,
                                            magnitude(*value), furthest_place, key_.unit == "m/s" ? "m/s" : "m"));
    return std::nullopt;
  }

  void read_track(std::shared_ptr<const SphereTrack>& track) const {
    const std::optional<std::string> file = read_string(value_, key_.name, problems_);
    if (!file) return;
    files_.push_back(folder_ / *file);
    try {
      track = read_sphere_track(folder_ / *file);
    } catch (const UsageError& error) {
      problems_.add(value_.place, fmt::format("{}: '{}' cannot be read:\n{}", key_.name, *file, error.what()));
    }
  }

  void read_shape(const BodyShapeKey& key) const {
    if (*key.shape) {
      const std::string& other = body_shape_names()[static_cast<std::size_t>((*key.shape)->kind)];
      problems_.add(value_.place,
                    fmt::format("give only one of '{}' and '{}': each is the body's shape", other, key_.name));
      return;
    }
    const std::size_t before = problems_.count();
    BodyShape shape{.kind = key.kind};
    TableReader(folder_, problems_).read(value_, {.name = key_.name, .help = {}, .keys = body_shape_keys(shape)});
    if (problems_.count() != before) return;
    if (const auto problem = body_shape_problem(shape)) {
      problems_.add(value_.place, key_.name + ": " + *problem);
    } else {
      *key.shape = shape;
    }
  }

  void require_reach(const MeshMotion& motion) const {
    double furthest = motion.mesh.positions.lpNorm<Eigen::Infinity>();
    for (const Vertices& sample : motion.samples) furthest = std::max(furthest, sample.lpNorm<Eigen::Infinity>());
    if (furthest <= furthest_place) return;
    problems_.add(value_.place,
                  fmt::format("{}: a vertex is at {:g} m; distances beyond {:g} m overflow double precision", key_.name,
                              furthest, furthest_place));
  }

  /// Reads a mesh that may move. If only a file name is given, the key `prim` beside it selects the mesh in the file.
  void read_moving_mesh(std::shared_ptr<const MeshMotion>& mesh) const {
    std::optional<MeshName> named = read_mesh_name(value_, key_.name, true, problems_);
    if (!named) return;
    const TomlValue* prim = value_.as<std::string>() == nullptr ? nullptr : table_.find("prim");
    if (prim != nullptr && prim->as<std::string>() != nullptr) named->options.prim = *prim->as<std::string>();
    try {
      mesh = std::make_shared<MeshMotion>(read_mesh_motion(folder_ / named->file, named->options, &files_));
      require_reach(*mesh);
    } catch (const UsageError& error) {
      problems_.add(value_.place,
                    fmt::format("{}: '{}' cannot be read:\n{}", key_.name, shown(named->file), error.what()));
    }
  }

  [[nodiscard]] std::optional<Rgb> read_color() const {
    const std::optional<std::string> text = read_string(value_, key_.name, problems_);
    if (!text) return std::nullopt;
    const std::optional<Rgb> color = parse_color(*text);
    if (!color) {
      problems_.add(value_.place,
                    text->starts_with('#')
                        ? fmt::format("{}: expected a colour like '#d4a017' or '#fff', found '{}'", key_.name, *text)
                        : fmt::format("{}: unknown colour '{}'{}", key_.name, *text,
                                      did_you_mean(*text, color_names(), "write it as '#rrggbb' or one of")));
    }
    return color;
  }

  const TomlTable& table_;
  const TomlValue& value_;
  const Key& key_;
  Range range_;
  const std::filesystem::path& folder_;
  const std::deque<PlacedSelection>* meshes_;
  Problems& problems_;
  std::vector<std::filesystem::path>& files_;
};

std::vector<std::string> key_names(const TableType& type) {
  std::vector<std::string> names;
  for (const Key& key : type.keys.all()) names.push_back(key.name);
  return names;
}

bool contains(const std::vector<std::string>& names, const std::string& name) {
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// Returns the last names of the types with tables directly within `owner`; empty means the root.
std::vector<std::string> tables_within(const std::string& owner, const std::vector<TableType>& types) {
  const std::string prefix = owner.empty() ? "" : owner + ".";
  std::vector<std::string> names;
  for (const TableType& type : types) {
    if (!type.name.starts_with(prefix)) continue;
    const std::string rest = type.name.substr(prefix.size());
    if (rest.find('.') == std::string::npos) names.push_back(rest);
  }
  return names;
}

/// Returns true if a table or the one that contains it may be written several times.
bool is_repeatable(const TableType& type, const std::vector<TableType>& types) {
  const std::string owner = type.name.substr(0, type.name.find('.'));
  return std::ranges::any_of(types, [&](const TableType& one) { return one.name == owner && one.repeatable; });
}

}  // namespace

void TableReader::read_all(const TomlValue& document, const std::vector<TableType>& types) {
  for (const TableType& type : types) {
    for (const Key& key : type.keys.all()) homes_.push_back({key.name, type.name});
  }
  std::vector<std::string> top = tables_within("", types);
  top.emplace_back(effects_table);
  for (const TomlEntry& entry : document.as<TomlTable>()->entries) {
    if (!contains(top, entry.name)) report_unknown_below_root(entry, top);
  }
  for (const TableType& type : types) {
    if (const TomlValue* value = find_path(document, type.name)) {
      if (!is_repeatable(type, types)) read(*value, type, tables_within(type.name, types));
    } else if (type.required) {
      problems_.add(document.place, fmt::format("missing table [{}]", type.name));
    }
  }
}

void TableReader::read(const TomlValue& value, const TableType& type, const std::vector<std::string>& subtables) {
  const std::size_t problems_before = problems_.count();
  if (const TomlTable* table = value.as<TomlTable>()) {
    read_entries(*table, type, subtables);
    for (const Key& key : type.keys.all()) {
      const auto given = [&](const std::string& name) { return table->find(name) != nullptr; };
      if (key.required && !given(key.name) && std::ranges::none_of(key.alternatives, given)) {
        problems_.add(value.place,
                      fmt::format("missing key {} in [{}]", quoted_or(key.name, key.alternatives), type.name));
      }
    }
  } else if (value.as<TomlArray>() != nullptr) {
    problems_.add(value.place, fmt::format("[{}] can only be given once, found an array", type.name));
  } else {
    problems_.add(value.place, fmt::format("expected a table [{}], found {}", type.name, value.kind()));
  }
  if (problems_.count() != problems_before) bad_.push_back(type.name);
}

void TableReader::read_entries(const TomlTable& table, const TableType& type,
                               const std::vector<std::string>& subtables) {
  const auto& keys = type.keys.all();
  for (const TomlEntry& entry : table.entries) {
    const auto key = std::find_if(keys.begin(), keys.end(), [&](const Key& k) { return k.name == entry.name; });
    if (key != keys.end()) {
      std::visit(KeyReader(table, entry.value, *key, folder_, meshes_, problems_, files_), key->target);
    } else if (!contains(subtables, entry.name)) {
      report_unknown(entry, type, subtables);
    }
  }
}

bool TableReader::good(const std::string& table) const { return !contains(bad_, table) && !contains(bad_, ""); }

void TableReader::report_unknown(const TomlEntry& entry, const TableType& type,
                                 const std::vector<std::string>& subtables) {
  std::string message = fmt::format("unknown key '{}' in [{}]", entry.name, type.name);
  const auto& replaced_keys = type.keys.replaced();
  if (const auto replaced = replaced_keys.find(entry.name); replaced != replaced_keys.end()) {
    message = fmt::format("'{}' in [{}] no longer exists: {}", entry.name, type.name, replaced->second);
  } else if (const Home* home = home_of(entry.name)) {
    message += fmt::format("; it belongs in [{}]", home->table);
  } else {
    std::vector<std::string> names = key_names(type);
    names.insert(names.end(), subtables.begin(), subtables.end());
    message += did_you_mean(entry.name, names, "the keys are");
  }
  problems_.add(entry.place, message);
}

void TableReader::report_unknown_below_root(const TomlEntry& entry, const std::vector<std::string>& tables) {
  bad_.emplace_back();
  if (const Home* home = home_of(entry.name)) {
    problems_.add(entry.place, fmt::format("'{}' belongs in [{}]", entry.name, home->table));
  } else {
    problems_.add(entry.place,
                  fmt::format("unknown table '{}'{}", entry.name, did_you_mean(entry.name, tables, "the tables are")));
  }
}

const TableReader::Home* TableReader::home_of(const std::string& key) const {
  const auto home = std::find_if(homes_.begin(), homes_.end(), [&](const Home& h) { return h.key == key; });
  return home == homes_.end() ? nullptr : &*home;
}

Place place_of(const TomlValue& table, std::string_view key) {
  const TomlTable* entries = table.as<TomlTable>();
  const TomlValue* value = entries == nullptr ? nullptr : entries->find(key);
  return value == nullptr ? table.place : value->place;
}

const TomlValue* find_item(const TomlArray& items, std::string_view name) {
  std::size_t number = 0;
  const char* const end = name.data() + name.size();
  const auto [stop, error] = std::from_chars(name.data(), end, number);
  if (error == std::errc() && stop == end) return number < items.size() ? &items[number] : nullptr;
  const auto found = std::ranges::find_if(items, [&](const TomlValue& item) {
    const TomlTable* table = item.as<TomlTable>();
    const TomlValue* own = table == nullptr ? nullptr : table->find("name");
    const std::string* text = own == nullptr ? nullptr : own->as<std::string>();
    return text != nullptr && *text == name;
  });
  return found == items.end() ? nullptr : &*found;
}

const TomlValue* find_path(const TomlValue& document, std::string_view path) {
  const TomlValue* value = &document;
  while (value != nullptr && !path.empty()) {
    const std::size_t dot = std::min(path.find('.'), path.size());
    const TomlTable* table = value->as<TomlTable>();
    const TomlArray* items = value->as<TomlArray>();
    const std::string_view name = path.substr(0, dot);
    value = items != nullptr ? find_item(*items, name) : table == nullptr ? nullptr : table->find(name);
    path.remove_prefix(std::min(dot + 1, path.size()));
  }
  return value;
}

}  // namespace drape
