#include "manual/command_text.hpp"

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

}  // namespace drape
