#include "output/codecs/webp.hpp"

#include <webp/decode.h>
#include <webp/encode.h>
#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <opencv2/core.hpp>
#include <stdexcept>
#include <string_view>
#include <system_error>

namespace drape {
namespace {

/// An animated WebP file that repeats for ever (RFC 9649). Each of its frames changes a rectangle.
class WebpFile {
 public:
  /// @throws std::runtime_error with the reason if it cannot be written
  WebpFile(const std::string& file, cv::Size size);

  /// Shows a frame on top of the previous ones, until the next begins.
  /// @param still bytes of a WebP file; its transparent pixels keep the previous picture
  /// @param place rectangle of the frame; its corner has even coordinates
  /// @param begin [ms]
  void show(const std::string& still, const cv::Rect& place, std::int64_t begin);

  /// Returns when the current frame began [ms].
  [[nodiscard]] std::int64_t last_begin() const { return begin_; }

  /// Ends the last frame and completes the file.
  void finish(std::int64_t end);

 private:
  void write_frame(std::int64_t end);
  void put(const std::string& bytes);

  struct Close {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::unique_ptr<std::FILE, Close> stream_;
  std::string frame_;  // chunks of the current frame
  cv::Rect place_;
  std::int64_t begin_ = 0;
  std::uint64_t size_ = 0;
};

using Mask = cv::Mat1b;  // 1 where a frame changes the picture

constexpr float quality = 75;          // libwebp's default: a film has two thirds of the size of a GIF
constexpr int seen_at_rest = 0;        // tolerated error of 255 where nothing moves
constexpr int seen_in_motion = 5;      // and elsewhere; libwebp's own error is as large at this quality
constexpr std::uint8_t at_rest = 4;    // frames for which a resting pixel has not changed
constexpr int block = 8;               // [pixels]; transparent areas compress better with fewer corners
constexpr std::int64_t shortest = 11;  // [ms]; browsers stretch shorter frames to a tenth of a second
constexpr int repair_interval = 12;    // frames, if frames are too short to be split

enum class Loss { some, none };

/// Returns the largest difference of a channel.
int difference(const cv::Vec3b& a, const cv::Vec3b& b) {
  int largest = 0;
  for (int c = 0; c < 3; ++c) largest = std::max(largest, std::abs(a[c] - b[c]));
  return largest;
}

/// Returns the bounding box of a mask, with even corner coordinates; empty for an empty mask.
cv::Rect box_of(const Mask& mask) {
  cv::Point first(mask.cols, mask.rows), last(-1, -1);
  for (int y = 0; y < mask.rows; ++y) {
    for (int x = 0; x < mask.cols; ++x) {
      if (mask(y, x) == 0) continue;
      first = {std::min(first.x, x), std::min(first.y, y)};
      last = {std::max(last.x, x), std::max(last.y, y)};
    }
  }
  if (last.x < 0) return {};
  return {cv::Point(first.x - first.x % 2, first.y - first.y % 2), cv::Point(last.x + 1, last.y + 1)};
}

/// Encodes part of a picture as a WebP file.
std::string encoded(const cv::Mat3b& rgb, const Mask& mask, const cv::Rect& box, Loss loss) {
  WebPConfig config;
  WebPPicture picture;
  if (WebPConfigInit(&config) == 0 || WebPPictureInit(&picture) == 0)
    throw std::runtime_error("libwebp is another one");
  config.lossless = loss == Loss::none ? 1 : 0;
  config.quality = loss == Loss::none ? 50 : quality;  // lossless: search effort
  picture.use_argb = 1;
  picture.width = box.width;
  picture.height = box.height;
  WebPMemoryWriter writer;
  WebPMemoryWriterInit(&writer);
  picture.writer = WebPMemoryWrite;
  picture.custom_ptr = &writer;
  const std::unique_ptr<WebPPicture, void (*)(WebPPicture*)> free_picture(&picture, WebPPictureFree);
  const std::unique_ptr<WebPMemoryWriter, void (*)(WebPMemoryWriter*)> free_bytes(&writer, WebPMemoryWriterClear);
  if (WebPPictureAlloc(&picture) == 0) throw std::bad_alloc();
  for (int y = 0; y < box.height; ++y) {
    for (int x = 0; x < box.width; ++x) {
      const cv::Vec3b& color = rgb(box.y + y, box.x + x);
      const std::uint32_t opaque = mask(box.y + y, box.x + x) != 0 ? 0xFF000000U : 0U;
      picture.argb[static_cast<std::ptrdiff_t>(y) * picture.argb_stride + x] =
          opaque | std::uint32_t{color[0]} << 16U | std::uint32_t{color[1]} << 8U | color[2];
    }
  }
  if (WebPEncode(&config, &picture) == 0) {
    if (picture.error_code == VP8_ENC_ERROR_OUT_OF_MEMORY) throw std::bad_alloc();
    throw std::runtime_error("libwebp cannot encode a frame");
  }
  return {reinterpret_cast<const char*>(writer.mem), writer.size};
}

class WebpAnimation {
 public:
  WebpAnimation(const std::string& file, double fps, cv::Size size) : file_(file, size), fps_(fps) {}

