#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <opencv2/core/mat.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace drape {

/// Takes the next picture of a video: blue, green, red, all of one size. The video is complete when it is destroyed.
using VideoPen = std::function<void(const cv::Mat& bgr)>;

/// Takes the next picture of an animation; null, once: there is none, and the file is to be completed.
/// @throws std::runtime_error why it cannot be written
using AnimationPen = std::function<void(const cv::Mat* rgb)>;

/// Encoders and decoders of videos, and decoders of pictures that are no PNG: OpenCV and FFmpeg, in a module of ours
/// beside the program (codecs/opencv_codecs.cpp), because starting with the two hundred libraries that it needs takes
/// ten times as long as starting without. Functions, not a class: what the two would know of its type are two things to
/// the sanitizers.
struct Codecs {
  /// The picture in the bytes of a file, as cv::imdecode(); says nothing on the terminal.
  /// @param flags cv::ImreadModes
  /// @returns a picture without pixels if they are damaged
  /// @throws cv::Exception
  cv::Mat (*decode)(std::string_view bytes, int flags);

  /// Begins a video.
  /// @param fourcc the four letters that a codec is known by
  /// @param size   even numbers
  /// @returns nothing if it cannot be written
  VideoPen (*begin_video)(const std::string& file, const std::string& fourcc, double fps, cv::Size size);

  /// Begins an animation that repeats for ever.
  /// @param form "webp", which is not quite exact, or "apng", which is
  /// @throws std::runtime_error why it cannot be written
  AnimationPen (*begin_animation)(const std::string& file, const std::string& form, double fps, cv::Size size);

  /// How many frames a player would find in a video or GIF.
  int (*readable_frames)(const std::string& file);
};

/// Where the module is: in the folder lib/drape that was installed or built with the program, wherever they were moved
/// to.
/// @throws OutputError if it is not there
std::filesystem::path codecs_module();

/// The codecs. The first call loads them, which takes a tenth of a second; from any thread.
/// @throws OutputError if they cannot be loaded
const Codecs& codecs();

/// The picture in the bytes of a file: blue, green, red. A PNG needs no codecs() for it.
/// @param flags cv::ImreadModes, which a PNG does without
/// @returns a picture without pixels if they are damaged
/// @throws OutputError as codecs(), cv::Exception
cv::Mat decode_picture(std::string_view bytes, int flags);

}  // namespace drape
