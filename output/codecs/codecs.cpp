#include "output/codecs/codecs.hpp"

#include <fmt/format.h>
#include <png.h>
#include <array>
#include <csetjmp>
#include <cstddef>
#include <cstdio>  // jpeglib.h needs it
#include <cstring>
#include <mutex>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <optional>
#include <stdexcept>

#include <jerror.h>
#include <jpeglib.h>

#include "core/console.hpp"
#include "core/installation.hpp"
#include "drape/core/error.hpp"

namespace drape {

std::filesystem::path codecs_module() {
  std::vector<std::filesystem::path> roots = installation_roots();
  roots.push_back(configured_prefix());
  std::error_code error;
  for (const auto& root : roots) {
    if (auto file = root / DRAPE_CODECS_MODULE; std::filesystem::exists(file, error)) return file;
  }
  throw OutputError(
      fmt::format("cannot encode or decode: a part of drape is missing, {}; it is built and installed with the program",
                  ((roots.size() > 2 ? roots[1] : roots.back()) / DRAPE_CODECS_MODULE).string()));
}

const Codecs& codecs() {
  static const Codecs* const loaded = [] {
    const SharedLibrary module("codecs", {codecs_module().string()}, "libopencv-dev", "encode or decode");
    const Codecs* (*get)(std::mutex & console) = nullptr;
    module.fetch("drape_codecs", get);
    return get(console_mutex());
  }();
  return *loaded;
}

cv::Mat decode_picture(std::string_view bytes, int flags) {
  if (is_png(bytes)) return bgr_from_png(bytes);
  if (is_jpeg(bytes)) return bgr_from_jpeg(bytes, (flags & cv::IMREAD_IGNORE_ORIENTATION) == 0);
  return codecs().decode(bytes, flags);
}

namespace {

/// Most pixels of a picture that is decoded. A file that claims more is taken for damaged.
constexpr std::uint64_t most_decoded_pixels = std::uint64_t{1} << 30;

constexpr int png_compression = 6;  // zlib's default compromise between time and size

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
  png_set_compression_level(png, png_compression);
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

namespace {

constexpr int exif_marker = JPEG_APP0 + 1;
constexpr unsigned longest_marker = 0xFFFF;

/// State of libjpeg, which raises errors by a function that must not return.
struct Reader {
  jpeg_decompress_struct info;
  jpeg_error_mgr errors;
  std::jmp_buf damaged;
};

[[noreturn]] void end_reading(j_common_ptr info) { std::longjmp(static_cast<Reader*>(info->client_data)->damaged, 1); }

void say_nothing(j_common_ptr) {}

/// Takes libjpeg's warnings: that the file ends too soon is an error here, as the rest would be grey.
void warn(j_common_ptr info, int) {
  if (info->err->msg_code == JWRN_JPEG_EOF) end_reading(info);
}

/// Reads the header and chooses blue, green, red, or the four inks. Has no local objects, whose destructors longjmp
/// would skip.
bool begin_jpeg(Reader& reader, std::string_view bytes) {
  reader.info.err = jpeg_std_error(&reader.errors);
  reader.errors.error_exit = end_reading;
  reader.errors.output_message = say_nothing;
  reader.errors.emit_message = warn;
  reader.info.client_data = &reader;
  if (setjmp(reader.damaged) != 0) return false;
  jpeg_create_decompress(&reader.info);
  jpeg_mem_src(&reader.info, reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size());
  jpeg_save_markers(&reader.info, exif_marker, longest_marker);
  if (jpeg_read_header(&reader.info, TRUE) != JPEG_HEADER_OK) return false;
  reader.info.out_color_space = reader.info.num_components == 4 ? JCS_CMYK : JCS_EXT_BGR;
  return true;
}

/// Reads all rows. Likewise without local objects.
bool read_jpeg(Reader& reader, std::vector<JSAMPROW>& rows) {
  if (setjmp(reader.damaged) != 0) return false;
  jpeg_start_decompress(&reader.info);
  while (reader.info.output_scanline < reader.info.output_height) {
    jpeg_read_scanlines(&reader.info, rows.data() + reader.info.output_scanline,
                        reader.info.output_height - reader.info.output_scanline);
  }
  jpeg_finish_decompress(&reader.info);
  return true;
}

/// Returns the picture of inks that are stored inverted, as Adobe's programs do: 255 is white.
cv::Mat bgr_of_inks(const cv::Mat& inks) {
  cv::Mat bgr(inks.size(), CV_8UC3);
  for (int row = 0; row < inks.rows; ++row) {
    const std::uint8_t* from = inks.ptr(row);
    std::uint8_t* to = bgr.ptr(row);
    for (int column = 0; column < inks.cols; ++column, from += 4, to += 3) {
      for (int i = 0; i < 3; ++i) to[i] = static_cast<std::uint8_t>(from[2 - i] * from[3] / 255);
    }
  }
  return bgr;
}

/// Returns the Exif orientation, 1 to 8: the tag 0x0112 of the first directory of a TIFF file (Exif 2.32,
/// section 4.6.4); 1 if there is none.
int orientation(std::string_view exif) {
  constexpr std::string_view begins{"Exif\0\0", 6};
  if (!exif.starts_with(begins)) return 1;
  const std::string_view tiff = exif.substr(begins.size());
  const bool little = tiff.starts_with("II");
  const auto number = [&](std::size_t at, std::size_t count) {
    std::size_t value = 0;
    if (at > tiff.size() || tiff.size() - at < count) return value;
    for (std::size_t i = 0; i < count; ++i) {
      value = value << 8 | static_cast<unsigned char>(tiff[at + (little ? count - 1 - i : i)]);
    }
    return value;
  };
  const std::size_t directory = number(4, 4), entries = number(directory, 2);
  for (std::size_t i = 0; i < entries; ++i) {
    const std::size_t entry = directory + 2 + 12 * i;
    if (number(entry, 2) != 0x0112) continue;
    const std::size_t value = number(entry + 8, 2);
    return value >= 1 && value <= 8 ? static_cast<int>(value) : 1;
  }
  return 1;
}

/// Returns the Exif orientation of a JPEG file whose header was read.
int orientation(const Reader& reader) {
  const jpeg_marker_struct* exif = reader.info.marker_list;
  return exif == nullptr ? 1 : orientation({reinterpret_cast<const char*>(exif->data), exif->data_length});
}

/// Turns a picture upright.
cv::Mat upright(const cv::Mat& picture, int orientation) {
  constexpr int across = 1, down = 0, both = -1;  // codes of cv::flip
  static const std::array<std::optional<int>, 4> flips{std::nullopt, across, both, down};
  cv::Mat turned = picture;
  if (orientation > 4) cv::transpose(picture, turned);
  if (const auto flip = flips[static_cast<std::size_t>((orientation - 1) % 4)]) cv::flip(turned.clone(), turned, *flip);
  return turned;
}

}  // namespace

bool is_jpeg(std::string_view bytes) { return bytes.starts_with("\xFF\xD8\xFF"); }

bool is_upright_rgb_jpeg(std::string_view bytes) {
  if (!is_jpeg(bytes)) return false;
  Reader reader{};
  const bool plain = begin_jpeg(reader, bytes) && reader.info.num_components == 3 && orientation(reader) == 1;
  jpeg_destroy_decompress(&reader.info);
  return plain;
}

cv::Mat bgr_from_jpeg(std::string_view bytes, bool turns) {
  Reader reader{};
  cv::Mat picture;
  int turn = 1;
  bool whole = begin_jpeg(reader, bytes);
  const std::uint64_t width = reader.info.image_width, height = reader.info.image_height;
  whole = whole && width * height <= most_decoded_pixels;
  if (whole) {
    if (turns) turn = orientation(reader);
    const int type = reader.info.out_color_space == JCS_CMYK ? CV_8UC4 : CV_8UC3;
    picture.create(static_cast<int>(height), static_cast<int>(width), type);
    std::vector<JSAMPROW> rows;
    for (int row = 0; row < picture.rows; ++row) rows.push_back(picture.ptr(row));
    whole = read_jpeg(reader, rows);
  }
  jpeg_destroy_decompress(&reader.info);
  if (!whole) return {};
  return upright(picture.type() == CV_8UC4 ? bgr_of_inks(picture) : picture, turn);
}

}  // namespace drape
