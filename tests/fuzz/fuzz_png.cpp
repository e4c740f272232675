// A golden picture of 20 by 16 pixels.

#include <stdexcept>

#include "check/picture.hpp"
#include "tests/fuzz/accepts_or_refuses.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  drape::accepts_or_refuses<std::invalid_argument>([&] {
    const drape::Image image = drape::decode_png({reinterpret_cast<const char*>(data), size}, {20, 16});
    if (image.width != 20 || image.height != 16 || image.pixels.size() != std::size_t{3} * 20 * 16) std::abort();
  });
  return 0;
}
