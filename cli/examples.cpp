#include "cli/examples.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

namespace drape {
namespace {

struct Examples {
  std::string_view command;  ///< "study accuracy"; empty: drape itself
  std::string_view lines;    ///< text after "drape", one line per example
};

constexpr std::array<Examples, 24> all_examples{{
    {"",
     "new flag\n"
     "render flag.toml\n"
     "render flag.toml --set look.color=navy -o navy.mp4\n"
     "help render\n"},
    {"new",
     "new flag\n"
     "new tablecloth table.toml\n"},
    {"render",
     "render scene.toml                                    # out/scene.gif\n"
     "render scene.toml --quality draft --open\n"
     "render scene.toml -o film.mp4 -o frames/{frame:04}.png\n"
     "render scene.toml --set video.fps=50 --frames 100..120\n"
     "render scene.toml -o film.webp --max-size 2MB --poster\n"
     "render motion.drape --set video.speed=0.1 -o slow.mp4\n"},
    {"watch",
     "watch scene.toml\n"
     "watch scene.toml --port 8000 --no-open\n"},
    {"lint",
     "lint scene.toml\n"
     "lint scenes/*.toml\n"},
    {"simulate",
     "simulate scene.toml --energies energies.csv --stats stats.json\n"
     "simulate scene.toml -o meshes/{frame:04}.obj\n"
     "simulate scene.toml -o motion.npz --every 1\n"
     "simulate scene.toml -o motion.drape\n"
     "simulate --resume motion.drape\n"},
    {"compare",
     "compare a.toml b.toml -o ab.gif\n"
     "compare scene.toml --vary integrator.method=liu13,verlet\n"
     "compare a.toml b.toml --difference -o ab.html\n"},
    {"import",
     "import 'meshes/{frame:04}.obj' --fps 30 -o motion.drape\n"
     "import cloth.npz --up y --body 'arm/{frame:04}.obj' -o motion.drape\n"
     "import cache.pc2 --mesh cloth.obj --scale 0.01 -o motion.drape\n"},
    {"audit",
     "audit motion.drape\n"
     "audit scene.toml --max-stretch 1.2 -o audit.html\n"
     "audit scenes/*.toml --steps 100\n"},
    {"sweep",
     "sweep scene.toml --vary cloth.stiffness=10..80/8\n"
     "sweep scene.toml --vary integrator.method=liu13,implicit --film gif\n"},
    {"merge", "merge out/shard-1 out/shard-2 -o out/sweep\n"},
    {"bless",
     "bless scenes/*.toml\n"
     "bless scene.toml --frames 0,40,120\n"},
    {"check",
     "check scenes/*.toml\n"
     "check scenes/*.toml --update none      # in continuous integration\n"
     "check scene.toml --motion-tolerance 1e-5\n"},
    {"accept",
     "accept out/check\n"
     "accept out/check flag --frames 40\n"},
    {"study",
     "study accuracy scene.toml\n"
     "study homework\n"},
    {"study accuracy",
     "study accuracy scene.toml\n"
     "study accuracy scene.toml --methods liu13,quasi-newton --tolerances 1e-2,1e-4\n"
     "study accuracy scene.toml --animate methods -o out/methods\n"},
    {"study homework", "study homework --runs 3 -o out/homework\n"},
    {"study scaling", "study scaling --largest 40\n"},
    {"study stability", "study stability --per-decade 2 -o out/maps\n"},
    {"study validation",
     "study validation\n"
     "study validation pendulum catenary --methods implicit-sdirk2 -o out/two\n"},
    {"validate",
     "validate heavy-cantilever answers.csv\n"
     "validate catenary motion.npz --problem span-1.2\n"},
    {"schema",
     "schema\n"
     "schema -o scene.schema.json\n"},
    {"doctor",
     "doctor\n"
     "doctor --json\n"},
    {"help",
     "help render\n"
     "help study accuracy\n"},
}};

/// Returns the subcommand of this name, such as "study accuracy", or null.
CLI::App* find_subcommand(CLI::App& app, std::string_view name) {
  if (name.empty()) return &app;
  const std::size_t end = std::min(name.find(' '), name.size());
  const auto found = app.get_subcommands([&](const CLI::App* of) { return of->get_name() == name.substr(0, end); });
  if (found.empty()) return nullptr;
  return find_subcommand(*found.front(), name.substr(std::min(end + 1, name.size())));
}

}  // namespace

void add_examples(CLI::App& app) {
  for (const auto& [command, lines] : all_examples) {
    CLI::App* const of = find_subcommand(app, command);
    if (of == nullptr) continue;
    std::string text = "Examples:\n";
    for (std::size_t begin = 0; begin < lines.size();) {
      const std::size_t end = lines.find('\n', begin) + 1;
      text.append("  drape ").append(lines.substr(begin, end - begin));
      begin = end;
    }
    text.pop_back();
    of->footer(text);
  }
}

}  // namespace drape
