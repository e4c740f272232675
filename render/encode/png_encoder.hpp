#pragma once

#include <optional>
#include <string>

#include "render/encode/encoder.hpp"
#include "render/encode/path_template.hpp"

namespace drape {

/// The bytes of a PNG file. The same image gives the same bytes.
/// @throws OutputError
std::string encode_png(const Image& image);

/// One picture: the last frame added.
class PngEncoder : public Encoder {
 public:
  explicit PngEncoder(const std::filesystem::path& file);

  void add(const Image& image) override { last_ = image; }
  std::vector<OutputFile> finish(Ending ending) override;

 private:
  std::filesystem::path file_;
  std::optional<Image> last_;
};

/// One picture per frame, each of which appears complete. Pictures of an earlier, longer sequence are left alone.
class PngSequenceEncoder : public Encoder {
 public:
  /// @param default_width  see PathTemplate::path
  PngSequenceEncoder(PathTemplate path, std::string scene, int first_frame, int default_width);

  void add(const Image& image) override;
  std::vector<OutputFile> finish(Ending) override { return std::move(files_); }

 private:
  [[nodiscard]] std::string next_path() const;

  PathTemplate path_;
  std::string scene_;
  int frame_, default_width_;
  std::vector<OutputFile> files_;
};

}  // namespace drape
