#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <opencv2/core/mat.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace drape {

/// Appends a picture to a video: blue, green, red, all of one size. Destruction completes the video.
using VideoPen = std::function<void(const cv::Mat& bgr)>;

/// Appends a picture to an animation; a final call with null completes the file.
/// @throws std::runtime_error with the reason if it cannot be written
using AnimationPen = std::function<void(const cv::Mat* rgb)>;

/// Encoders and decoders of videos, and decoders of pictures other than PNG and JPEG: OpenCV and FFmpeg, in a module
/// beside the program (output/codecs/codecs_module.cpp). Linking its two hundred libraries would make each start ten
/// times slower. Function pointers, not a class: sanitizers would see two different types in program and module.
struct Codecs {
  /// Decodes a picture file from memory, as cv::imdecode(); prints nothing.
  /// @param flags cv::ImreadModes
  /// @returns an empty picture if the bytes are damaged
  /// @throws cv::Exception
  cv::Mat (*decode)(std::string_view bytes, int flags);

  /// Begins a video.
  /// @param fourcc four-letter code of the codec
  /// @param size   even numbers
  /// @returns an empty function if it cannot be written
  VideoPen (*begin_video)(const std::string& file, const std::string& fourcc, double fps, cv::Size size);

  /// Begins an animation that repeats for ever.
  /// @param form "webp", slightly lossy, or "apng", lossless
  /// @throws std::runtime_error with the reason if it cannot be written
  AnimationPen (*begin_animation)(const std::string& file, const std::string& form, double fps, cv::Size size);

  /// Counts the frames that a player can read from a video or GIF.
  int (*readable_frames)(const std::string& file);
};

/// Returns the path of the module: in the folder lib/drape of this installation or build, which may have been moved.
/// @throws OutputError if it is missing
std::filesystem::path codecs_module();

/// Returns the codecs. The first call loads them, which takes a tenth of a second; callable from any thread.
/// @throws OutputError if they cannot be loaded
const Codecs& codecs();

/// Decodes a picture file from memory to blue, green, red. PNG and JPEG do not load codecs().
/// @param flags cv::ImreadModes; of PNG and JPEG always all three colours
/// @returns an empty picture if the bytes are damaged
/// @throws OutputError as codecs(), cv::Exception
cv::Mat decode_picture(std::string_view bytes, int flags);

/// Returns the name and version of libpng, which handles PNG files without the codecs module.
std::string png_library();

/// Encodes pixels (blue, green, red) as a PNG file. Equal pixels give equal bytes.
/// @throws std::runtime_error with the reason if it cannot be encoded
std::vector<std::uint8_t> png_from_bgr(const cv::Mat& bgr);

/// Returns true if the first eight bytes are those of a PNG file.
bool is_png(std::string_view bytes);

/// Decodes a PNG file of any kind to 8-bit blue, green, red; ignores transparency and colour profiles. Prints nothing.
/// @returns an empty picture if the file is damaged, or has more than 2³⁰ pixels
cv::Mat bgr_from_png(std::string_view bytes);

/// Returns true if the first three bytes are those of a JPEG file.
bool is_jpeg(std::string_view bytes);

/// Returns true for a JPEG file of three colours whose Exif orientation turns nothing.
bool is_upright_rgb_jpeg(std::string_view bytes);

/// Decodes a JPEG file of any kind to 8-bit blue, green, red; ignores colour profiles. Prints nothing.
/// @param turns true to turn the picture upright, as its Exif orientation says
/// @returns an empty picture if the file is damaged, or has more than 2³⁰ pixels
cv::Mat bgr_from_jpeg(std::string_view bytes, bool turns);

}  // namespace drape
