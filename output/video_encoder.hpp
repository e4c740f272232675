#pragma once

#include <string>
#include <vector>

#include "codecs/codecs.hpp"
#include "core/atomic_file.hpp"
#include "output/format.hpp"

namespace drape {

/// What a video is compressed with.
struct VideoCodec {
  std::string fourcc;  ///< the four letters OpenCV knows it by
  std::string name;
};

/// A video, by OpenCV and its FFmpeg backend, with colours at half resolution (4:2:0), which is what browsers play. A
/// picture of an odd width or height gets one more column or row, a copy of the last one, as 4:2:0 needs even ones.
///
/// OpenCV does not report that a frame could not be written, so finish() decodes the whole video before it gets its
/// name.
class VideoEncoder : public Encoder {
 public:
  /// Makes a video of one picture to find out which codec there is, and takes such pictures at this rate: of few and
  /// small ones VP8 makes a video of no bits.
  /// @param codecs in the order to try
  /// @throws OutputError if there is none
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

}  // namespace drape
