#include "output/codecs/png.hpp"

#include <fmt/format.h>
#include <png.h>
#include <csetjmp>
#include <cstring>
#include <stdexcept>

#include "output/codecs/limits.hpp"

namespace drape {
namespace {

constexpr int compression = 6;  // zlib's default compromise between time and size

/// Message of libpng's last error, which it raises by longjmp.
struct Failure {
  char text[128] = "";
};

[[noreturn]] void fail(png_structp png, png_const_charp message) {
  auto* failure = static_cast<Failure*>(png_get_error_ptr(png));
  std::strncpy(failure->text, message, sizeof failure->text - 1);
  png_longjmp(png, 1);
}

void ignore(png_structp, png_const_charp) {}

void append(png_structp png, png_bytep data, std::size_t size) {
  auto* bytes = static_cast<std::vector<std::uint8_t>*>(png_get_io_ptr(png));
  bytes->insert(bytes->end(), data, data + size);
}

void take(png_structp png, png_bytep data, std::size_t size) {
  auto* left = static_cast<std::string_view*>(png_get_io_ptr(png));
  if (left->size() < size) png_error(png, "ends too soon");
  std::memcpy(data, left->data(), size);
  left->remove_prefix(size);
}

/// Writes a picture. Has no local objects, whose destructors longjmp would skip.
bool write(png_structp png, png_infop info, const cv::Mat& bgr, const std::vector<png_bytep>& rows) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  png_set_compression_level(png, compression);
  png_set_IHDR(png, info, static_cast<png_uint_32>(bgr.cols), static_cast<png_uint_32>(bgr.rows), 8, PNG_COLOR_TYPE_RGB,
               PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
  png_write_info(png, info);
  png_set_bgr(png);
  png_write_image(png, const_cast<png_bytepp>(rows.data()));
  png_write_end(png, info);
  return true;
}

/// Reads the header and sets up the conversion to blue, green, red. Likewise without local objects.
bool begin_reading(png_structp png, png_infop info) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  png_read_info(png, info);
  png_set_expand(png);
  png_set_strip_16(png);
  png_set_strip_alpha(png);
  png_set_gray_to_rgb(png);
  png_set_bgr(png);
  png_set_interlace_handling(png);
  png_read_update_info(png, info);
  return true;
}

bool read(png_structp png, std::vector<png_bytep>& rows) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  png_read_image(png, rows.data());
  png_read_end(png, nullptr);
  return true;
}

std::vector<png_bytep> rows_of(const cv::Mat& picture) {
  std::vector<png_bytep> rows;
  for (int row = 0; row < picture.rows; ++row) rows.push_back(const_cast<png_bytep>(picture.ptr(row)));
  return rows;
}

}  // namespace

std::string png_library() { return fmt::format("libpng {}", png_get_libpng_ver(nullptr)); }

std::vector<std::uint8_t> png_from_bgr(const cv::Mat& bgr) {
  CV_Assert(bgr.type() == CV_8UC3);
  Failure failure;
  png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, &failure, fail, ignore);
  png_infop info = png == nullptr ? nullptr : png_create_info_struct(png);
  if (info == nullptr) throw std::bad_alloc();
  std::vector<std::uint8_t> bytes;
  png_set_write_fn(png, &bytes, append, nullptr);
  const bool written = write(png, info, bgr, rows_of(bgr));
  png_destroy_write_struct(&png, &info);
  if (!written) throw std::runtime_error(failure.text);
  return bytes;
}

bool is_png(std::string_view bytes) { return bytes.starts_with("\x89PNG\r\n\x1a\n"); }

cv::Mat bgr_from_png(std::string_view bytes) {
  Failure failure;
  png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &failure, fail, ignore);
  png_infop info = png == nullptr ? nullptr : png_create_info_struct(png);
  if (info == nullptr) throw std::bad_alloc();
  png_set_read_fn(png, &bytes, take);
  cv::Mat picture;
  bool whole = begin_reading(png, info);
  const std::uint64_t width = png_get_image_width(png, info), height = png_get_image_height(png, info);
  whole = whole && width * height <= most_decoded_pixels && png_get_rowbytes(png, info) == 3 * width;
  if (whole) {
    picture.create(static_cast<int>(height), static_cast<int>(width), CV_8UC3);
    std::vector<png_bytep> rows = rows_of(picture);
    whole = read(png, rows);
  }
  png_destroy_read_struct(&png, &info, nullptr);
  return whole ? picture : cv::Mat();
}

}  // namespace drape
