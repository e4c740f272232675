#include <fmt/format.h>
#include <spdlog/spdlog.h>
#include <algorithm>
#include <charconv>
#include <memory>
#include <string>
#include <vector>

#include "audit/report/audit_motion.hpp"
#include "cli/command_line.hpp"
#include "cli/inputs.hpp"
#include "cli/options.hpp"
#include "cli/terminal.hpp"
#include "core/console.hpp"
#include "core/files.hpp"
#include "core/text.hpp"
#include "drape/core/error.hpp"
#include "drape/render/image.hpp"
#include "drape/sim/settings.hpp"
#include "motion/import/import_motion.hpp"
#include "output/registry.hpp"
#include "render/gl/context.hpp"
#include "run/outputs.hpp"

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
    spdlog::info(
        "{} frames, {:.6g} s apart, of {} vertices and {} triangles{}", found.frames, found.step, found.vertices,
        found.triangles,
        found.bodies == 0 ? "" : fmt::format(", and {} {}", found.bodies, found.bodies == 1 ? "body" : "bodies"));
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
  complete_command(
      *sub, command, [arguments, &common] { return run_import(*arguments, common); },
      "import 'meshes/{frame:04}.obj' --fps 30 -o motion.drape\n"
      "import cloth.npz --up y --body 'arm/{frame:04}.obj' -o motion.drape\n"
      "import cache.pc2 --mesh cloth.obj --scale 0.01 -o motion.drape");
}

namespace {

struct AuditArguments {
  std::vector<std::string> motions, overrides;
  std::string page, held;
  AuditOptions options;
  double deepest = 1e3 * AuditOptions{}.depth;  // [mm]
  GlBackend backend = GlBackend::automatic;
};

/// Parses "0,19,380" or "none".
/// @throws UsageError for other texts, or a vertex that does not exist
std::vector<int> parse_held(const std::string& text, const Scene& scene) {
  std::vector<int> vertices;
  if (text == "none") return vertices;
  const int count = scene.simulation.cloth.vertex_count();
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    int vertex = -1;
    const char *const first = text.data() + begin, *const last = text.data() + end;
    const auto read = std::from_chars(first, last, vertex);
    if (read.ec != std::errc() || read.ptr != last || vertex < 0 || vertex >= count) {
      throw UsageError(fmt::format("--held: expected vertices from 0 to {} as in 0,19, or none; found '{}'", count - 1,
                                   text.substr(begin, end - begin)));
    }
    vertices.push_back(vertex);
    begin = end + 1;
  }
  return vertices;
}

/// Returns the page of each motion. @throws UsageError if two motions share a page
std::vector<std::string> pages_of(const AuditArguments& arguments, const std::vector<SceneToRun>& motions) {
  std::vector<std::string> pages;
  if (arguments.page.empty()) return std::vector<std::string>(motions.size());
  const PathTemplate path(arguments.page);
  if (path.has_frame() || !arguments.page.ends_with(".html")) {
    throw UsageError(fmt::format("-o {}: expected a page's name, such as audit.html", arguments.page));
  }
  for (const SceneToRun& motion : motions) {
    pages.push_back(path.path(motion.scene.name, 0, 1));
    if (std::ranges::count(pages, pages.back()) > 1) {
      throw UsageError(fmt::format("-o {}: several motions need a name with {{scene}} in it", arguments.page));
    }
    require_writable(pages.back());
    require_texture(motion.scene, inspect_backend(arguments.backend).max_texture_size);
  }
  return pages;
}

