#include <fmt/format.h>
#include <spdlog/spdlog.h>

#include <memory>
#include <string>

#include "cli/background_work.hpp"
#include "cli/command_line.hpp"
#include "cli/interruption.hpp"
#include "cli/line_option.hpp"
#include "cli/motion_runs.hpp"
#include "cli/number_option.hpp"
#include "core/atomic_file.hpp"
#include "core/console.hpp"
#include "core/error.hpp"
#include "core/text.hpp"
#include "import/import_motion.hpp"
#include "sim/stop.hpp"

namespace drape {
namespace {

struct ImportArguments {
  ImportOptions options;
  std::string output, up = "z";
};

ExitCode run_import(const ImportArguments& arguments, const CommonOptions& common) {
  interruption();
  if (!is_motion_file(arguments.output)) {
    throw UsageError(fmt::format("-o {}: expected the name of a motion file, as in motion.drape", arguments.output));
  }
  ImportOptions options = arguments.options;
  options.axes.y_up = arguments.up == "y";
  require_writable(arguments.output);
  ImportedMotion found;
  try {
    run_watched(common.quiet, [&](const std::stop_token& stop, Progress& progress) {
      found = import_motion(options, arguments.output, stop, progress);
    });
  } catch (const Interrupted&) {
    spdlog::error("interrupted: nothing was written");
    return ExitCode::interrupted;
  }
  if (!common.quiet) {
    spdlog::info("{} frames, {:.6g} s apart, of {} vertices and {} triangles{}", found.frames, found.step,
                 found.vertices, found.triangles,
                 found.bodies == 0 ? "" : fmt::format(", and {} bodies", found.bodies));
    print_text(stdout,
               fmt::format("{} ({:.1f} MB)\n", shown(arguments.output), 1e-6 * static_cast<double>(found.size)));
  }
  return ExitCode::ok;
}

}  // namespace

void add_import_command(CLI::App& app, const CommonOptions& common, Command& command) {
  auto arguments = std::make_shared<ImportArguments>();
  ImportOptions& options = arguments->options;
  CLI::App* sub = app.add_subcommand("import", "Make a motion file of a motion that another program has made");
  const auto one_each = [](CLI::Option* option) { option->allow_extra_args(false); };
  sub->add_option(
         "MOTION", options.cloths,
         "Sequences of meshes, as in 'meshes/{frame:04}.obj' (.obj, .ply, .vtp, .vtu, .vtk), or a .npz, .pc2, .pvd "
         "or .usda; several cloths become one mesh")
      ->required();
  one_each(
      sub->add_option("-o,--output", arguments->output, "Motion file: motion.drape")->required()->check(on_one_line()));
  one_each(sub->add_option("--body", options.bodies,
                           "Something that the cloth may touch, in the same formats: one mesh, or one for each frame; "
                           "repeatable"));
  sub->add_option("--fps", options.fps, "Frames per second; default the times that the files say, or else 25")
      ->check(number_in({.minimum = 1e-3, .maximum = 1e6}));
  sub->add_option("--up", arguments->up, "Axis that points up in the files; default z. A USD file says it itself")
      ->check(CLI::IsMember({"y", "z"}));
  sub->add_option("--scale", options.axes.scale, "Metres of a unit of the files; default 1")
      ->check(number_in({.minimum = 1e-9, .maximum = 1e9}));
  sub->add_option("--mesh", options.mesh, "Mesh of a .pc2; default the .obj of the same name");
  sub->add_option("--prim", options.prim, "Mesh of a USD file, such as /World/cloth");
  sub->callback(
      [arguments, &common, &command] { command = [arguments, &common] { return run_import(*arguments, common); }; });
}

}  // namespace drape
