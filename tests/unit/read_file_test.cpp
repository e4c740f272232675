#include "core/files.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <string>
#include <thread>
#include <utility>

#include "tests/support/scratch_folder.hpp"
#include "tests/support/usage_error.hpp"

namespace drape::test {
namespace {

class ReadFile : public InScratchFolder {
 protected:
  /// Returns the error of a file in the folder, after its name.
  [[nodiscard]] std::string problem(const std::string& name, std::size_t limit = 1000) const {
    const std::string text = usage_error([&] { read_file(path() / name, limit); });
    const std::string start = (path() / name).string() + ": ";
    return text.starts_with(start) ? text.substr(start.size()) : text;
  }
};

TEST_F(ReadFile, ReturnsEveryByte) {
  const std::string bytes("a\0\r\n\xff", 5), many(200'000, 'x');
  EXPECT_EQ(read_file(put(path() / "a", bytes), 1000), bytes);
  EXPECT_EQ(read_file(put(path() / "empty", ""), 1000), "");
  EXPECT_EQ(read_file(put(path() / "many", many), 1'000'000), many);
}

TEST_F(ReadFile, SaysWhyItCannot) {
  put(path() / "a", "text");
  EXPECT_EQ(problem("none"), "no such file");
  EXPECT_EQ(problem("a/b"), "no such file");
  EXPECT_EQ(problem("."), "this is a folder, not a file");
  const std::filesystem::path zero = path() / std::string("a\0b", 3);  // the name does not end at the zero
  EXPECT_EQ(usage_error([&] { read_file(zero, 1000); }), path("a\\x00b") + ": no such file");
  EXPECT_EQ(usage_error([] { read_file("/dev/zero", 1000); }), "/dev/zero: this is a device or socket, not a file");
  if (geteuid() == 0) GTEST_SKIP() << "root may read everything";
  std::filesystem::permissions(path() / "a", std::filesystem::perms::none);
  EXPECT_EQ(problem("a"), "the file cannot be read: Permission denied");
}

TEST_F(ReadFile, TakesForATextWhatHasNoZeroByte) {
  EXPECT_EQ(read_text(put(path() / "text",
                          "\xEF\xBB\xBF"
                          "a\r\n\xff"),
                      1000),
            "a\r\n\xff");
  put(path() / "image", std::string("\x89PNG\0\0", 6));
  EXPECT_EQ(usage_error([&] { read_text(path() / "image", 1000); }),
            path("image") + ": this is a binary file, not a text");
}

TEST_F(ReadFile, TakesAtMostItsLimit) {
  put(path() / "a", std::string(2'000'000, 'x'));
  EXPECT_EQ(read_file(path() / "a", 2'000'000).size(), 2'000'000U);
  EXPECT_EQ(problem("a", 1'999'999), "the file is too large: expected at most 1999999 bytes");
}

TEST_F(ReadFile, ReadsAPipeToItsEndOrItsLimit) {
  const std::string pipe = path("pipe");
  ASSERT_EQ(mkfifo(pipe.c_str(), 0600), 0);
  const std::string bytes(300'000, 'x');
  const auto read_with_writer = [&](std::size_t limit) {
    std::string read;
    std::thread writer([&] {
      const int descriptor = ::open(pipe.c_str(), O_WRONLY);
      const std::size_t size = std::min(bytes.size(), limit + 1);
      for (std::size_t done = 0; done < size;) {
        const ssize_t written = ::write(descriptor, bytes.data() + done, size - done);
        if (written <= 0) break;
        done += static_cast<std::size_t>(written);
      }
      ::close(descriptor);
    });
    const std::string message = usage_error([&] { read = read_file(pipe, limit); });
    writer.join();
    return std::pair(read, message);
  };
  EXPECT_EQ(read_with_writer(1'000'000), std::pair(bytes, std::string("(no error)")));
  EXPECT_EQ(read_with_writer(200'000).second, pipe + ": the file is too large: expected at most 200000 bytes");
}

TEST_F(ReadFile, TakesTextWithAndWithoutAByteOrderMark) {
  EXPECT_EQ(read_text(put(path() / "plain", "größe"), 1000), "größe");
  EXPECT_EQ(read_text(put(path() / "marked", "\xEF\xBB\xBFgröße"), 1000), "größe");
  for (const std::string mark : {"\xFF\xFE", "\xFE\xFF"}) {
    const std::filesystem::path file = put(path() / "wide", mark + std::string("v\0 \0", 4));
    EXPECT_EQ(usage_error([&] { read_text(file, 1000); }),
              file.string() + ": the file is text in UTF-16: save it as UTF-8");
  }
}

}  // namespace
}  // namespace drape::test
