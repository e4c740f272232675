#include "scene/motion_scene.hpp"

#include <fmt/format.h>
#include <algorithm>

#include "drape/core/error.hpp"
#include "drape/scene/document.hpp"
#include "scene/table_reader.hpp"

namespace drape {
namespace fs = std::filesystem;
namespace {

constexpr double longest_motion = 1e6;  // stand-in until the motion is read

/// Returns true for a table other than [cloth] that affects the motion: "time".
bool is_physics(const std::string& table) {
  return table == "effects" || std::ranges::count(tables_that_affect(TableType::Affects::motion), table) > 0;
}

/// Returns true for an override of a physics table, for example "cloth.mass=2".
bool is_of_physics(const std::string& override_text) {
  const std::string table = override_text.substr(0, override_text.find_first_of(".="));
  return table == "cloth" || is_physics(table);
}

/// Reports and removes keys that only a computed motion has.
void refuse_physics(TomlTable& root, TomlTable& cloth, const TableType& own, Problems& problems) {
  std::erase_if(root.entries, [&](const TomlEntry& entry) {
    if (!is_physics(entry.name)) return false;
    problems.add(entry.place, fmt::format("[{}]: the motion is read, not computed: omit this table", entry.name));
    return true;
  });
  ClothTable unused;
  const std::deque<Key> computed = cloth_tables(unused).front().keys.all();
  std::erase_if(cloth.entries, [&](const TomlEntry& entry) {
    const bool is_own = std::ranges::find(own.keys.all(), entry.name, &Key::name) != own.keys.all().end();
    const bool is_computed = std::ranges::find(computed, entry.name, &Key::name) != computed.end();
    if (is_own || (!is_computed && entry.name != "transform")) return false;
    problems.add(entry.place, fmt::format("{}: the motion is read, not computed: omit it{}", entry.name,
                                          entry.name == "transform" ? "; 'scale' and 'up' place the files" : ""));
    return true;
  });
}

std::vector<std::string> read_bodies(const TomlValue& body, const fs::path& folder, Problems& problems) {
  std::vector<std::string> files;
  const auto add = [&](const TomlValue& value) {
    const auto* text = value.as<std::string>();
    if (text == nullptr || text->empty()) {
      problems.add(value.place, "body: expected a file or an array of files, found " + value.kind());
    } else {
      files.push_back((folder / *text).string());
    }
  };
  if (const auto* list = body.as<TomlArray>()) {
    for (const TomlValue& item : *list) add(item);
  } else {
    add(body);
  }
  return files;
}

NamedMotion read_named_motion(TomlTable& root, TomlValue& cloth, const fs::path& folder, Problems& problems) {
  NamedMotion named;
  const TomlValue* body = nullptr;
  const TableType table = named_motion_table(named, body);
  refuse_physics(root, *cloth.as<TomlTable>(), table, problems);
  TableReader(folder, problems).read(cloth, table);
  if (body != nullptr) named.bodies = read_bodies(*body, folder, problems);
  if (named.motion.empty() && problems.count() == 0) problems.add(place_of(cloth, "motion"), "motion: expected a file");
  named.motion = (folder / named.motion).string();
  if (!named.mesh.empty()) named.mesh = (folder / named.mesh).string();
  return named;
}

double number_at(const TomlValue& document, const char* path, double otherwise) {
  const TomlValue* value = find_path(document, path);
  if (value == nullptr) return otherwise;
  const double* number = value->as<double>();
  const std::int64_t* whole = value->as<std::int64_t>();
  const double found = number != nullptr ? *number : whole != nullptr ? static_cast<double>(*whole) : otherwise;
  return found > 0 ? found : otherwise;
}

/// Adds the smallest cloth, and a film longer than any, as stand-ins for the motion.
void add_stand_ins(TomlValue& document, const Place& place) {
  const Video usual;
  const double duration =
      longest_motion * number_at(document, "video.speed", usual.speed) / number_at(document, "video.fps", usual.fps);
  auto& entries = document.as<TomlTable>()->entries;
  std::erase_if(entries, [](const TomlEntry& entry) { return entry.name == "cloth"; });
  for (const auto& [name, text] :
       {std::pair<std::string, std::string>("cloth", "{ mesh = { grid = [1, 1] }, stiffness = 1 }"),
        std::pair<std::string, std::string>("integrator", "{ method = \"quasi-newton\", allow_unstable = true }"),
        std::pair<std::string, std::string>(
            "time", fmt::format("{{ step = {}, duration = {} }}", duration / 1000, duration))}) {
    entries.push_back({name, place, parse_value(text, place)});
  }
}

}  // namespace

TableType named_motion_table(NamedMotion& motion, const TomlValue*& body) {
  TableType table{.name = "cloth", .help = "A motion that is read instead of computed.", .keys = {}};
  Keys& keys = table.keys;
  keys.add("motion", &motion.motion, "", "Its file, or a sequence of files.").must_be_given();
  keys.add("body", Written<FilesKind>{&body}, "", "Obstacles, in the same formats.");
  keys.add("fps", &motion.fps, "1/s", "Frames per second.").above(0);
  keys.choice("up", motion.y_up, {"z", "y"}, "The axis that points up in the files.");
  keys.add("scale", &motion.scale, "m", "The length of a unit of the files.").above(0);
  keys.add("mesh", &motion.mesh, "", "The mesh of a .pc2.");
  keys.add("prim", &motion.prim, "", "The mesh of a USD file.");
  return table;
}

std::optional<SceneOfMotion> load_scene_of_motion(const fs::path& file, const std::vector<std::string>& overrides) {
  return load_scene_of_motion(read_document(file), file, overrides);
}

std::optional<SceneOfMotion> load_scene_of_motion(TomlValue document, const fs::path& file,
                                                  const std::vector<std::string>& overrides) {
  Problems problems(file, overrides);
  apply_overrides(document, overrides, problems);
  TomlTable& root = *document.as<TomlTable>();
  TomlValue* cloth = root.find("cloth");
  if (cloth == nullptr || cloth->as<TomlTable>() == nullptr || find_path(*cloth, "motion") == nullptr) return {};
  problems.throw_if_any();
  const std::string own_digest = digest(document, tables_that_affect(TableType::Affects::nothing));
  SceneOfMotion scene{.named = read_named_motion(root, *cloth, file.parent_path(), problems), .look = {}};
  add_stand_ins(document, cloth->place);
  std::vector<std::string> of_look = overrides;
  std::erase_if(of_look, is_of_physics);
  try {
    scene.look = make_scene(document, file, of_look);
  } catch (const UsageError& error) {
    throw UsageError(problems.count() == 0 ? error.what() : problems.text() + "\n" + error.what());
  }
  problems.throw_if_any();
  scene.look.source.inputs.push_back(file);
  if (fs::exists(scene.named.motion)) scene.look.source.inputs.emplace_back(scene.named.motion);
  scene.look.source.digest = own_digest;
  return scene;
}

std::string digest_of_file(const fs::path& file) {
  const std::optional<SceneOfMotion> scene = load_scene_of_motion(file);
  return scene ? scene->look.source.digest : load_scene(file).source.digest;
}

}  // namespace drape