  void add(const cv::Mat& rgb) {
    const cv::Mat3b now = rgb;
    const std::int64_t begin = time_of(count_), end = time_of(++count_);
    if (count_ == 1) {
      begin_film(now);
    } else {
      compare(now);
      change(now, begin, end);
    }
    now.copyTo(before_);
  }

  void finish() { file_.finish(time_of(count_)); }

 private:
  [[nodiscard]] std::int64_t time_of(std::int64_t frame) const {
    return std::llround(1000 * static_cast<double>(frame) / fps_);
  }

  void begin_film(const cv::Mat3b& now) {
    seen_ = cv::Mat3b::zeros(now.size());
    rest_ = cv::Mat1b::zeros(now.size());
    kept_ = cv::Mat1b::zeros(now.size());
    show(now, Mask::ones(now.size()), Loss::some, 0);
  }

  /// Updates for how many frames each pixel has been the same.
  void compare(const cv::Mat3b& now) {
    for (int y = 0; y < now.rows; ++y) {
      for (int x = 0; x < now.cols; ++x) {
        std::uint8_t& rest = rest_(y, x);
        const bool same = now(y, x) == before_(y, x);
        rest = same ? static_cast<std::uint8_t>(std::min(rest + 1, 255)) : std::uint8_t{0};
        if (!same) kept_(y, x) = 0;
      }
    }
  }

  [[nodiscard]] bool is_off(const cv::Mat3b& now, int y, int x) const {
    return difference(now(y, x), seen_(y, x)) > (rest_(y, x) >= at_rest ? seen_at_rest : seen_in_motion);
  }

  /// Returns the resting pixels that are still wrong after they were compressed again.
  [[nodiscard]] Mask stubborn(const cv::Mat3b& now) const {
    Mask mask = Mask::zeros(now.size());
    for (int y = 0; y < now.rows; ++y) {
      for (int x = 0; x < now.cols; ++x) mask(y, x) = kept_(y, x) != 0 && is_off(now, y, x) ? 1 : 0;
    }
    return mask;
  }

  /// Returns all pixels that are wrong.
  /// @param moving set to true if any of them has moved
  [[nodiscard]] Mask off(const cv::Mat3b& now, bool& moving) const {
    Mask mask = Mask::zeros(now.size());
    moving = false;
    for (int y = 0; y < now.rows; ++y) {
      for (int x = 0; x < now.cols; ++x) {
        if (!is_off(now, y, x)) continue;
        mask(y, x) = 1;
        moving = moving || rest_(y, x) < at_rest;
      }
    }
    return mask;
  }

  /// Adds the moving pixels of blocks with many wrong pixels.
  void fill_blocks(Mask& mask) const {
    for (int y = 0; y < mask.rows; y += block) {
      for (int x = 0; x < mask.cols; x += block) {
        const cv::Rect place = cv::Rect(x, y, block, block) & cv::Rect({}, mask.size());
        if (cv::countNonZero(mask(place)) <= place.area() / block) continue;
        cv::bitwise_or(mask(place), (rest_(place) < at_rest) / 255, mask(place));
      }
    }
  }

  void change(const cv::Mat3b& now, std::int64_t begin, std::int64_t end) {
    bool moving = false;
    Mask mask = off(now, moving);
    const bool cut_in_two = end - begin >= 2 * shortest;
    const bool lossless = !moving || (!cut_in_two && count_ % repair_interval == 0 && cv::countNonZero(kept_) > 0);
    if (!lossless) {
      mask.setTo(0, kept_);
      fill_blocks(mask);
    }
    constexpr std::int64_t longest = 10'000'000;  // [ms]; durations have 24 bits
    if (begin - file_.last_begin() > longest) mask(0, 0) = 1;
    show(now, mask, lossless ? Loss::none : Loss::some, begin);
    keep_what_is_off(now, mask);
    if (cut_in_two) show(now, stubborn(now), Loss::none, begin + (end - begin) / 2);
  }

  /// Marks the resting pixels that were just rewritten and are still wrong.
  void keep_what_is_off(const cv::Mat3b& now, const Mask& mask) {
    for (int y = 0; y < now.rows; ++y) {
      for (int x = 0; x < now.cols; ++x) {
        if (mask(y, x) != 0 && rest_(y, x) >= at_rest) kept_(y, x) = is_off(now, y, x) ? 1 : 0;
      }
    }
  }

