#include <fmt/format.h>
#include <fmt/ranges.h>

#include <nlohmann/json.hpp>

#include "cli/command_line.hpp"
#include "cli/diagnosis.hpp"
#include "core/console.hpp"

namespace drape {
namespace {

using Json = nlohmann::ordered_json;

std::string line(const std::string& name, const std::string& text) { return fmt::format("  {:<16} {}\n", name, text); }

std::string line(const Finding& finding) {
  if (finding.works()) return line(finding.name, finding.detail);
  std::string text = "PROBLEM: " + finding.problem;
  for (std::size_t at = 0; (at = text.find('\n', at)) != std::string::npos; ++at) text.replace(at, 1, "; ");
  return line(finding.name, text);
}

std::string limits(const GlFacts& facts) {
  return fmt::format("{} samples per pixel, textures up to {}², pictures up to {}², anisotropy {}", facts.max_samples,
                     facts.max_texture_size, facts.max_picture_size, facts.max_anisotropy);
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
               {"max_picture_size", f.max_picture_size},
               {"max_anisotropy", f.max_anisotropy}});
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

}  // namespace

void add_doctor_command(CLI::App& app, Command& command) {
  CLI::App* doctor = app.add_subcommand("doctor", "Report what drape finds on this machine, and what to install");
  auto as_json = std::make_shared<bool>(false);
  doctor->add_flag("--json", *as_json, "Print JSON");
  doctor->callback([as_json, &command] {
    command = [as_json] {
      const Diagnosis diagnosis = diagnose();
      print_text(stdout, *as_json ? to_json(diagnosis).dump(2) + "\n" : to_text(diagnosis));
      return diagnosis.drawing.works() ? ExitCode::ok : ExitCode::output;
    };
  });
}

}  // namespace drape
