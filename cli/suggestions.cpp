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

/// Returns the most specific subcommand that was chosen, or the app itself.
const CLI::App& chosen_command(const CLI::App& app) {
  const std::vector<CLI::App*> chosen = app.get_subcommands();
  return chosen.empty() ? app : chosen_command(*chosen.front());
}

/// Returns the options that may have been intended: those of the app and the chosen subcommand.
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

/// A key of a scene with its table, "caption.size". `pair` means that it takes two whole numbers.
struct NamedKey {
  std::string path;
  bool pair;
};

std::vector<NamedKey> keys_named(std::string name) {
  std::replace(name.begin(), name.end(), '-', '_');
  std::vector<NamedKey> found;
  const auto look = [&](const TableType& table) {
    for (const Key& key : table.keys.all()) {
      if (key.name != name) continue;
      const bool pair = std::holds_alternative<Eigen::Vector2i*>(key.target) ||
                        std::holds_alternative<std::optional<Eigen::Vector2i>*>(key.target);
      found.push_back({table.name + "." + key.name, pair});
    }
  };
  ClothTable cloth;
  Scene scene;
  for (const TableType& table : scene_tables(cloth, scene)) look(table);
  for (const EffectType& type : effect_types()) {
    Effect effect = type.make();
    look(effect_table(type, effect));
  }
  return found;
}

/// Converts "640x480" or "640,480" to a scene's array, "[640,480]"; returns other texts unchanged.
std::string as_pair(const std::string& text) {
  const std::size_t between = text.find_first_of("x,");
  const auto whole = [](std::string_view part) {
    return !part.empty() && part.find_first_not_of("0123456789") == std::string_view::npos;
  };
  if (between == std::string::npos) return text;
  const std::string first = text.substr(0, between), second = text.substr(between + 1);
  return whole(first) && whole(second) ? fmt::format("[{},{}]", first, second) : text;
}

/// Returns "'--set video.fps=30'", quoted for a shell if necessary.
std::string set_option(const std::string& assignment) {
  const std::string word = shell_word(assignment);
  return word == assignment ? fmt::format("'--set {}'", word) : fmt::format("--set {}", word);
}

/// Returns the value given to an option: after its '=', or the next word.
std::string value_of(const std::string& option, std::span<const char* const> words) {
  if (const std::size_t equals = option.find('='); equals != std::string::npos) return option.substr(equals + 1);
  const auto found = std::find(words.begin(), words.end(), option);
  if (found == words.end() || found + 1 == words.end()) return "VALUE";
  const std::string_view next = *(found + 1);
  return next.starts_with("--") ? "VALUE" : std::string(next);
}

/// Returns a hint for an option that is a key of the scene; nothing otherwise, or if the command takes no keys.
std::optional<std::string> key_instead(const CLI::App& app, const std::string& word,
                                       std::span<const char* const> words) {
  if (!word.starts_with("--") || chosen_command(app).get_option_no_throw("--set") == nullptr) return std::nullopt;
  const std::string name = word.substr(0, word.find('='));
  const std::vector<NamedKey> keys = keys_named(name.substr(2));
  if (keys.empty()) return std::nullopt;
  const std::string given = value_of(word, words), pair = as_pair(given);
  const bool is_pair = pair.starts_with("[");
  const auto takes = [is_pair](const NamedKey& key) { return key.pair == is_pair; };
  const bool any = std::ranges::any_of(keys, takes);  // otherwise ignore the form of the value
  constexpr std::size_t most = 3;
  std::size_t told = 0;
  std::string meant;
  for (const NamedKey& key : keys) {
    if ((any && !takes(key)) || told == most) continue;
    const std::string value = key.pair && !is_pair ? "[640,480]" : key.pair ? pair : given;
    meant += (told++ == 0 ? "" : " or ") + set_option(key.path + "=" + value);
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
