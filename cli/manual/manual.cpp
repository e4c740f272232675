#include "cli/manual/manual.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <filesystem>
#include <string_view>

#include "core/installation.hpp"

namespace drape {
namespace {

std::vector<std::string> words_between(const std::string& text, char separator) {
  std::vector<std::string> words;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(separator, begin), text.size());
    words.push_back(text.substr(begin, end - begin));
    begin = end + 1;
  }
  return words;
}

OptionText describe_option(const CLI::Option& option) {
  OptionText text;
  text.help = option.get_description();
  text.required = option.get_required();
  text.repeatable = option.get_items_expected_max() > 1;
  text.positional = option.get_positional();
  if (text.positional) {
    text.names = {option.get_name(true)};
    if (option.get_type_name().find('|') != std::string::npos)
      text.choices = words_between(option.get_type_name(), '|');
    return text;
  }
  for (const std::string& name : option.get_snames()) text.names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) text.names.push_back("--" + name);
  if (option.get_items_expected_max() == 0) return text;
  text.value = option.get_type_name();
  if (text.value.find('|') != std::string::npos) text.choices = words_between(text.value, '|');
  return text;
}

CommandText describe(const CLI::App& app, const std::string& before) {
  CommandText text;
  text.name = before + app.get_name();
  text.help = app.get_description();
  text.examples = app.get_footer();
  for (const CLI::Option* option : app.get_options()) {
    if (!option->get_group().empty()) text.options.push_back(describe_option(*option));
  }
  for (const CLI::App* subcommand : app.get_subcommands(nullptr)) {
    if (!subcommand->get_group().empty()) text.subcommands.push_back(describe(*subcommand, text.name + " "));
  }
  return text;
}

}  // namespace

CommandText describe_command(const CLI::App& app) { return describe(app, ""); }

namespace {

/// Escapes text for man, where a dot or an apostrophe at the start of a line begins a macro.
std::string escaped(std::string_view text) {
  std::string result;
  bool line_begins = true;
  for (const char c : text) {
    if (line_begins && (c == '.' || c == '\'')) result += "\\&";
    line_begins = c == '\n';
    if (c == '\\') {
      result += "\\e";
    } else if (c == '-') {
      result += "\\-";  // otherwise it may become a hyphen, which is wrong when copied into a shell
    } else {
      result += c;
    }
  }
  return result;
}

std::string bold(std::string_view text) { return fmt::format("\\fB{}\\fR", escaped(text)); }
std::string italic(std::string_view text) { return fmt::format("\\fI{}\\fR", escaped(text)); }

/// Returns text with line breaks preserved.
std::string lines(std::string_view text) {
  std::string result = escaped(text);
  for (std::size_t at = 0; (at = result.find('\n', at)) != std::string::npos; at += 5) result.replace(at, 1, "\n.br\n");
  return result;
}

/// Converts Markdown: `code` becomes bold; a [link](there) keeps only its text.
std::string from_markdown(std::string_view text) {
  std::string result;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t code = text[at] == '`' ? text.find('`', at + 1) : std::string_view::npos;
    const std::size_t middle = text[at] == '[' ? text.find("](", at) : std::string_view::npos;
    const std::size_t end = middle == std::string_view::npos ? middle : text.find(')', middle);
    if (code != std::string_view::npos) {
      result += bold(text.substr(at + 1, code - at - 1));
      at = code + 1;
    } else if (end != std::string_view::npos) {
      result += escaped(text.substr(at + 1, middle - at - 1));
      at = end + 1;
    } else {
      const std::size_t next = std::min(text.find_first_of("`[", at + 1), text.size());
      result += escaped(text.substr(at, next - at));
      at = next;
    }
  }
  return result;
}

std::string dashed(std::string name) {
  std::ranges::replace(name, ' ', '-');
  return name;
}

std::string upper(std::string text) {
  std::ranges::transform(text, text.begin(),
                         [](char c) { return c >= 'a' && c <= 'z' ? static_cast<char>(c - 32) : c; });
  return text;
}

/// Returns the start of a page: title, name and short description.
std::string head(const std::string& name, int section, const std::string& help, const std::string& manual) {
  std::string what = help.substr(0, help.find('\n'));
  if (what.ends_with('.')) what.pop_back();
  return fmt::format(".TH {} {} \"{}\" \"drape {}\" \"{}\"\n.ad l\n.nh\n.SH NAME\n{} \\- {}\n", upper(escaped(name)),
                     section, build_info().date, build_info().version, manual, escaped(name), escaped(what));
}

std::string reference(const std::string& name, int section) { return fmt::format("{}({})", bold(name), section); }

/// Returns an option as in a synopsis: [--set KEY=VALUE].
std::string in_synopsis(const OptionText& option) {
  std::string text = option.positional ? italic(option.names.front()) : bold(option.names.back());
  if (!option.value.empty()) text += "\\ " + italic(option.value);
  if (!option.required) text = "[" + text + "]";
  return text + (option.repeatable ? "\\ ..." : "");
}

std::string synopsis(const CommandText& command) {
  std::string text = bold(command.name);
  for (const bool positional : {false, true}) {
    for (const OptionText& option : command.options) {
      if (option.positional == positional && option.names.back() != "--help") text += "\n" + in_synopsis(option);
    }
  }
  if (!command.subcommands.empty()) text += "\n" + italic("COMMAND") + " ...";
  return ".SH SYNOPSIS\n" + text + "\n";
}

