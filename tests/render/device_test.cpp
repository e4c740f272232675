#include "render/gl/device.hpp"

#include <unistd.h>

#include <cmath>
#include <cstdlib>
#include <string>
#include <thread>

#include "tests/render/backends.hpp"
#include "tests/render/drawing.hpp"

namespace drape::test {
namespace {

class Device : public WithBackend {
 protected:
  static BorrowedDevice borrow() { return borrow_device(data_folder(), GetParam()); }
};

TEST_P(Device, IsThatOfOneUserAlone) {
  const BorrowedDevice one = borrow(), other = borrow();
  EXPECT_NE(one.get(), other.get());
}

TEST_P(Device, GoesFromThreadToThreadWithItsPrograms) {
  const std::vector<std::string> defines{"SPHERES 0"};
  const Program* compiled = nullptr;
  std::thread([&] { compiled = &borrow()->program("cloth", defines); }).join();
  EXPECT_EQ(&borrow()->program("cloth", defines), compiled);
  EXPECT_NE(&borrow()->program("cloth", {"SPHERES 1"}), compiled);
}

TEST_P(Device, IsNotForOthersAfterAnError) {
  borrow()->gl().Enable(GL_TEXTURE_2D);  // invalid in the core profile
  EXPECT_EQ(borrow()->gl().GetError(), static_cast<GLenum>(GL_NO_ERROR));
}

/// Makes Mesa draw on many threads without reading the result, and exits, which must take less than 20 s.
[[noreturn]] void leave_something_unread(GlBackend backend) {
  alarm(20);
  setenv("LP_NUM_THREADS", "16", 1);
  {
    const Mesh mesh = make_grid(2, 2);
    const View view{{2, -4, 2}, {0, 0, 0}, {0, 0, 1}, 30};
    const Renderer renderer(data_folder(), {32, 32}, view, Look{}, 9, mesh.triangles, mesh.uvs, backend);
  }
  std::exit(0);
}

TEST_P(Device, LetsTheProcessEndWhateverNobodyHasRead) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");
  for (int run = 0; run < 6; ++run) {
    EXPECT_EXIT(leave_something_unread(GetParam()), testing::ExitedWithCode(0), "") << "run " << run;
  }
}

/// Draws a picture in each of several looks, with and without a ball and a ground.
template <class Between>
std::vector<Image> pictures(GlBackend backend, Between between) {
  Mesh mesh = make_grid(8, 8);
  for (Eigen::Index i = 0; i < mesh.positions.rows(); ++i) {
    mesh.positions(i, 2) += 0.1 * std::sin(5.0 * static_cast<double>(i));
  }
  const View view{{2, -4, 2}, {0, 0, 0}, {0, 0, 1}, 30};
  Look blue, red, striped, flat;
  blue.color = Rgb{0.1, 0.2, 0.9};
  blue.translucency = 0.9;
  red.color = Rgb{0.9, 0.2, 0.1};
  striped.mesh_lines = true;
  striped.line_color = Rgb{1, 0, 0};
  striped.sphere_color = Rgb{0, 1, 0};
  striped.samples = 1;
  flat.shadows = flat.ambient_occlusion = false;
  flat.ground_color = Rgb{0.5, 0.1, 0.1};
  const std::vector<Collider> ball{SphereShape{{0, 0, -0.5}, 0.4}}, both{ball[0], GroundShape{.height = -1}};
  std::vector<Image> images;
  for (const Look& look : {blue, red, striped, flat}) {
    for (const std::vector<Collider>& colliders : {std::vector<Collider>{}, ball, both}) {
      images.push_back(draw(mesh, view, look, {120, 100}, colliders, backend));
      between();
    }
  }
  return images;
}

// State that a renderer leaves in its programs and in OpenGL must not affect the next one's pictures.
TEST_P(Device, DrawsTheSameBytesWhateverItDrewBefore) {
  std::vector<BorrowedDevice> used;  // while they are held, every renderer gets a new one
  const std::vector<Image> fresh = pictures(GetParam(), [&] { used.push_back(borrow()); });
  used.clear();
  const auto nothing_between = [] {};
  EXPECT_TRUE(pictures(GetParam(), nothing_between) == fresh);
  std::vector<Image> elsewhere;
  std::thread([&] { elsewhere = pictures(GetParam(), nothing_between); }).join();
  EXPECT_TRUE(elsewhere == fresh);
}

INSTANTIATE_TEST_SUITE_P(Backends, Device, both_backends, name_of_backend);

}  // namespace
}  // namespace drape::test