ExitCode audit_one(const AuditArguments& arguments, const SceneToRun& motion, const std::string& page,
                   const CommonOptions& common) {
  AuditOptions options = arguments.options;
  if (motion.recorded) require_steps(shown(motion.scene.source.file), motion.recorded->last_step(), options.steps);
  if (!arguments.held.empty()) options.held = parse_held(arguments.held, motion.scene);
  std::optional<AuditReport> found;
  run_watched(common.quiet, [&](const std::stop_token& stop, Progress& progress) {
    found.emplace(audit_motion(motion.scene, motion.recorded, options, stop, progress));
    if (page.empty()) return;
    write_file_atomically(page,
                          audit_page(*found, draw_findings(motion.scene, *found, arguments.backend), common.command));
  });
  const AuditReport& report = *found;
  if (!common.quiet || !report.clean()) {
    print_text(stdout, to_text(audit_table(report), terminal(stdout, common.color).width) + "\n");
  }
  if (!common.quiet) {
    print_text(stdout, audit_summary(report) + "\n" + (page.empty() ? "" : shown(page) + "\n"));
  }
  ExitCode code = report.clean() ? ExitCode::ok : ExitCode::differs;
  if (!report.divergence.empty()) {
    spdlog::error("{}: {}", report.file, report.divergence);
    code = ExitCode::diverged;
  }
  if (!report.interrupted) return code;
  spdlog::error("interrupted after {} states of {}", report.findings.states(), report.file);
  return ExitCode::interrupted;
}

ExitCode run_audit(const AuditArguments& arguments, const CommonOptions& common) {
  interruption();
  std::vector<SceneToRun> motions;
  SceneProblems problems;
  for (const std::string& file : arguments.motions) {
    try {
      motions.push_back(open_scene(file, arguments.overrides));
    } catch (const UsageError& error) {
      problems.add(file, error.what());
    }
  }
  problems.throw_if_any(arguments.motions);
  const std::vector<std::string> pages = pages_of(arguments, motions);
  ExitCode worst = ExitCode::ok;
  for (std::size_t i = 0; i < motions.size() && !interruption().stop_requested(); ++i) {
    worst = std::max(worst, reported([&] { return audit_one(arguments, motions[i], pages[i], common); }));
    motions[i].recorded.reset();
  }
  return worst;
}

}  // namespace

void add_audit_command(CLI::App& app, const CommonOptions& common, Command& command) {
  auto arguments = std::make_shared<AuditArguments>();
  CLI::App* sub = app.add_subcommand("audit", "Check motions exactly for what crosses, stretches or sticks");
  sub->add_option("MOTION", arguments->motions,
                  "Motions: .drape, or what drape import reads; or scene files (TOML), which are simulated\nExits with "
                  "1 where something is found")
      ->required();
  sub->add_option("-o,--output", arguments->page,
                  "Page of the audit with the worst states drawn: audit.html, or {scene}.html for several motions")
      ->check(on_one_line())
      ->allow_extra_args(false);
  sub->add_option("--max-stretch", arguments->options.stretch,
                  "Longest length of an edge, by that at rest; default the scene's strain limit, if it has one")
      ->check(number_in({.minimum = 1}));
  sub->add_option("--max-depth", arguments->deepest,
                  fmt::format("Greatest depth of a vertex in a body, a sphere or a ground, in mm; default {:g}",
                              arguments->deepest))
      ->check(number_in({.minimum = 0}));
  sub->add_option("--held", arguments->held,
                  "Vertices that may stand still in mid-air: 0,19 or none; default the scene's pins");
  sub->add_option("--steps", arguments->options.steps, "Audit this many steps instead of the whole motion")
      ->check(whole_number_in({0, 1e9}));
  sub->add_option("--set", arguments->overrides, "Override a value of all scenes: key.path=value; repeatable")
      ->allow_extra_args(false);
  add_backend_option(*sub, arguments->backend);
  complete_command(
      *sub, command,
      [arguments, &common] {
        arguments->options.depth = 1e-3 * arguments->deepest;
        return run_audit(*arguments, common);
      },
      "audit motion.drape\n"
      "audit scene.toml --max-stretch 1.2 -o audit.html\n"
      "audit scenes/*.toml --steps 100");
}

}  // namespace drape
