// Libraries' own messages about a picture are suppressed, and no other output is.

#include <gtest/gtest.h>

#include <algorithm>
#include <opencv2/imgcodecs.hpp>
#include <string>
#include <thread>

#include "core/console.hpp"
#include "output/codecs/codecs.hpp"

namespace drape {
namespace {

TEST(Quiet, LosesNothingOfWhatOthersPrintMeanwhile) {
  std::vector<std::uint8_t> bytes = png_from_bgr(cv::Mat::zeros(8, 8, CV_8UC3));
  bytes.resize(bytes.size() - 16);  // OpenCV's libpng would report a premature end
  const std::string_view damaged(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  constexpr int lines = 20000;
  ::testing::internal::CaptureStderr();
  std::jthread decoding([&](const std::stop_token& stop) {
    while (!stop.stop_requested()) codecs().decode(damaged, cv::IMREAD_COLOR);
  });
  for (int i = 0; i < lines; ++i) print_text(stderr, "line\n");
  decoding.request_stop();
  decoding.join();
  const std::string printed = ::testing::internal::GetCapturedStderr();
  EXPECT_EQ(std::count(printed.begin(), printed.end(), '\n'), lines);
  EXPECT_EQ(printed.size(), 5U * lines);
}

}  // namespace
}  // namespace drape
