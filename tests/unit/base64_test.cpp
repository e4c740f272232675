#include "core/bytes.hpp"

#include <gtest/gtest.h>

#include "tests/support/random.hpp"

namespace drape {
namespace {

TEST(Base64, IsThatOfRfc4648) {
  const std::pair<const char*, const char*> vectors[] = {{"", ""},
                                                         {"f", "Zg=="},
                                                         {"fo", "Zm8="},
                                                         {"foo", "Zm9v"},
                                                         {"foob", "Zm9vYg=="},
                                                         {"fooba", "Zm9vYmE="},
                                                         {"foobar", "Zm9vYmFy"}};
  for (const auto& [bytes, text] : vectors) {
    EXPECT_EQ(base64(bytes), text);
    EXPECT_EQ(from_base64(text), bytes);
  }
}

TEST(Base64, GivesBytesBack) {
  test::Random random(4648);
  for (int size = 0; size < 300; ++size) {
    std::string bytes;
    for (int i = 0; i < size; ++i) bytes += static_cast<char>(random.below(256));
    EXPECT_EQ(from_base64(base64(bytes)), bytes);
  }
}

TEST(Base64, MayBeBrokenIntoLinesAndParts) {
  EXPECT_EQ(from_base64("Zm9v\r\nYm Fy\t"), "foobar");
  EXPECT_EQ(from_base64(base64("f") + base64("oo") + base64("bar")), "foobar");
}

TEST(Base64, HasNoOtherCharacters) {
  for (const char* text : {"Zm9v-", "Zm9v_", "\"", "Zm\xc3\xa9", "{}"}) EXPECT_FALSE(from_base64(text)) << text;
}

}  // namespace
}  // namespace drape
