#pragma once

#include <string>
#include <vector>

#include "codecs/codecs.hpp"
#include "core/atomic_file.hpp"
#include "output/format.hpp"

namespace drape {

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

}  // namespace drape
