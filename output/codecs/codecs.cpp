#include "output/codecs/codecs.hpp"

#include <fmt/format.h>
#include <mutex>
#include <opencv2/imgcodecs.hpp>

#include "core/console.hpp"
#include "core/installation.hpp"
#include "drape/core/error.hpp"
#include "output/codecs/jpeg.hpp"
#include "output/codecs/png.hpp"

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

}  // namespace drape
