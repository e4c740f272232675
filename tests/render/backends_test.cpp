#include <gtest/gtest.h>
#include <link.h>

#include "drape/core/error.hpp"
#include "drape/scene/scene.hpp"
#include "drape/sim/simulation.hpp"
#include "render/gl/context.hpp"
#include "tests/render/backends.hpp"
#include "tests/render/drawing.hpp"

namespace drape::test {
namespace {

/// Returns true if a library whose file name contains `part` is loaded.
bool is_loaded(std::string_view part) {
  return dl_iterate_phdr(
             [](dl_phdr_info* info, std::size_t, void* wanted) {
               return std::string_view(info->dlpi_name).find(*static_cast<std::string_view*>(wanted)) !=
                              std::string_view::npos
                          ? 1
                          : 0;
             },
             &part) != 0;
}

/// A homework scene's cloth after `steps`, seen from the side.
class Moment {
 public:
  Moment(const std::string& name, int steps)
      : scene_(load_scene(data_folder() / "scenes/homework" / (name + ".toml"))), simulation_(scene_.simulation) {
    for (int i = 0; i < steps; ++i) simulation_.step();
    frame_.positions = simulation_.state().x;
    frame_.colliders = simulation_.colliders(simulation_.time());
  }

  [[nodiscard]] Renderer renderer(GlBackend backend) const {
    return {data_folder(),
            scene_.video.size,
            View{{3.2, -5.5, 1.6}, {0, 0, -0.6}, {0, 0, 1}, 30},
            scene_.look,
            simulation_.cloth().vertex_count(),
            simulation_.cloth().triangles,
            scene_.uvs,
            backend};
  }
  [[nodiscard]] const Frame& frame() const { return frame_; }

 private:
  Scene scene_;
  Simulation simulation_;
  Frame frame_;
};

class Backends : public ::testing::TestWithParam<const char*> {};

TEST_P(Backends, DrawTheSameBytes) {
  SKIP_WITHOUT(GlBackend::osmesa);
  SKIP_WITHOUT(GlBackend::egl);
  for (const int steps : {1, 40, 120}) {
    const Moment moment(GetParam(), steps);
    const Image by_osmesa = moment.renderer(GlBackend::osmesa).draw(moment.frame());
    const Image by_egl = moment.renderer(GlBackend::egl).draw(moment.frame());
    ASSERT_EQ(by_osmesa.pixels.size(), by_egl.pixels.size());
    EXPECT_EQ(by_osmesa, by_egl) << "after " << steps << " steps";
  }
}

INSTANTIATE_TEST_SUITE_P(Homework, Backends, ::testing::Values("1", "2", "3", "4", "5"));

TEST(GlBackends, DrawInTurnsOnOneThread) {
  SKIP_WITHOUT(GlBackend::osmesa);
  SKIP_WITHOUT(GlBackend::egl);
  const Moment moment("5", 40);
  Renderer osmesa = moment.renderer(GlBackend::osmesa), egl = moment.renderer(GlBackend::egl);
  const Image first = osmesa.draw(moment.frame());
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(egl.draw(moment.frame()), first);
    EXPECT_EQ(osmesa.draw(moment.frame()), first);
  }
}

// Each test of this program is a process of its own, so nothing else has loaded a library.
TEST(GlBackends, LoadOnlyTheirOwnLibrary) {
  ASSERT_FALSE(is_loaded("libEGL")) << "something else loads EGL";
  ASSERT_FALSE(is_loaded("libOSMesa"));
  SKIP_WITHOUT(GlBackend::egl);
  EXPECT_TRUE(is_loaded("libEGL"));
  EXPECT_FALSE(is_loaded("libOSMesa"));
  SKIP_WITHOUT(GlBackend::osmesa);
  EXPECT_TRUE(is_loaded("libOSMesa"));
}

TEST(GlContext, NamesTheDebianPackagesIfEglIsMissing) {
  try {
    make_egl_context({"libEGL_that_is_not_there.so"});
    FAIL() << "a context came from nowhere";
  } catch (const OutputError& error) {
    EXPECT_NE(std::string(error.what()).find("libegl1 libgl1-mesa-dri"), std::string::npos) << error.what();
  }
}

}  // namespace
}  // namespace drape::test
