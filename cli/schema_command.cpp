#include <memory>
#include <string>

#include "cli/command_line.hpp"
#include "core/atomic_file.hpp"
#include "core/console.hpp"
#include "manual/scene_schema.hpp"

namespace drape {

void add_schema_command(CLI::App& app, Command& command) {
  auto file = std::make_shared<std::string>();
  CLI::App* sub = app.add_subcommand("schema", "Print a JSON schema of scene files, for editors");
  sub->add_option("-o,--output", *file, "Write it to this file instead");
  sub->callback([file, &command] {
    command = [file] {
      if (file->empty()) {
        print_text(stdout, scene_schema());
      } else {
        write_file_atomically(*file, scene_schema());
      }
      return ExitCode::ok;
    };
  });
}

}  // namespace drape
