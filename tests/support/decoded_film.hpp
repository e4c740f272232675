#pragma once

#include <cmath>
#include <filesystem>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>
#include <vector>

#include "drape/render/image.hpp"

namespace drape::test {

/// Decodes the frames of a video or GIF as a player does.
inline std::vector<Image> decoded_film(const std::filesystem::path& file) {
  std::vector<Image> film;
  cv::VideoCapture video(file.string(), cv::CAP_FFMPEG);
  for (cv::Mat bgr; video.read(bgr);) {
    Image image(bgr.cols, bgr.rows);
    cv::Mat rgb(bgr.size(), CV_8UC3, image.pixels.data());
    cv::cvtColor(bgr, rgb, cv::COLOR_BGR2RGB);
    film.push_back(std::move(image));
  }
  return film;
}

/// Computes the peak signal-to-noise ratio [dB] of two pictures of one size.
inline double psnr(const Image& a, const Image& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) sum += std::pow(a.pixels[i] - b.pixels.at(i), 2);
  return 10 * std::log10(255.0 * 255.0 * static_cast<double>(a.pixels.size()) / std::max(sum, 1e-9));
}

}  // namespace drape::test
