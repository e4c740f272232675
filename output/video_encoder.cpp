#include "output/video_encoder.hpp"

#include <fmt/format.h>
#include <cmath>
#include <memory>
#include <opencv2/core/utility.hpp>
#include <opencv2/imgproc.hpp>
#include <stdexcept>
#include <utility>

#include "core/text.hpp"
#include "drape/core/error.hpp"
#include "output/codecs/codecs.hpp"

namespace drape {
namespace {

double rate_of_animation(const std::filesystem::path& file, double fps) {
  if (fps >= 0.01 && fps <= 90) return fps;
  throw UsageError(
      fmt::format("cannot write {} at {} frames per second: an animated picture takes 0.01 to 90, because browsers "
                  "slow down frames of ten milliseconds or less; choose another fps, or write .mp4 or .webm",
                  shown(file), fps));
}

OutputFormat animation_format(const std::string& form, const std::string& made_by, const std::string& help) {
  return {.extension = "." + form,
          .help = help,
          .made_by = made_by,
          .packages = "libopencv-dev",  // depends on these libraries
          .make = FilmMaker<Image>([form](const std::filesystem::path& file, const FilmInfo& film) {
            return std::make_unique<AnimationEncoder>(file, form, film.fps, film.width, film.height);
          })};
}

}  // namespace

AnimationEncoder::AnimationEncoder(const std::filesystem::path& file, std::string form, double fps, int width,
                                   int height)
    : form_(std::move(form)), fps_(rate_of_animation(file, fps)), file_(file) {
  attempt([&] { codecs().begin_animation(file_.temporary().string(), form_, fps_, {width, height}); });
}

/// Runs a library call and turns its failure into an OutputError.
template <class Work>
void AnimationEncoder::attempt(Work work) {
  try {
    work();
  } catch (const Error&) {
    throw;
  } catch (const std::runtime_error& error) {
    file_.require_space();
    throw OutputError(fmt::format("cannot write {}: {}", shown(file_.file()), error.what()));
  }
}

void AnimationEncoder::add(const Image& image) {
  const cv::Mat rgb(image.height, image.width, CV_8UC3, const_cast<std::uint8_t*>(image.pixels.data()));
  if (!pen_) {
    width_ = image.width;
    height_ = image.height;
    attempt([&] { pen_ = codecs().begin_animation(file_.temporary().string(), form_, fps_, rgb.size()); });
  }
  if (image.width != width_ || image.height != height_) {
    throw std::invalid_argument("the frames of a film must have one size");
  }
  attempt([&] { pen_(&rgb); });
}

std::vector<OutputFile> AnimationEncoder::finish(Ending ending) {
  if (!pen_) return {};
  attempt([&] { pen_(nullptr); });
  pen_ = {};
  const std::uintmax_t size = file_.commit(ending);
  return {{file_.name(ending), size}};
}

OutputFormat webp_format() {
  return animation_format("webp", "libwebp", "looping animation in full colour, two thirds of the size of a GIF");
}

OutputFormat apng_format() {
  return animation_format("apng", "FFmpeg", "looping animation with exactly the drawn pixels");
}

namespace {

double video_rate(const std::filesystem::path& file, double fps) {
  // The containers count time in milliseconds or finer.
  if (fps >= 0.01 && fps <= 1000) return fps;
  throw UsageError(fmt::format("cannot write {} at {} frames per second: a video has 0.01 to 1000", shown(file), fps));
}

/// @param codecs in the order of trial
OutputFormat video_format(const std::string& extension, const std::vector<VideoCodec>& codecs) {
  std::string help = "video, ";
  for (const VideoCodec& codec : codecs) help += (&codec == &codecs.front() ? "" : " or ") + codec.name;
  return {.extension = extension,
          .help = help,
          .made_by = "OpenCV " + cv::getVersionString(),
          .packages = "libopencv-dev",
          .make = FilmMaker<Image>([codecs](const std::filesystem::path& file, const FilmInfo& film) {
            return std::make_unique<VideoEncoder>(file, film.fps, codecs, film.width, film.height);
          })};
}

}  // namespace

VideoEncoder::VideoEncoder(const std::filesystem::path& file, double fps, const std::vector<VideoCodec>& codecs,
                           int width, int height)
    : fps_(video_rate(file, fps)), file_(file) {
  bool opened = false;
  std::string tried;
  for (const VideoCodec& codec : codecs) {
    codec_ = codec;
    if (open({width, height})) {
      opened = true;
      write(Image(width, height));
      pen_ = {};
      if (readable_frames(file_) == 1) return;
    }
    tried += (tried.empty() ? "" : " or ") + codec.name;
  }
  file_.require_space();
  if (opened) {
    throw OutputError(
        fmt::format("cannot write {}: OpenCV's {} encoder makes no video of {}x{} pixels at {} frames per second; it "
                    "does with more of them, and a .gif or a .png sequence takes any",
                    shown(file), tried, width, height, fps));
  }
  throw OutputError(
      fmt::format("cannot write {}: OpenCV has no {} encoder; is it built with FFmpeg? A .gif or a .png "
                  "sequence needs none",
                  shown(file), tried));
}

bool VideoEncoder::open(cv::Size size) {
  pen_ = codecs().begin_video(file_.temporary().string(), codec_.fourcc, fps_,
                              {size.width + size.width % 2, size.height + size.height % 2});
  return pen_ != nullptr;
}

void VideoEncoder::write(const Image& image) {
  const cv::Mat rgb(image.height, image.width, CV_8UC3, const_cast<std::uint8_t*>(image.pixels.data()));
  cv::Mat bgr;
  cv::cvtColor(rgb, bgr, cv::COLOR_RGB2BGR);
  cv::copyMakeBorder(bgr, bgr, 0, image.height % 2, 0, image.width % 2, cv::BORDER_REPLICATE);
  pen_(bgr);
}

void VideoEncoder::add(const Image& image) {
  const cv::Size size(image.width, image.height);
  if (count_ == 0) {
    size_ = size;
    if (!open(size)) {
      file_.require_space();
      throw OutputError(fmt::format("cannot write {}: OpenCV's {} encoder does not take pictures of {}x{}",
                                    shown(file_.file()), codec_.name, size.width, size.height));
    }
  }
  if (size != size_) throw std::invalid_argument("the frames of a film must have one size");
  write(image);
  ++count_;
}

std::vector<OutputFile> VideoEncoder::finish(Ending ending) {
  if (count_ == 0) return {};
  pen_ = {};
  require_frames(file_, count_);
  const std::uintmax_t size = file_.commit(ending);
  return {{file_.name(ending), size}};
}

OutputFormat mp4_format() { return video_format(".mp4", {{"avc1", "H.264"}, {"mp4v", "MPEG-4"}}); }
// At OpenCV's quality, VP9 takes four times as long as VP8 for files only a tenth smaller.
OutputFormat webm_format() { return video_format(".webm", {{"VP80", "VP8"}, {"VP90", "VP9"}}); }
OutputFormat avi_format() { return video_format(".avi", {{"MJPG", "Motion JPEG"}, {"XVID", "MPEG-4"}}); }

int readable_frames(const PartialFile& file) { return codecs().readable_frames(file.temporary().string()); }

void require_frames(PartialFile& file, int count) {
  const int found = readable_frames(file);
  if (found == count) return;
  file.require_space();
  throw OutputError(
      fmt::format("cannot write {}: of {} frames, {} can be read back", shown(file.file()), count, found));
}

}  // namespace drape
