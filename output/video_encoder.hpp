#pragma once

#include <string>
#include <vector>

#include "core/files.hpp"
#include "output/codecs/codecs.hpp"
#include "output/registry.hpp"

namespace drape {

/// An animated picture in full colour that repeats for ever: WebP, almost exact and exact where nothing moves, or APNG,
/// exact. Frame k is shown from k/fps on, in WebP to the millisecond.
class AnimationEncoder final : public Encoder {
 public:
  /// @param form as in Codecs::begin_animation()
  /// @throws UsageError if fps is not within 0.01 … 90, OutputError if there is no encoder
  AnimationEncoder(const std::filesystem::path& file, std::string form, double fps, int width, int height);

  void add(const Image& image) override;
  std::vector<OutputFile> finish(Ending ending) override;

 private:
  template <class Work>
  void attempt(Work work);

  std::string form_;
  double fps_;
  PartialFile file_;
  AnimationPen pen_;
  int width_ = 0, height_ = 0;
};

OutputFormat webp_format();
OutputFormat apng_format();

/// Compression of a video.
struct VideoCodec {
  std::string fourcc;  ///< OpenCV's four-letter code
  std::string name;
};

/// A video by OpenCV and its FFmpeg backend, with colours at half resolution (4:2:0), as browsers play it. 4:2:0 needs
/// even sizes, so a picture of an odd width or height gets a copy of its last column or row.
///
/// OpenCV does not report a failed write, so finish() decodes the whole video before it gets its name.
class VideoEncoder : public Encoder {
 public:
  /// Finds a codec by making a video of one picture at this rate and size: from few small pictures VP8 makes an empty
  /// video.
  /// @param codecs in the order of trial
  /// @throws OutputError if none works
  VideoEncoder(const std::filesystem::path& file, double fps, const std::vector<VideoCodec>& codecs, int width,
               int height);

  void add(const Image& image) override;
  std::vector<OutputFile> finish(Ending ending) override;
  [[nodiscard]] std::string codec() const override { return codec_.name; }

 private:
  bool open(cv::Size size);
  void write(const Image& image);

  double fps_;
  PartialFile file_;
  VideoCodec codec_;
  VideoPen pen_;
  cv::Size size_;  // of the images
  int count_ = 0;
};

OutputFormat mp4_format();
OutputFormat webm_format();
OutputFormat avi_format();

/// Counts the frames that a player can read from a video.
int readable_frames(const PartialFile& file);

/// Opens a finished video as a player would, and decodes all of it.
/// @throws OutputError if it does not have this many frames: with the system's reason if known, such as a full disk
void require_frames(PartialFile& file, int count);

}  // namespace drape
