#include <cholmod.h>
#include <dlfcn.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "cli/command_line.hpp"
#include "core/console.hpp"
#include "core/files.hpp"
#include "core/installation.hpp"
#include "core/machine.hpp"
#include "drape/core/error.hpp"
#include "drape/render/overlay/pen.hpp"
#include "drape/render/renderer.hpp"
#include "drape/render/settings.hpp"
#include "drape/scene/scene.hpp"
#include "drape/sim/mesh.hpp"
#include "output/codecs/codecs.hpp"
#include "output/registry.hpp"
#include "render/gl/context.hpp"
#include "reports/diagram_files.hpp"
#include "sim/kernels/kernels.hpp"

namespace drape {
namespace {

using Json = nlohmann::ordered_json;

/// A component that drape uses, with the result of its check.
struct Finding {
  std::string name;      ///< "egl", ".mp4", "fonts"
  std::string detail;    ///< result: "H.264", "DejaVuSans"
  std::string problem;   ///< empty if it works
  std::string packages;  ///< Debian packages that provide it, separated by spaces

  [[nodiscard]] bool works() const { return problem.empty(); }
};

/// An OpenGL backend and its properties if it works.
struct BackendFinding : Finding {
  GlFacts facts;
};

/// The environment of drape on this machine.
struct Diagnosis {
  BuildInfo build;
  MachineFacts machine;
  std::vector<std::pair<std::string, std::string>> environment;  ///< environment variables that affect drape, if set

  std::vector<std::string> kernels;           ///< instruction sets with code in drape
  std::vector<std::string> runnable_kernels;  ///< those supported by this processor
  Finding chosen_kernels;                     ///< detail: the selected one
  Finding blas;                               ///< detail: the file, and its own description
  std::string cholmod;                        ///< version

  std::vector<BackendFinding> backends;
  Finding drawing;                ///< detail: the backend selected by --backend auto; works if a test picture is right
  Finding codecs;                 ///< detail: the encoding and decoding module
  std::vector<Finding> outputs;   ///< film formats
  std::vector<Finding> optional;  ///< components of some commands only