std::string option_entry(const OptionText& option) {
  std::string names;
  for (const std::string& name : option.names) {
    names += (names.empty() ? "" : ", ") + (option.positional ? italic(name) : bold(name));
  }
  if (!option.value.empty()) names += " " + italic(option.value);
  return fmt::format(".TP\n{}\n{}\n", names, lines(option.help));
}

std::string options(const CommandText& command) {
  std::string text = ".SH OPTIONS\n";
  for (const OptionText& option : command.options) text += option_entry(option);
  return text;
}

std::string commands(const CommandText& command) {
  std::string text = ".SH COMMANDS\n";
  for (const CommandText& one : command.subcommands) {
    text += fmt::format(".TP\n{}\n{}\n", reference(dashed(one.name), 1), lines(one.help));
  }
  return text;
}

std::string examples(const CommandText& command) {
  if (command.examples.empty()) return {};
  constexpr std::string_view heading = "Examples:\n";  // the page has its own heading
  const std::string_view text = command.examples;
  return ".SH EXAMPLES\n.nf\n" + escaped(text.starts_with(heading) ? text.substr(heading.size()) : text) + "\n.fi\n";
}

constexpr const char* exit_status =
    ".SH EXIT STATUS\n"
    ".TP\n0\nAll is well.\n"
    ".TP\n1\nPictures or motions differ from the golden ones.\n"
    ".TP\n2\nThe command line, a scene or a file is wrong, or the system lacks something.\n"
    ".TP\n3\nA simulation diverged.\n"
    ".TP\n4\nSomething could not be drawn, encoded or written.\n"
    ".TP\n130\nInterrupted; partial results are kept.\n";

constexpr const char* surroundings =
    ".SH ENVIRONMENT\n"
    ".TP\n\\fBDRAPE_DATA\\fR\nThe folder with shaders, textures and scenes, instead of the installed one.\n"
    ".TP\n\\fBDRAPE_ISA\\fR\nThe best instruction set to use: sse2, avx2 or avx512; neon on ARM. The results are the "
    "same to the bit.\n";

std::string see_also(const CommandText& drape, const CommandText& command) {
  std::string text = ".SH SEE ALSO\n";
  if (&command != &drape) text += reference("drape", 1) + ",\n";
  for (const CommandText& one : command.subcommands) text += reference(dashed(one.name), 1) + ",\n";
  return text + reference("drape-scene", 5) + "\n";
}

void add_pages(const CommandText& drape, const CommandText& command, std::vector<ManPage>& pages) {
  const std::string name = dashed(command.name);
  std::string text = head(name, 1, command.help, "User Commands") + synopsis(command);
  text += ".SH DESCRIPTION\n" + lines(command.help) + (command.help.ends_with('.') ? "\n" : ".\n");
  if (!command.subcommands.empty()) text += commands(command);
  text += options(command) + examples(command);
  if (&command == &drape) text += std::string(exit_status) + surroundings;
  pages.push_back({name + ".1", text + see_also(drape, command)});
  for (const CommandText& one : command.subcommands) add_pages(drape, one, pages);
}

std::string key_entry(const KeyText& key) {
  std::string text = fmt::format(".TP\n{} = {}\n", bold(key.name), italic(key.form));
  text += from_markdown(key.help);
  if (!key.unit.empty()) text += fmt::format("\n[{}]", escaped(key.unit));
  if (key.required) {
    text += "\nRequired";
    for (std::size_t i = 0; i < key.alternatives.size(); ++i) {
      text += (i == 0 ? " without " : " or ") + bold(key.alternatives[i]);
    }
    text += ".";
  } else if (!key.initial.empty()) {
    text += "\nDefault: " + bold(key.initial);
  }
  return text + "\n";
}

}  // namespace

std::vector<ManPage> command_pages(const CommandText& drape) {
  std::vector<ManPage> pages;
  add_pages(drape, drape, pages);
  return pages;
}

ManPage scene_page(const std::vector<TableText>& tables) {
  std::string text = head("drape-scene", 5, "scenes of drape: cloth, what acts on it, and its film", "File Formats");
  text +=
      ".SH DESCRIPTION\n"
      "A scene is a TOML file. Lengths are in metres, masses in kilograms, times in seconds, angles in degrees; z "
      "points\n"
      "upwards. Nothing in a file is ignored: what is unknown or out of range is an error with line and column.\n"
      ".SH EXAMPLE\n.nf\n"
      "[cloth]\nmesh = { grid = [20, 20] }\nstiffness = 180\npins = [\"corner:x\\-y\\-\", \"corner:x+y\\-\"]\n\n"
      "[time]\nstep = 0.02\nduration = 5\n\n[effects.gravity]\n.fi\n"
      ".SH TABLES\n";
  for (const TableText& table : tables) {
    text += fmt::format(".SS [{}]\n", escaped(table.name));
    if (table.repeatable) text += fmt::format("May be there several times, as {}.\n", bold("[[" + table.name + "]]"));
    if (!table.help.empty()) text += from_markdown(table.help) + "\n";
    for (const KeyText& key : table.keys) text += key_entry(key);
  }
  return {"drape-scene.5",
          text + ".SH SEE ALSO\n" + reference("drape", 1) + ",\n" + reference("drape-render", 1) +
              "\n.PP\nThe pages in \\fI/usr/share/doc/drape/docs\\fR explain the values, with figures.\n"};
}

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
