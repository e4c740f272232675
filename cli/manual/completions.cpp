#include "cli/manual/completions.hpp"

#include <algorithm>
#include <filesystem>

namespace drape {
namespace {

namespace fs = std::filesystem;

/// Returns the first clause of a help text, shortened to one line beside a name.
std::string brief(std::string text) {
  text = text.substr(0, text.find_first_of("\n;"));
  text = text.substr(0, text.find(". "));
  std::erase(text, '`');
  if (text.size() > 90) text = text.substr(0, text.rfind(' ', 87)) + " …";
  return text;
}

/// The completions of one word.
class Matches {
 public:
  /// @param word the incomplete word
  /// @param attached the part of the word before the text to complete, "--set="
  Matches(std::string word, std::string attached) : word_(std::move(word)), attached_(std::move(attached)) {}

  void add(const std::string& text, const std::string& help = "") {
    if (text.starts_with(word_)) found_.push_back({attached_ + text, brief(help)});
  }
  void add_all(const std::vector<std::string>& texts) {
    for (const std::string& text : texts) add(text);
  }
  [[nodiscard]] const std::string& word() const { return word_; }
  [[nodiscard]] std::vector<Completion> take() { return std::move(found_); }

 private:
  std::string word_, attached_;
  std::vector<Completion> found_;
};

/// Returns the command that complete words name, "study accuracy", without their options and values.
const CommandText& named_command(const CommandText& drape, const std::vector<std::string>& words) {
  const CommandText* command = &drape;
  for (std::size_t i = 0; i + 1 < words.size(); ++i) {
    const auto next = std::ranges::find(command->subcommands, words[i], &CommandText::word);
    if (next != command->subcommands.end()) command = &*next;
  }
  return *command;
}

/// Returns the option of a command, or of drape itself, that takes a value; null: none of that name.
const OptionText* option_with_value(const CommandText& drape, const CommandText& command, const std::string& name) {
  for (const CommandText* owner : {&command, &drape}) {
    for (const OptionText& option : owner->options) {
      if (!option.positional && !option.value.empty() && std::ranges::count(option.names, name) > 0) return &option;
    }
  }
  return nullptr;
}

void add_options(const CommandText& command, Matches& matches) {
  for (const OptionText& option : command.options) {
    if (!option.positional) matches.add(option.names.back(), option.help);
  }
}

/// Adds keys of a scene, and values of the key before a =.
void add_keys(const std::vector<TableText>& tables, Matches& matches) {
  const bool value = matches.word().find('=') != std::string::npos;
  for (const TableText& table : tables) {
    for (const KeyText& key : table.keys) {
      const std::string path = table.name + "." + key.name + "=";
      if (!value) matches.add(path, key.help);
      for (const std::string& word : key.values) {
        if (value) matches.add(path + word);
      }
    }
  }
}

/// Adds scene files, motions and folders that begin with the word.
void add_scenes(Matches& matches) {
  const std::size_t slash = matches.word().rfind('/');
  const std::string folder = slash == std::string::npos ? "" : matches.word().substr(0, slash + 1);
  std::vector<std::string> names;
  std::error_code unreadable;
  for (const auto& entry : fs::directory_iterator(folder.empty() ? "." : folder, unreadable)) {
    const std::string name = entry.path().filename().string(), type = entry.path().extension().string();
    if (name.starts_with('.') && slash + 1 == matches.word().size()) continue;
    if (entry.is_directory(unreadable)) {
      names.push_back(folder + name + "/");
    } else if (type == ".toml" || type == ".drape") {
      names.push_back(folder + name);
    }
  }
  std::ranges::sort(names);
  matches.add_all(names);
}

}  // namespace

std::vector<Completion> completions(const CommandText& drape, const std::vector<TableText>& tables,
                                    const std::vector<std::string>& words) {
  if (words.empty()) return {};
  const CommandText& command = named_command(drape, words);
  std::string word = words.back(), attached;
  std::string previous = words.size() > 1 ? words[words.size() - 2] : drape.name;
  if (const std::size_t equals = word.find('='); word.starts_with("--") && equals != std::string::npos) {
    previous = word.substr(0, equals);
    attached = previous + "=";
    word = word.substr(equals + 1);
  }
  Matches matches(word, attached);
  if (const OptionText* option = option_with_value(drape, command, previous)) {
    if (option->value == key_and_value) {
      add_keys(tables, matches);
    } else {
      matches.add_all(option->choices);
    }
  } else if (word.starts_with('-')) {
    add_options(command, matches);
    if (&command != &drape) add_options(drape, matches);
  } else if (!command.subcommands.empty()) {
    for (const CommandText& one : command.subcommands) matches.add(one.word(), one.help);
  } else {
    const auto first = std::ranges::find_if(command.options, &OptionText::positional);
    if (first == command.options.end()) return {};
    if (previous == command.word()) matches.add_all(first->choices);
    if (first->names.front() == "SCENE") add_scenes(matches);
  }
  return matches.take();
}

}  // namespace drape