  /// Returns the packages to install, each once; empty if everything works.
  [[nodiscard]] std::vector<std::string> missing_packages() const;
};

std::string line(const std::string& name, const std::string& text) { return fmt::format("  {:<16} {}\n", name, text); }

std::string line(const Finding& finding) {
  if (finding.works()) return line(finding.name, finding.detail);
  std::string text = "PROBLEM: " + finding.problem;
  for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; ++at) text.replace(at, 1, "; ");
  return line(finding.name, text);
}

std::string limits(const GlFacts& facts) {
  return fmt::format("{} samples per pixel, textures up to {}², pictures up to {}²", facts.max_samples,
                     facts.max_texture_size, facts.max_picture_size);
}

std::string to_text(const Diagnosis& d) {
  std::string text =
      fmt::format("drape {} ({}, {}, {})\n", d.build.version, d.build.revision, d.build.compiler, d.build.type);
  text += "\nmachine\n";
  text += line("processor", fmt::format("{}, {} threads, {:.1f} GB", d.machine.processor, d.machine.threads,
                                        static_cast<double>(d.machine.memory) / 1e9));
  text += line("flags", fmt::format("{}", fmt::join(d.machine.flags, " ")));
  text += line("system", d.machine.system);
  for (const auto& [name, value] : d.environment) text += line(name, "set to \"" + value + "\"");

  text += "\nsimulation\n";
  text += d.chosen_kernels.works()
              ? line("instruction set", fmt::format("{} (runs here: {}; DRAPE_ISA caps the choice)",
                                                    d.chosen_kernels.detail, fmt::join(d.runnable_kernels, ", ")))
              : line(d.chosen_kernels);
  text += line(d.blas) + line("CHOLMOD", d.cholmod);

  text += "\ndrawing\n";
  text +=
      d.drawing.works() ? line("--backend auto", d.drawing.detail + ": the test picture is correct") : line(d.drawing);
  for (const BackendFinding& backend : d.backends) {
    text += line(backend);
    if (backend.works()) text += line("", limits(backend.facts));
  }

  text += "\noutputs\n" + line(d.codecs);
  for (const Finding& output : d.outputs) text += line(output);
  text += "\ncaptions and drape study\n";
  for (const Finding& finding : d.optional) text += line(finding);

  const std::vector<std::string> missing = d.missing_packages();
  if (missing.empty()) return text + "\nNothing is missing.\n";
  return text + fmt::format("\nTo install what is missing:\n  apt-get install --no-install-recommends {}\n",
                            fmt::join(missing, " "));
}

Json to_json(const Finding& finding) {
  Json json{{"name", finding.name}, {"works", finding.works()}};
  if (!finding.detail.empty()) json["detail"] = finding.detail;
  if (!finding.works()) json["problem"] = finding.problem;
  if (!finding.works() && !finding.packages.empty()) json["packages"] = finding.packages;
  return json;
}

Json to_json(const std::vector<Finding>& findings) {
  Json array = Json::array();
  for (const Finding& finding : findings) array.push_back(to_json(finding));
  return array;
}

Json to_json(const BackendFinding& backend) {
  Json json = to_json(static_cast<const Finding&>(backend));
  if (!backend.works()) return json;
  const GlFacts& f = backend.facts;
  json.update({{"renderer", f.renderer},
               {"vendor", f.vendor},
               {"version", f.version},
               {"shading_language", f.shading_language},
               {"max_samples", f.max_samples},
               {"max_texture_size", f.max_texture_size},
               {"max_picture_size", f.max_picture_size}});
  return json;
}

Json to_json(const Diagnosis& d) {
  Json backends = Json::array(), environment = Json::object();
  for (const BackendFinding& backend : d.backends) backends.push_back(to_json(backend));
  for (const auto& [name, value] : d.environment) environment[name] = value;
  return {{"drape",
           {{"version", d.build.version},
            {"revision", d.build.revision},
            {"compiler", d.build.compiler},
            {"build", d.build.type}}},
          {"machine",
           {{"processor", d.machine.processor},
            {"flags", d.machine.flags},
            {"threads", d.machine.threads},
            {"memory", d.machine.memory},
            {"system", d.machine.system}}},
          {"environment", environment},
          {"instruction_set",
           {{"chosen", d.chosen_kernels.detail},
            {"problem", d.chosen_kernels.problem},
            {"known", d.kernels},
            {"runs_here", d.runnable_kernels}}},
          {"blas", to_json(d.blas)},
          {"cholmod", d.cholmod},
          {"drawing", to_json(d.drawing)},
          {"backends", backends},
          {"codecs", to_json(d.codecs)},
          {"outputs", to_json(d.outputs)},
          {"optional", to_json(d.optional)},
          {"missing_packages", d.missing_packages()}};
}

/// Runs the work and returns its error, if any.
template <class Work>
std::string problem_of(Work work) {
  try {
    work();
    return {};
  } catch (const std::exception& error) {
    return error.what();
  }
}

std::vector<std::pair<std::string, std::string>> relevant_environment() {
  std::vector<std::pair<std::string, std::string>> set;
  for (const char* name : {"DRAPE_DATA", "DRAPE_ISA", "GALLIUM_DRIVER", "LIBGL_ALWAYS_SOFTWARE",
                           "LP_NATIVE_VECTOR_WIDTH", "LP_NUM_THREADS", "OPENBLAS_CORETYPE", "OPENBLAS_NUM_THREADS"}) {
    if (const char* value = std::getenv(name)) set.emplace_back(name, value);
  }
  return set;
}

void find_kernels(Diagnosis& diagnosis) {
  for (const Kernels* version : all_kernels()) {
    diagnosis.kernels.emplace_back(version->name);
    if (version->supported() != 0) diagnosis.runnable_kernels.emplace_back(version->name);
  }
  diagnosis.chosen_kernels.name = "instruction set";
  diagnosis.chosen_kernels.problem = problem_of([&] {
    use_environment_isa();
    diagnosis.chosen_kernels.detail = std::string(kernels().name);
  });
}

/// Finds the library that implements CHOLMOD's BLAS calls.
Finding find_blas() {
  Finding found{.name = "BLAS", .detail = {}, .problem = {}, .packages = "libopenblas0-serial"};
  Dl_info info{};
  void* const symbol = dlsym(RTLD_DEFAULT, "dgemm_");
  if (symbol == nullptr || dladdr(symbol, &info) == 0) {
    found.problem = "no BLAS is loaded";
    return found;
  }
  std::error_code error;
  const std::filesystem::path file = std::filesystem::canonical(info.dli_fname, error);
  found.detail = error ? info.dli_fname : file.string();
  using Describe = char* (*)();
  if (const auto describe = reinterpret_cast<Describe>(dlsym(RTLD_DEFAULT, "openblas_get_config"))) {
    found.detail += fmt::format(", {}", describe());
  } else if (found.detail.find("/blas/libblas") != std::string::npos) {
    found.problem =
        "this is the reference BLAS, which takes three times as long to factor large systems: " + found.detail;
  }
  return found;
}

BackendFinding find_backend(GlBackend backend) {
  BackendFinding found;
  found.name = backend_name(backend);
  found.packages = debian_packages(backend);
  found.problem = problem_of([&] { found.facts = inspect_backend(backend); });
  if (found.works()) found.detail = fmt::format("{}, OpenGL {}", found.facts.renderer, found.facts.version);
  return found;
}

/// Draws a square in the middle of the picture and checks the middle and a corner.
void draw_a_square() {
  use_environment_data();
  const Mesh mesh = make_grid(1, 1);
  Look look;
  look.background = Rgb{0, 0, 1};
  look.color = {1, 1, 1};
  Renderer renderer(data_folder(), {64, 64}, View{{0, 0, 5}, {0, 0, 0}, {0, 1, 0}, 30}, look, 4, mesh.triangles, {});
  Frame frame;
  frame.positions = mesh.positions;
  const Image image = renderer.draw(frame);
  const std::uint8_t* const middle = image.at(32, 32);
  const std::array<std::uint8_t, 3> corner{image.at(0, 0)[0], image.at(0, 0)[1], image.at(0, 0)[2]};
  if (corner != std::array<std::uint8_t, 3>{0, 0, 255} || middle[0] < 64) {
    throw OutputError(
        fmt::format("the test picture is wrong: its middle is rgb({}, {}, {}), its corner rgb({}, {}, {})", middle[0],
                    middle[1], middle[2], corner[0], corner[1], corner[2]));
  }
}

Finding find_drawing(const std::vector<BackendFinding>& backends) {
  Finding drawing{.name = "drawing", .detail = {}, .problem = {}, .packages = {}};
  const auto first = std::find_if(backends.begin(), backends.end(), [](const Finding& b) { return b.works(); });
  if (first == backends.end()) {
    drawing.problem = "no OpenGL library works";
    return drawing;
  }
  drawing.detail = first->name;
  drawing.problem = problem_of(draw_a_square);
  return drawing;
}

Finding find_output(const TemporaryFolder& folder, const OutputFormat& format) {
  Finding found{.name = format.extension, .detail = {}, .problem = {}, .packages = format.packages};
  found.problem = problem_of([&] { found.detail = try_format(format, folder.path() / ("film" + format.extension)); });
  return found;
}

/// Returns the font of a PDF file's first text; empty if it has none.
std::string first_font(const std::string& pdf) {
  const std::string key = "/BaseFont /";
  const std::size_t at = pdf.find(key);
  if (at == std::string::npos) return {};
  const std::string name = pdf.substr(at + key.size(), pdf.find_first_of(" \n/>", at + key.size()) - at - key.size());
  return name.substr(name.find('+') + 1);  // skip the subset prefix of six letters
}

/// Checks the fonts of captions: for Latin and Greek, and for Chinese.
Finding find_text() {
  Finding text{.name = "text", .detail = {}, .problem = {}, .packages = Fonts::packages()};
  text.problem = problem_of([&] {
    Fonts fonts;
    fonts.require("aεµ中");
    text.detail = fmt::format("{}; Chinese from {}", fonts.source(U'ε'), fonts.source(U'中'));
  });
  return text;
}

/// Checks the PDF and PNG export of diagrams and the font of their text.
std::vector<Finding> find_diagrams() {
  Finding files{.name = "diagrams", .detail = {}, .problem = {}, .packages = SvgPrinter::packages()};
  Finding fonts{.name = "fonts", .detail = {}, .problem = {}, .packages = "fonts-dejavu-core"};
  constexpr const char* letter =
      "<svg xmlns='http://www.w3.org/2000/svg' width='9' height='9'><text y='9' "
      "font-family='sans-serif'>a</text></svg>";
  files.problem = problem_of([&] { fonts.detail = first_font(SvgPrinter().pdf(letter)); });
  if (!files.works()) return {files};
  files.detail = "SVG, PDF, PNG";
  if (fonts.detail.empty()) fonts.problem = "no font found: text is missing from the diagrams' PDF and PNG files";
  return {files, fonts};
}

std::vector<std::string> Diagnosis::missing_packages() const {
  std::vector<std::string> missing;
  const auto add = [&](const Finding& finding) {
    std::istringstream words(finding.works() ? "" : finding.packages);
    for (std::string word; words >> word;) {
      if (std::find(missing.begin(), missing.end(), word) == missing.end()) missing.push_back(word);
    }
  };
  for (const BackendFinding& backend : backends) add(backend);
  add(blas);
  for (const Finding& output : outputs) add(output);
  for (const Finding& finding : optional) add(finding);
  return missing;
}

/// Checks this machine: loads the OpenGL libraries, draws a small picture, and writes two frames in every format to a
/// temporary folder.
Diagnosis diagnose() {
  Diagnosis diagnosis;
  diagnosis.environment = relevant_environment();  // first: preparing OpenGL sets some of them
  diagnosis.build = build_info();
  diagnosis.machine = machine_facts();
  find_kernels(diagnosis);
  diagnosis.blas = find_blas();
  std::array<int, 3> version{};
  cholmod_version(version.data());
  diagnosis.cholmod = fmt::format("{}.{}.{}", version[0], version[1], version[2]);

  for (const GlBackend backend : {GlBackend::osmesa, GlBackend::egl}) {
    if (backend == GlBackend::egl && !portable_root().empty()) continue;  // not in the portable archive
    diagnosis.backends.push_back(find_backend(backend));
  }
  diagnosis.drawing = find_drawing(diagnosis.backends);

  diagnosis.codecs = {.name = "codecs", .detail = {}, .problem = {}, .packages = {}};
  diagnosis.codecs.problem = problem_of([&] {
    codecs();
    diagnosis.codecs.detail = codecs_module().string();
  });
  const TemporaryFolder folder("drape-doctor");
  for (const OutputFormat& format : output_formats()) diagnosis.outputs.push_back(find_output(folder, format));
  diagnosis.optional = find_diagrams();
  diagnosis.optional.push_back(find_text());
  return diagnosis;
}

}  // namespace

void add_doctor_command(CLI::App& app, Command& command) {
  CLI::App* doctor = app.add_subcommand("doctor", "Report what drape finds on this machine, and what to install");
  auto as_json = std::make_shared<bool>(false);
  doctor->add_flag("--json", *as_json, "Print JSON");
  complete_command(
      *doctor, command,
      [as_json] {
        const Diagnosis diagnosis = diagnose();
        print_text(stdout, *as_json ? to_json(diagnosis).dump(2) + "\n" : to_text(diagnosis));
        return diagnosis.drawing.works() ? ExitCode::ok : ExitCode::output;
      },
      "doctor\n"
      "doctor --json");
}

}  // namespace drape
