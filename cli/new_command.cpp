#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "cli/command_line.hpp"
#include "cli/terminal.hpp"
#include "core/atomic_file.hpp"
#include "core/error.hpp"
#include "core/nearest.hpp"
#include "core/read_file.hpp"
#include "core/shell.hpp"
#include "core/text.hpp"
#include "scene/scene.hpp"

namespace drape {
namespace {

namespace fs = std::filesystem;

const std::vector<std::string> scene_kinds{"flag", "tablecloth", "curtain", "hanging", "garment"};

/// Returns the text of a first scene; its first line refers editors to the schema.
std::string first_scene(const std::string& kind) {
  constexpr std::size_t most_bytes = 1 << 16;
  const fs::path scenes = data_folder() / "scenes";
  const std::string text = read_file(scenes / "new" / (kind + ".toml"), most_bytes);
  const fs::path schema = fs::absolute(scenes / "scene.schema.json").lexically_normal();
  return "#:schema " + schema.string() + text.substr(text.find('\n'));
}

ExitCode write_scene(const std::string& kind, std::string file, bool quiet) {
  if (std::ranges::find(scene_kinds, kind) == scene_kinds.end()) {
    throw UsageError(fmt::format("drape new: unknown '{}'{}", kind, did_you_mean(kind, scene_kinds, "there are")));
  }
  if (file.empty()) file = kind + ".toml";
  std::error_code ignored;
  if (fs::is_directory(file, ignored)) file = (fs::path(file) / (kind + ".toml")).string();
  if (fs::exists(file, ignored)) throw UsageError(fmt::format("{} exists already: give another name", shown(file)));
  write_file_atomically(file, first_scene(kind));
  if (!quiet) {
    print_wrapped(stdout, fmt::format("{0} is written. Draw it: drape render {1}\nWatch it change as you edit it: "
                                      "drape watch {1}\n",
                                      shown(file), shell_file(file)));
  }
  return ExitCode::ok;
}

}  // namespace

void add_new_command(CLI::App& app, const CommonOptions& common, Command& command) {
  auto kind = std::make_shared<std::string>(), file = std::make_shared<std::string>();
  CLI::App* sub = app.add_subcommand("new", "Write a commented scene to begin with");
  sub->add_option("KIND", *kind, fmt::format("{}", fmt::join(scene_kinds, ", ")))
      ->required()
      ->type_name(fmt::format("{}", fmt::join(scene_kinds, "|")));
  sub->add_option("FILE", *file, "Scene file to write; default KIND.toml");
  sub->callback([kind, file, &common, &command] {
    command = [kind, file, &common] { return write_scene(*kind, *file, common.quiet); };
  });
}

}  // namespace drape
