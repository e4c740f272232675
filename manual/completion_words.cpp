#include "manual/completion_words.hpp"

#include <algorithm>

namespace drape {

void each_command(const CommandText& command, const std::function<void(const CommandText&)>& visit) {
  visit(command);
  for (const CommandText& one : command.subcommands) each_command(one, visit);
}

void each_key(const std::vector<TableText>& tables,
              const std::function<void(const std::string&, const KeyText&)>& visit) {
  for (const TableText& table : tables) {
    for (const KeyText& key : table.keys) visit(table.name + "." + key.name, key);
  }
}

std::vector<std::string> option_names(const CommandText& command) {
  std::vector<std::string> names;
  for (const OptionText& option : command.options) {
    if (!option.positional) names.push_back(option.names.back());
  }
  return names;
}

std::vector<std::string> subcommand_words(const CommandText& command) {
  std::vector<std::string> words;
  for (const CommandText& one : command.subcommands) words.push_back(one.word());
  return words;
}

std::vector<std::string> first_words(const CommandText& command) {
  const auto first = std::ranges::find_if(command.options, &OptionText::positional);
  return first == command.options.end() ? std::vector<std::string>() : first->choices;
}

bool takes_scenes(const CommandText& command) {
  return std::ranges::any_of(command.options,
                             [](const OptionText& o) { return o.positional && o.names.front() == "SCENE"; });
}

std::string brief(std::string text) {
  text = text.substr(0, text.find_first_of("\n;"));
  text = text.substr(0, text.find(". "));
  std::erase(text, '`');
  if (text.size() > 90) text = text.substr(0, text.rfind(' ', 87)) + " …";
  return text;
}

std::string single_quoted(const std::string& text, std::string_view special, const char* apostrophe) {
  std::string result = "'";
  for (const char c : text) {
    if (c == '\'') {
      result += apostrophe;
      continue;
    }
    if (special.find(c) != std::string_view::npos) result += '\\';
    result += c;
  }
  return result + "'";
}

}  // namespace drape
