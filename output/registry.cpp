#include "output/registry.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <algorithm>
#include <charconv>
#include <stdexcept>

#include "core/installation.hpp"
#include "core/text.hpp"
#include "drape/core/error.hpp"
#include "output/gif_encoder.hpp"
#include "output/glb_writer.hpp"
#include "output/html_writer.hpp"
#include "output/mesh_writers.hpp"
#include "output/npz_writer.hpp"
#include "output/png_encoder.hpp"
#include "output/usd_writer.hpp"
#include "output/video_encoder.hpp"

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

const std::vector<Triangle>& FilmInfo::triangles() const {
  static const std::vector<Triangle> none;
  return cloth != nullptr ? cloth->triangles : none;
}

const std::vector<std::array<float, 2>>& FilmInfo::texture_coordinates() const {
  static const std::vector<std::array<float, 2>> none;
  return uvs != nullptr ? *uvs : none;
}

bool OutputFormat::drawn() const {
  return std::holds_alternative<FilmMaker<Image>>(make) || std::holds_alternative<FrameMaker<Image>>(make);
}

bool OutputFormat::file_per_frame() const {
  return std::holds_alternative<FrameMaker<Image>>(make) || std::holds_alternative<FrameMaker<Frame>>(make);
}

namespace {

/// Makes a film's sink for one file.
struct AtFile {
  const std::filesystem::path& file;
  const FilmInfo& film;

  template <class Item>
  AnySink operator()(const FilmMaker<Item>& make) const {
    if constexpr (std::is_same_v<Item, Image>) {
      if (film.largest_file) return std::make_unique<SizeLimitedEncoder>(make, file, film);
    }
    return make(file, film);
  }
  template <class Item>
  AnySink operator()(const FrameMaker<Item>& make) const {
    return std::make_unique<LastFrameFile<Item>>(file, film.expected_frames - 1, make(film));
  }
  AnySink operator()(const OfSteps&) const { throw std::logic_error("a run writes its steps itself"); }
};

[[noreturn]] void fail_for_frame(const std::string& path, const OutputFormat& format) {
  std::vector<std::string> others;
  for (const OutputFormat& other : output_formats()) {
    if (other.file_per_frame()) others.push_back(other.extension);
  }
  throw UsageError(fmt::format("the output {} has a {{frame}}, but a {} holds all frames; one file per frame make {}",
                               path, format.extension, quoted_list(others)));
}

/// Makes a film's sink for one file per frame.
struct AtFiles {
  const std::string& text;  // text of the path
  const PathTemplate& path;
  const OutputFormat& format;
  const FilmInfo& film;

  template <class Item>
  AnySink operator()(const FilmMaker<Item>&) const {
    fail_for_frame(text, format);
  }
  AnySink operator()(const OfSteps&) const { fail_for_frame(text, format); }
  template <class Item>
  AnySink operator()(const FrameMaker<Item>& make) const {
    const auto name = [path = path, scene = film.scene, width = frame_digits(film)](int frame) {
      return path.path(scene, frame, width);
    };
    return std::make_unique<FrameFiles<Item>>(name, film.first_frame, make(film));
  }
};

}  // namespace

std::vector<std::string> output_files(const std::string& path, const FilmInfo& film) {
  const PathTemplate path_template(path);
  const int frames = std::max(1, film.expected_frames);
  std::vector<std::string> files;
  for (int i = 0; i < (path_template.has_frame() ? frames : 1); ++i) {
    files.push_back(path_template.path(film.scene, film.first_frame + i, frame_digits(film)));
  }
  const OutputFormat* format = find_format(path);
  if (format == nullptr || path_template.has_frame()) return files;
  const std::filesystem::path file = files.front();
  for (const char* beside : format->beside) {
    for (int i = 0; i < (PathTemplate(beside).has_frame() ? frames : 1); ++i) {
      files.push_back(file_beside(file, beside, film, film.first_frame + i));
    }
  }
  return files;
}

AnySink make_sink(const std::string& path, const FilmInfo& film) {
  const PathTemplate path_template(path);
  const OutputFormat& format = format_of(path);
  if (!path_template.has_frame()) {
    const std::filesystem::path file = path_template.path(film.scene, 0, 1);
    if (film.sheet && format.drawn() && format.file_per_frame()) return std::make_unique<ContactSheet>(file, film);
    return make_sink(format, file, film);
  }
  return std::visit(AtFiles{path, path_template, format, film}, format.make);
}

