#include "output/gif_encoder.hpp"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "core/files.hpp"
#include "core/text.hpp"
#include "drape/core/error.hpp"
#include "output/gif/compactor.hpp"
#include "output/gif/palette.hpp"
#include "output/png_encoder.hpp"
#include "reports/players.hpp"

namespace drape::gif {
namespace {

using namespace std::string_literals;

void put(std::string& bytes, std::initializer_list<int> values) {
  for (const int value : values) bytes.push_back(static_cast<char>(value));
}

/// Writes 16-bit numbers, little-endian.
void put_words(std::string& bytes, std::initializer_list<int> values) {
  for (const int value : values) put(bytes, {value & 0xff, value >> 8});
}

constexpr int extension = 0x21, image_separator = 0x2c, trailer = 0x3b;
constexpr int graphic_control = 0xf9, application = 0xff;

/// Writes the blocks of an animated GIF that repeats for ever (Graphics Interchange Format, version 89a, CompuServe
/// 1990), with one colour table for all frames, each of which is drawn over the previous one.
class Container {
 public:
  /// @param file  must outlive this object
  /// @throws OutputError
  Container(PartialFile& file, int width, int height, const Palette& palette);

  /// Appends a frame. @param duration  of the frame [1/100 s]
  /// @returns its size [bytes]
  std::size_t add(const Patch& patch, std::int64_t duration);

  /// Ends the file.
  void finish();

 private:
  PartialFile& file_;
};

/// Writes the frames of a film to a GIF.
///
/// The target is 0.14 bytes per pixel and frame: 5.6 MB for 209 frames of 480×400. The further a film exceeds it, the
/// more tolerance the Compactor gets; a smaller film stays lossless.
class FilmWriter {
 public:
  /// @param file  must outlive this object
  /// @throws OutputError
  FilmWriter(PartialFile& file, int width, int height, const Palette& palette);

  /// @param duration  time on screen [1/100 s]
  void add(const Image& image, std::int64_t duration);

  /// Completes the file.
  void finish() { container_.finish(); }

 private:
  [[nodiscard]] int tolerance() const;

  OrderedDither dither_;
  Compactor compactor_;
  Container container_;
  double bytes_per_frame_;  // target
  double debt_ = 0;         // bytes of the frames so far above the target; negative: saved
};

Container::Container(PartialFile& file, int width, int height, const Palette& palette) : file_(file) {
  std::string bytes = "GIF89a";
  put_words(bytes, {width, height});
  put(bytes, {0xf7, 0, 0});  // a table of 2⁷⁺¹ colours, of 8 bits a channel; no background, square pixels
  for (const std::uint32_t color : palette.colors) put(bytes, {red(color), green(color), blue(color)});
  put(bytes, {extension, application, 11});
  bytes += "NETSCAPE2.0";
  put(bytes, {3, 1});
  put_words(bytes, {0});  // repeats for ever
  put(bytes, {0});
  file_.write(bytes);
}

std::size_t Container::add(const Patch& patch, std::int64_t duration) {
  constexpr std::int64_t longest = 0xffff;
  std::string bytes;
  put(bytes, {extension, graphic_control, 4, 1 << 2 | 1});  // keeps the previous picture; has a transparent colour
  put_words(bytes, {static_cast<int>(std::min(duration, longest))});
  put(bytes, {Palette::transparent, 0, image_separator});
  put_words(bytes, {patch.x, patch.y, patch.width, patch.height});
  put(bytes, {0});  // no local colour table
  bytes += patch.data;
  file_.write(bytes);
  return bytes.size();
}

void Container::finish() { file_.write(std::string(1, static_cast<char>(trailer))); }

FilmWriter::FilmWriter(PartialFile& file, int width, int height, const Palette& palette)
    : dither_(palette, width, height),
      compactor_(palette, width, height),
      container_(file, width, height, palette),
      bytes_per_frame_(0.14 * width * height) {}

int FilmWriter::tolerance() const {
  // Proportional to the debt, so that it settles at the allowed size. A larger tolerance would fray edges.
  constexpr double largest = 32, frames_of_debt = 8;
  return static_cast<int>(std::clamp(largest * debt_ / (frames_of_debt * bytes_per_frame_), 0.0, largest));
}

void FilmWriter::add(const Image& image, std::int64_t duration) {
  const Patch patch = compactor_.compact(dither_.apply(image), tolerance());
  debt_ += static_cast<double>(container_.add(patch, duration)) - bytes_per_frame_;
}

}  // namespace
}  // namespace drape::gif

