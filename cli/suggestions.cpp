#include "cli/suggestions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string_view>
#include <vector>

#include "core/error.hpp"
#include "core/nearest.hpp"
#include "core/shell.hpp"
#include "scene/tables.hpp"

namespace drape {
namespace {

/// The subcommand that was chosen, and what was chosen of its own; the app itself where there is none.
const CLI::App& chosen_command(const CLI::App& app) {
  const std::vector<CLI::App*> chosen = app.get_subcommands();
  return chosen.empty() ? app : chosen_command(*chosen.front());
}

/// The words that could have been meant at the place where parsing stopped: the options of the chosen subcommand.
std::vector<std::string> known_options(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* of : {&app, &chosen_command(app)}) {
    for (const CLI::Option* option : of->get_options()) {
      for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
    }
  }
  std::sort(names.begin(), names.end());
  names.erase(std::unique(names.begin(), names.end()), names.end());
  return names;
}

std::vector<std::string> subcommand_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* subcommand : app.get_subcommands(nullptr)) {
    if (!subcommand->get_group().empty()) names.push_back(subcommand->get_name());
  }
  return names;
}

/// The keys of a scene that have this name, with their tables: "video.size", "caption.size".
std::vector<std::string> keys_named(std::string name) {
  std::replace(name.begin(), name.end(), '-', '_');
  std::vector<std::string> paths;
  const auto look = [&](const TableType& table) {
    for (const Key& key : table.keys.all()) {
      if (key.name == name) paths.push_back(table.name + "." + key.name);
    }
  };
  ClothTable cloth;
  Scene scene;
  for (const TableType& table : scene_tables(cloth, scene)) look(table);
  for (const EffectType& type : effect_types()) {
    Effect effect = type.make();
    look(effect_table(type, effect));
  }
  return paths;
}

/// What was given to an option: behind its '=', or the word after it.
std::string value_of(const std::string& option, std::span<const char* const> words) {
  if (const std::size_t equals = option.find('='); equals != std::string::npos) return option.substr(equals + 1);
  const auto found = std::find(words.begin(), words.end(), option);
  if (found == words.end() || found + 1 == words.end()) return "VALUE";
  const std::string_view next = *(found + 1);
  return next.starts_with("--") ? "VALUE" : std::string(next);
}

/// What to say of an option that is a key of the scene; nothing if it is none, or if the command takes no keys.
std::optional<std::string> key_instead(const CLI::App& app, const std::string& word,
                                       std::span<const char* const> words) {
  if (!word.starts_with("--") || chosen_command(app).get_option_no_throw("--set") == nullptr) return std::nullopt;
  const std::string name = word.substr(0, word.find('='));
  const std::vector<std::string> paths = keys_named(name.substr(2));
  if (paths.empty()) return std::nullopt;
  constexpr std::size_t most = 3;
  std::string meant;
  for (std::size_t i = 0; i < std::min(paths.size(), most); ++i) {
    meant += fmt::format("{}'--set {}'", i == 0 ? "" : " or ", shell_word(paths[i] + "=" + value_of(word, words)));
  }
  return fmt::format("'{}' is a key of the scene, not an option; did you mean {}?", name, meant);
}

}  // namespace

std::string explain(const CLI::App& app, const CLI::ParseError& error, std::span<const char* const> words) {
  const std::vector<std::string> extras = app.remaining(true);
  if (extras.empty()) return fmt::format("{}; see drape help", error.what());
  const std::string& word = extras.front();
  if (word.starts_with("-")) {
    if (const auto key = key_instead(app, word, words)) return *key;
    return "unknown option '" + word + "'" + did_you_mean(word, known_options(app), "options");
  }
  const bool scene = word.ends_with(".toml"), motion = word.ends_with(".drape");
  if ((scene || motion) && app.get_subcommands().empty()) {
    return fmt::format("'{}' is a {}, not a command; did you mean 'drape render {}'?", word, scene ? "scene" : "motion",
                       shell_word(word));
  }
  return "unknown command '" + word + "'" + did_you_mean(word, subcommand_names(app), "commands");
}

const CLI::App& find_command(const CLI::App& app, std::span<const std::string> names) {
  if (names.empty()) return app;
  for (const CLI::App* subcommand : app.get_subcommands(nullptr)) {
    if (subcommand->get_name() == names.front()) return find_command(*subcommand, names.subspan(1));
  }
  throw UsageError("unknown command '" + names.front() + "'" +
                   did_you_mean(names.front(), subcommand_names(app), "commands"));
}

}  // namespace drape
