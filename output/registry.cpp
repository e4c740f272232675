#include "output/registry.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "core/error.hpp"
#include "core/nearest.hpp"
#include "output/animation_encoder.hpp"
#include "output/gif_encoder.hpp"
#include "output/glb_writer.hpp"
#include "output/html_writer.hpp"
#include "output/npz_writer.hpp"
#include "output/obj_writer.hpp"
#include "output/pc2_writer.hpp"
#include "output/ply_writer.hpp"
#include "output/png_encoder.hpp"
#include "output/usd_writer.hpp"
#include "output/video_encoder.hpp"
#include "output/vtk_writer.hpp"

namespace drape {

const std::vector<OutputFormat>& output_formats() {
  static const std::vector<OutputFormat> formats{
      gif_format(),   //
      webp_format(),  //
      apng_format(),  //
      png_format(),   //
      mp4_format(),   //
      webm_format(),  //
      avi_format(),   //
      obj_format(),   //
      ply_format(),   //
      npz_format(),   //
      usda_format(),  //
      pvd_format(),   //
      vtp_format(),   //
      pc2_format(),   //
      glb_format(),   //
      html_format(),  //
      {.extension = ".drape",
       .help = "the motion itself, to draw later in any way and to resume after Ctrl-C",
       .made_by = {},
       .packages = {},
       .make = OfSteps{}},
  };
  return formats;
}

namespace {

/// Returns the extension of a path, in lower case.
std::string extension_of(std::string_view path) {
  std::string extension = std::filesystem::path(path).extension().string();
  for (char& c : extension) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return extension;
}

}  // namespace

const OutputFormat* find_format(std::string_view path) {
  const std::string extension = extension_of(path);
  const std::vector<OutputFormat>& all = output_formats();
  const auto found = std::find_if(all.begin(), all.end(), [&](const auto& f) { return f.extension == extension; });
  return found == all.end() ? nullptr : &*found;
}

const OutputFormat& format_of(std::string_view path) {
  if (const OutputFormat* format = find_format(path)) return *format;
  std::vector<std::string> valid;
  for (const OutputFormat& format : output_formats()) valid.push_back(format.extension);
  const std::string extension = extension_of(path), nearest = nearest_name(extension, valid);
  throw UsageError(
      fmt::format("the output {} has {}; {}the valid ones are {}", path,
                  extension.empty() ? "no extension" : fmt::format("the unknown extension '{}'", extension),
                  nearest.empty() ? "" : fmt::format("did you mean '{}'? ", nearest), quoted_list(valid)));
}

std::string output_help(FormatKinds kinds) {
  std::string text;
  std::vector<std::string> of_frames;
  for (const OutputFormat& format : output_formats()) {
    if (kinds == (format.drawn() ? FormatKinds::undrawn : FormatKinds::drawn)) continue;
    text += fmt::format("{:<7}{}\n", format.extension, format.help);
    if (format.file_per_frame()) of_frames.push_back(format.extension);
  }
  return text + fmt::format("With {{frame:04}} in its path, {} holds a frame each, else the last one.",
                            fmt::join(of_frames, " or "));
}

std::string output_reference() {
  std::string text = "| extension | what a file is | frames in a file | written by |\n|---|---|---|---|\n";
  for (const OutputFormat& format : output_formats()) {
    text += fmt::format("| `{}` | {} | {} | `drape render`{} |\n", format.extension, format.help,
                        format.of_steps()         ? "every step, see [motion-file.md](motion-file.md)"
                        : format.file_per_frame() ? "one: each with `{frame}` in its path, else the last"
                                                  : "all",
                        format.drawn() ? "" : ", `drape simulate`");
  }
  return text + "\n";
}

}  // namespace drape
