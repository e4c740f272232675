#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <memory>
#include <string>
#include <vector>

#include "cli/command_line.hpp"
#include "cli/interruption.hpp"
#include "cli/number_option.hpp"
#include "cli/open_file.hpp"
#include "cli/quality_option.hpp"
#include "cli/summary.hpp"
#include "core/console.hpp"
#include "core/error.hpp"
#include "core/text.hpp"
#include "render/gl/inspect.hpp"
#include "watch/server.hpp"
#include "watch/session.hpp"

namespace drape {
namespace {

struct WatchArguments {
  std::string scene;
  std::vector<std::string> overrides, quality;
  int port = 0;
  bool hidden = false;
  GlBackend backend = GlBackend::automatic;
};

ExitCode watch(const WatchArguments& arguments, const CommonOptions& common) {
  const std::stop_token stop = interruption().get_token();
  if (!std::filesystem::is_regular_file(arguments.scene)) {
    throw UsageError(fmt::format("{}: there is no such file", shown(arguments.scene)));
  }
  inspect_backend(arguments.backend);
  std::vector<std::string> overrides =
      arguments.quality.empty() ? std::vector<std::string>{"look.quality=draft"} : arguments.quality;
  overrides.insert(overrides.end(), arguments.overrides.begin(), arguments.overrides.end());
  WatchSession session(arguments.scene, overrides, arguments.backend,
                       [](const Scene& scene, const RunOptions& options) { return describe(scene, options); });
  const WatchServer server(session, arguments.port);
  print_text(stdout, fmt::format("{}\n", server.address()));
  if (!common.quiet)
    spdlog::info("shows {} in a browser, and draws it anew when it is saved; Ctrl-C ends this", shown(arguments.scene));
  if (!arguments.hidden) open_file(server.address());
  session.run(stop);
  return ExitCode::interrupted;
}

}  // namespace

void add_watch_command(CLI::App& app, const CommonOptions& common, Command& command) {
  auto arguments = std::make_shared<WatchArguments>();
  CLI::App* sub = app.add_subcommand("watch", "Show a scene's film in a browser, drawn anew whenever it is saved");
  sub->add_option("SCENE", arguments->scene, "Scene file (TOML)")->required();
  sub->add_option("--set", arguments->overrides, "Override a value of the scene: key.path=value; repeatable")
      ->allow_extra_args(false);
  add_quality_option(*sub, arguments->quality);
  sub->add_option("--port", arguments->port, "Port on 127.0.0.1; default any that is free")
      ->check(whole_number_in({0, 65535}));
  sub->add_flag("--no-open", arguments->hidden, "Only print the address of the page");
  add_backend_option(*sub, arguments->backend);
  sub->callback(
      [arguments, &common, &command] { command = [arguments, &common] { return watch(*arguments, common); }; });
}

}  // namespace drape
