#include <filesystem>

#include "cli/command_line.hpp"
#include "core/atomic_file.hpp"
#include "manual/completions.hpp"
#include "manual/man_pages.hpp"

namespace drape {
namespace {

ExitCode write_manual(const CLI::App& app, const std::filesystem::path& share) {
  const CommandText drape = describe_command(app);
  const std::vector<TableText> tables = reference_tables();
  const auto write = [&](const std::filesystem::path& file, const std::string& text) {
    write_file_atomically(share / file, text);
  };
  for (const ManPage& page : command_pages(drape)) write("man/man1/" + page.file, page.text);
  const ManPage scenes = scene_page(tables);
  write("man/man5/" + scenes.file, scenes.text);
  write("bash-completion/completions/drape", bash_completion(drape, tables));
  write("zsh/vendor-completions/_drape", zsh_completion(drape, tables));
  write("fish/vendor_completions.d/drape.fish", fish_completion(drape, tables));
  return ExitCode::ok;
}

}  // namespace

void add_manual_command(CLI::App& app, Command& command) {
  auto folder = std::make_shared<std::string>();
  CLI::App* sub = app.add_subcommand("manual", "Write the manual's pages and the shells' completions into a folder");
  sub->group("");  // hidden: used by installation
  sub->add_option("FOLDER", *folder, "Laid out as /usr/share")->required();
  sub->callback([folder, &app, &command] { command = [folder, &app] { return write_manual(app, *folder); }; });
}

}  // namespace drape