AnySink make_sink(const OutputFormat& format, const std::filesystem::path& file, const FilmInfo& film) {
  return std::visit(AtFile{file, film}, format.make);
}

namespace {

void give_two_frames(Encoder& encoder) {
  Image image(64, 64);
  encoder.add(image);
  std::fill(image.pixels.begin(), image.pixels.end(), std::uint8_t{200});
  encoder.add(image);
}

void give_two_frames(MotionWriter& writer) {
  Frame frame;
  frame.positions = Vertices::Identity(3, 3);
  frame.velocities = Vertices::Zero(3, 3);
  frame.energies.emplace();
  writer.add(frame);
  frame.index = 1;
  writer.add(frame);
}

}  // namespace

std::string try_format(const OutputFormat& format, const std::filesystem::path& file) {
  if (format.of_steps()) return "by drape itself";
  Cloth cloth;
  cloth.positions = cloth.rest = Vertices::Identity(3, 3);
  cloth.velocities = Vertices::Zero(3, 3);
  cloth.triangles = {{0, 1, 2}};
  FilmInfo film;
  film.expected_frames = 2;
  film.cloth = &cloth;
  const AnySink any = make_sink(format, file, film);
  return std::visit(
      [&](const auto& sink) {
        give_two_frames(*sink);
        sink->finish();
        const std::string codec = sink->codec(), by = format.made_by.empty() ? "drape itself" : format.made_by;
        return codec.empty() ? "by " + by : codec + ", by " + by;
      },
      any);
}

PathTemplate::PathTemplate(std::string_view text) : text_(text) {
  const auto append = [this](char c) {
    if (pieces_.empty() || pieces_.back().kind != Piece::Kind::text) pieces_.push_back({Piece::Kind::text, {}});
    pieces_.back().text += c;
  };
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    const bool doubled = (c == '{' || c == '}') && i + 1 < text.size() && text[i + 1] == c;
    if (doubled) {
      append(c);
      ++i;
    } else if (c == '{') {
      const std::size_t end = text.find('}', i);
      if (end == std::string_view::npos) throw UsageError(fmt::format("a '}}' is missing in the output path {}", text));
      pieces_.push_back(placeholder(text.substr(i + 1, end - i - 1)));
      i = end;
    } else if (c == '}') {
      throw UsageError(fmt::format("a '}}' without '{{' in the output path {}; write '}}}}' for a brace", text));
    } else {
      append(c);
    }
  }
}

PathTemplate::Piece PathTemplate::placeholder(std::string_view inside) const {
  const std::size_t colon = inside.find(':');
  const std::string_view name = inside.substr(0, colon);
  if (inside == "scene") return {Piece::Kind::scene, {}};
  if (inside == "frame") return {Piece::Kind::frame, {}};
  if (name == "frame") {
    constexpr int widest = 18;
    const std::string_view width = inside.substr(colon + 1);
    Piece piece{Piece::Kind::frame, {}};
    const auto [end, error] = std::from_chars(width.data(), width.data() + width.size(), piece.width);
    const bool complete = error == std::errc{} && end == width.data() + width.size();
    if (complete && piece.width >= 1 && piece.width <= widest) return piece;
    throw UsageError(
        fmt::format("'{{{}}}' in the output path {}: expected a number of digits, as in {{frame:04}}", inside, text_));
  }
  const std::vector<std::string> names{"scene", "frame"};
  const std::string nearest = nearest_name(name, names);
  throw UsageError(
      fmt::format("unknown placeholder '{{{}}}' in the output path {}; {}the valid ones are {{scene}}, "
                  "{{frame}} and {{frame:04}}",
                  inside, text_, nearest.empty() ? "" : fmt::format("did you mean '{{{}}}'? ", nearest)));
}

bool PathTemplate::has_frame() const {
  return std::any_of(pieces_.begin(), pieces_.end(), [](const Piece& p) { return p.kind == Piece::Kind::frame; });
}

std::string PathTemplate::path(std::string_view scene, int frame, int default_width) const {
  std::string result;
  for (const Piece& piece : pieces_) {
    switch (piece.kind) {
      case Piece::Kind::text:
        result += piece.text;
        break;
      case Piece::Kind::scene:
        result += name_in_folder(scene, text_, "{scene}");
        break;
      case Piece::Kind::frame:
        result += fmt::format("{:0{}}", frame, piece.width ? piece.width : default_width);
        break;
    }
  }
  return result;
}

}  // namespace drape