  /// Encodes the pixels of a mask and updates the viewer's picture; does nothing for an empty mask.
  void show(const cv::Mat3b& now, const Mask& mask, Loss loss, std::int64_t begin) {
    const cv::Rect box = box_of(mask);
    if (box.empty()) return;
    const std::string still = encoded(now, mask, box, loss);
    int width = 0, height = 0;
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(still.data());
    const std::unique_ptr<std::uint8_t, void (*)(void*)> rgba(WebPDecodeRGBA(bytes, still.size(), &width, &height),
                                                              WebPFree);
    if (!rgba) throw std::bad_alloc();
    const cv::Mat4b decoded(height, width, reinterpret_cast<cv::Vec4b*>(rgba.get()));
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const cv::Vec4b& pixel = decoded(y, x);
        if (pixel[3] != 0) seen_(box.y + y, box.x + x) = {pixel[0], pixel[1], pixel[2]};
      }
    }
    file_.show(still, box, begin);
  }

  WebpFile file_;
  double fps_;
  std::int64_t count_ = 0;
  cv::Mat3b before_, seen_;  // previous frame as drawn, and the viewer's picture
  cv::Mat1b rest_;           // frames for which each pixel has been the same
  cv::Mat1b kept_;           // 1: at rest, but wrong after lossy compression
};

/// Encodes a number in `bytes` bytes, little-endian.
std::string little_endian(std::uint64_t number, int bytes) {
  std::string text;
  for (int i = 0; i < bytes; ++i) text += static_cast<char>(number >> (8 * i) & 0xFFU);
  return text;
}

std::string chunk(std::string_view tag, const std::string& content) {
  std::string bytes(tag);
  bytes += little_endian(content.size(), 4) + content;
  return content.size() % 2 == 0 ? bytes : bytes + '\0';
}

/// Returns the chunks of a still picture that an animation uses: its alpha and its pixels.
std::string pixels_of(const std::string& still) {
  constexpr std::size_t head = 8, first = 12;  // sizes of a chunk's header and of the file's [bytes]
  std::string chunks;
  for (std::size_t at = first; at + head <= still.size();) {
    std::uint32_t size = 0;
    for (std::size_t i = 0; i < 4; ++i) size |= std::uint32_t{static_cast<std::uint8_t>(still[at + 4 + i])} << (8 * i);
    const std::string_view tag = std::string_view(still).substr(at, 4);
    const std::size_t whole = head + size + size % 2;
    if (tag == "ALPH" || tag == "VP8 " || tag == "VP8L") chunks += still.substr(at, whole);
    at += whole;
  }
  return chunks;
}

std::string head_of(cv::Size size, std::uint64_t bytes) {
  constexpr char animated = 0x02, transparent = 0x10;
  const auto side = [](int pixels) { return little_endian(static_cast<std::uint64_t>(pixels - 1), 3); };
  const std::string features = std::string(1, animated | transparent) + std::string(3, '\0');
  const std::string black_for_ever = std::string(4, '\0') + std::string(2, '\0');  // background; 0: repeats for ever
  return "RIFF" + little_endian(bytes, 4) + "WEBP" + chunk("VP8X", features + side(size.width) + side(size.height)) +
         chunk("ANIM", black_for_ever);
}

[[noreturn]] void fail() { throw std::runtime_error(std::generic_category().message(errno == 0 ? EIO : errno)); }

WebpFile::WebpFile(const std::string& file, cv::Size size) {
  constexpr int most = 16383;  // limit of libwebp
  if (size.width > most || size.height > most) throw std::runtime_error("a WebP has at most 16383 pixels a side");
  stream_.reset(std::fopen(file.c_str(), "wbe"));
  if (!stream_) fail();
  put(head_of(size, 0));
}

void WebpFile::put(const std::string& bytes) {
  errno = 0;
  if (std::fwrite(bytes.data(), 1, bytes.size(), stream_.get()) != bytes.size()) fail();
  size_ += bytes.size();
}

void WebpFile::write_frame(std::int64_t end) {
  if (frame_.empty()) return;
  const auto three = [](std::int64_t number) { return little_endian(static_cast<std::uint64_t>(number), 3); };
  put(chunk("ANMF", three(place_.x / 2) + three(place_.y / 2) + three(place_.width - 1) + three(place_.height - 1) +
                        three(end - begin_) + std::string(1, '\0') + frame_));
}

void WebpFile::show(const std::string& still, const cv::Rect& place, std::int64_t begin) {
  write_frame(begin);
  frame_ = pixels_of(still);
  place_ = place;
  begin_ = begin;
}

void WebpFile::finish(std::int64_t end) {
  write_frame(end);
  frame_.clear();
  errno = 0;
  const std::string size = little_endian(size_ - 8, 4);  // all but "RIFF" and the size itself
  if (std::fseek(stream_.get(), 4, SEEK_SET) != 0) fail();
  put(size);
  if (std::fflush(stream_.get()) != 0) fail();
}

}  // namespace

AnimationPen begin_webp(const std::string& file, double fps, cv::Size size) {
  const auto animation = std::make_shared<WebpAnimation>(file, fps, size);
  return [animation](const cv::Mat* rgb) { rgb != nullptr ? animation->add(*rgb) : animation->finish(); };
}

}  // namespace drape
