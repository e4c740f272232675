#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <vector>

#include "tests/render/drawing.hpp"

namespace drape::test {
namespace {

/// Returns a picture's bytes, drawn by a new process with an environment variable: Mesa reads it only once.
std::vector<std::uint8_t> drawn_with(const char* variable, const char* value) {
  int ends[2];
  if (pipe(ends) != 0) return {};
  const pid_t child = fork();
  if (child == 0) {
    setenv(variable, value, 1);
    Look look;
    look.texture = data_folder() / "textures/plaid.png";
    Mesh mesh = make_grid(20, 20);
    for (Eigen::Index i = 0; i < mesh.positions.rows(); ++i) {
      mesh.positions(i, 2) = 0.2 * std::sin(4 * mesh.positions(i, 0)) * std::cos(3 * mesh.positions(i, 1));
    }
    const View view{{2, -4, 2}, {0, 0, 0}, {0, 0, 1}, 30};
    const Image image =
        draw(mesh, view, look, {240, 200}, {SphereShape{{0.3, -0.4, 0.3}, 0.4}, GroundShape{{0, 0, 1}, -0.8, 0.01}});
    const auto size = static_cast<ssize_t>(image.pixels.size());
    ssize_t written = 0;
    while (written < size) {
      const ssize_t count = write(ends[1], image.pixels.data() + written, static_cast<std::size_t>(size - written));
      if (count <= 0) break;
      written += count;
    }
    _exit(written == size ? 0 : 1);
  }
  close(ends[1]);
  std::vector<std::uint8_t> bytes(3 * 240 * 200 + 1);
  std::size_t received = 0;
  for (ssize_t count = 1; count > 0 && received < bytes.size(); received += static_cast<std::size_t>(count)) {
    count = read(ends[0], bytes.data() + received, bytes.size() - received);
    if (count < 0) break;
  }
  close(ends[0]);
  int status = -1;
  waitpid(child, &status, 0);
  EXPECT_EQ(status, 0);
  bytes.resize(received);
  return bytes;
}

/// Returns true if other tests have started Mesa's threads: a process must not fork after that.
bool has_threads() {
  return std::distance(std::filesystem::directory_iterator("/proc/self/task"), std::filesystem::directory_iterator()) >
         1;
}

TEST(Threads, OfMesaChangeNoByte) {
  if (has_threads()) GTEST_SKIP() << "must run in a process of its own, as under ctest";
  const std::vector<std::uint8_t> none = drawn_with("LP_NUM_THREADS", "0");
  ASSERT_EQ(none.size(), std::size_t{3} * 240 * 200);
  EXPECT_EQ(none, drawn_with("LP_NUM_THREADS", "1"));
  EXPECT_EQ(none, drawn_with("LP_NUM_THREADS", "2"));
  EXPECT_EQ(none, drawn_with("LP_NUM_THREADS", "5"));
}

// With vectors of 128 bits Mesa uses neither AVX nor fused multiply-adds, as on a processor without them.
TEST(Threads, AndVectorsOfOtherProcessorsChangeNoByte) {
  if (has_threads()) GTEST_SKIP() << "must run in a process of its own, as under ctest";
  const std::vector<std::uint8_t> narrow = drawn_with("LP_NATIVE_VECTOR_WIDTH", "128");
  ASSERT_EQ(narrow.size(), std::size_t{3} * 240 * 200);
  EXPECT_EQ(narrow, drawn_with("LP_NATIVE_VECTOR_WIDTH", "256"));
}

}  // namespace
}  // namespace drape::test