namespace drape {
namespace {

double gif_rate(const std::filesystem::path& file, double fps) {
  if (fps > 50) {
    throw UsageError(fmt::format(
        "cannot write {} at {} frames per second: a GIF can play at most 50, because it counts in hundredths of a "
        "second and browsers slow down frames shorter than two; choose fps = 50 or less, or write .mp4 or .webm",
        shown(file), fps));
  }
  if (!(fps >= 0.01)) {
    throw UsageError(
        fmt::format("cannot write {} at {} frames per second: a GIF can play at least 0.01", shown(file), fps));
  }
  return fps;
}

}  // namespace

GifEncoder::GifEncoder(const std::filesystem::path& file, double fps, std::function<void(int, int)> progress)
    : fps_(gif_rate(file, fps)), file_(file), progress_(std::move(progress)), spool_(file_) {}

std::int64_t GifEncoder::start(int frame) const { return std::llround(frame * 100.0 / fps_); }

void GifEncoder::add(const Image& image) {
  spool_.append(image);
  colors_.add(image);
}

std::vector<OutputFile> GifEncoder::finish(Ending ending) {
  if (spool_.count() == 0) return {};
  encode();
  const std::uintmax_t size = file_.commit(ending);
  return {{file_.name(ending), size}};
}

void GifEncoder::encode() {
  const gif::Palette palette = gif::make_palette(colors_);
  const int count = spool_.count();
  std::optional<gif::FilmWriter> writer;
  spool_.rewind();
  for (int k = 0; k < count; ++k) {
    const Image& image = spool_.next();
    if (!writer) writer.emplace(file_, image.width, image.height, palette);
    writer->add(image, start(k + 1) - start(k));
    if (progress_) progress_(k + 1, count);
  }
  writer->finish();
}

OutputFormat gif_format() {
  return {.extension = ".gif",
          .help = "looping animation, at most 50 frames per second",
          .made_by = {},
          .packages = {},
          .make = FilmMaker<Image>([](const std::filesystem::path& file, const FilmInfo& film) {
            return std::make_unique<GifEncoder>(file, film.fps, film.progress);
          })};
}

PageFilm write_page_film(const std::filesystem::path& gif, double fps, const PageFrames& frames) {
  GifEncoder encoder(gif, fps, {});
  const std::set<std::size_t> printed = html::printed_moments(frames.count);
  std::map<std::size_t, Image> stills;
  for (std::size_t k = 0; k < frames.count; ++k) {
    const std::size_t frame = (frames.first + k) % frames.count;
    Image image = frames.picture(frame);
    encoder.add(image);
    if (printed.contains(frame)) stills.emplace(frame, std::move(image));
  }
  encoder.finish(Ending::complete);
  std::vector<const Image*> moments;
  for (const auto& [frame, still] : stills) moments.push_back(&still);
  return {read_file(gif, std::filesystem::file_size(gif)),
          encode_png(montage(moments, frames.columns, frames.gap, frames.gray))};
}

namespace {

constexpr int narrowest = 16;      // least useful width [pixels]
constexpr double least_rate = 10;  // least rate of a smooth motion [1/s]

/// Estimates the width of a film of `bytes`, between two known ones, if size is a power of width.
double interpolated_width(double small, double small_bytes, double wide, double wide_bytes, double bytes) {
  const double power = std::log(wide_bytes / small_bytes) / std::log(wide / small);
  return power > 0 ? small * std::pow(bytes / small_bytes, 1 / power) : (small + wide) / 2;
}

FilmInfo without_limit(FilmInfo film) {
  film.largest_file.reset();
  return film;
}

}  // namespace

SizeLimitedEncoder::SizeLimitedEncoder(FilmMaker<Image> make, const std::filesystem::path& file, const FilmInfo& film)
    : make_(std::move(make)),
      film_(without_limit(film)),
      limit_(film.largest_file.value()),
      file_(file),
      spool_(file_) {
  make_(file, film_);  // reports errors now
}

void SizeLimitedEncoder::add(const Image& image) {
  width_ = image.width;
  height_ = image.height;
  spool_.append(image);
}

int SizeLimitedEncoder::height_of(int width) const {
  return std::max(1, static_cast<int>(std::lround(static_cast<double>(height_) * width / width_)));
}

SizeLimitedEncoder::Trial SizeLimitedEncoder::encode(int width, int stride) {
  const std::filesystem::path trial =
      file_.temporary().parent_path() / (".trial-" + file_.temporary().filename().string().substr(1));
  FilmInfo film = film_;
  film.width = width;
  film.height = height_of(width);
  film.fps /= stride;
  film.seconds_per_frame *= stride;
  film.expected_frames = (spool_.count() + stride - 1) / stride;
  const std::unique_ptr<Encoder> encoder = make_(trial, film);
  spool_.rewind();
  for (int k = 0; k < spool_.count(); ++k) {
    const Image& image = spool_.next();
    if (k % stride == 0) encoder->add(scaled_image(image, film.width, film.height));
  }
  const Trial done{width, stride, encoder->finish().at(0).size};
  if (fits(done)) {
    file_.adopt(trial);
  } else {
    std::filesystem::remove(trial);
  }
  return done;
}

SizeLimitedEncoder::Trial SizeLimitedEncoder::find_largest() {
  const Trial whole = encode(width_, 1);
  if (fits(whole)) return whole;
  if (limit_.keeps == FilmKeeps::size) return find_stride(whole, spool_.count() - 1);
  if (limit_.keeps == FilmKeeps::rate) return find_width(1, narrowest);
  const int half = std::max(narrowest, (width_ + 1) / 2);
  const Trial small = find_width(1, half);
  if (fits(small)) return small;
  const Trial slow = find_stride(small, std::min(static_cast<int>(film_.fps / least_rate), spool_.count() - 1));
  return find_width(slow.stride, fits(slow) ? half : narrowest);
}

SizeLimitedEncoder::Trial SizeLimitedEncoder::find_stride(Trial trial, int most) {
  while (!fits(trial) && trial.stride < most) trial = encode(trial.width, trial.stride + 1);
  return trial;
}

SizeLimitedEncoder::Trial SizeLimitedEncoder::find_width(int stride, int least) {
  Trial wide = encode(width_, stride), best{0, stride, 0};
  if (fits(wide)) return wide;
  const auto limit = static_cast<double>(limit_.bytes);
  while (best.width == 0) {
    if (wide.width <= least) return wide;
    const double guess = 0.97 * wide.width * std::sqrt(limit / static_cast<double>(wide.bytes));
    const Trial trial = encode(std::clamp(static_cast<int>(guess), least, wide.width - 1), stride);
    (fits(trial) ? best : wide) = trial;
  }
  // Each trial takes at least an eighth off what is left, so that there are few of them whatever the sizes.
  while (wide.width - best.width > std::max(1, best.width / 100)) {
    const int part = std::max(1, (wide.width - best.width) / 8);
    const double guess = interpolated_width(best.width, static_cast<double>(best.bytes), wide.width,
                                            static_cast<double>(wide.bytes), 0.99 * limit);
    const Trial trial = encode(std::clamp(static_cast<int>(guess), best.width + part, wide.width - part), stride);
    (fits(trial) ? best : wide) = trial;
  }
  return best;
}

std::string SizeLimitedEncoder::changes(const Trial& kept) const {
  std::string text;
  if (kept.width != width_) {
    text = fmt::format("{}x{} pixels instead of {}x{}", kept.width, height_of(kept.width), width_, height_);
  }
  if (kept.stride != 1) {
    text += fmt::format("{}{:.3g} frames per second instead of {:g}", text.empty() ? "" : " and ",
                        film_.fps / kept.stride, film_.fps);
  }
  return text;
}

void SizeLimitedEncoder::fail(const Trial& smallest) const {
  const std::string given_up = changes(smallest);
  throw OutputError(
      fmt::format("cannot write {} with at most {} bytes: with {} it still has {}; {}", shown(file_.file()),
                  limit_.bytes, given_up.empty() ? "all that it has to keep" : given_up, smallest.bytes,
                  limit_.keeps == FilmKeeps::nothing ? "use fewer frames, with --frames" : "omit --keep"));
}

std::vector<OutputFile> SizeLimitedEncoder::finish(Ending ending) {
  if (spool_.count() == 0) return {};
  const Trial found = find_largest();
  if (!fits(found)) fail(found);
  const std::uintmax_t size = file_.commit(ending);
  return {{file_.name(ending), size, changes(found)}};
}

}  // namespace drape
