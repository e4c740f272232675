// Goldens recorded by another program: the scene is the same, but its results differ.

#include <gtest/gtest.h>

#include "check/golden.hpp"
#include "tests/check/checked_scene.hpp"

namespace drape {
namespace {

class AnotherProgram : public test::CheckedScene {
 protected:
  /// Rewrites the golden with a change, keeping its pictures.
  template <class Change>
  void record_otherwise(const Change& change) {
    Golden other = read_golden(golden());
    std::vector<Png> pictures;
    for (const GoldenFrame& frame : other.frames) {
      pictures.push_back(test::content(golden_picture(golden(), frame.frame)));
    }
    change(other);
    write_golden(golden(), other, pictures);
  }
};

// As if the automatic camera of the time had left a wider margin than the scene requests.
TEST_F(AnotherProgram, ThatFramedTheMotionOtherwiseIsSeen) {
  const LoadedScene wider = scene({"camera.margin=0.2"});
  bless_scene(wider, wider.check, GlBackend::automatic, {}, progress_);
  record_otherwise([&](Golden& golden) {
    golden.camera = scene().camera;
    golden.scene_digest = scene().source.digest;
  });
  const SceneResult result = check();
  EXPECT_FALSE(result.scene_changed);
  EXPECT_EQ(result.windows.motion, MotionVerdict::same_bits);
  EXPECT_EQ(result.windows.picture, PictureVerdict::changed);
  EXPECT_EQ(result.verdict, SceneVerdict::changed);
}

// The motion has the same bits: only the recorded energies reveal it.
TEST_F(AnotherProgram, ThatHadOtherEnergiesIsSeen) {
  bless();
  ASSERT_EQ(check().verdict, SceneVerdict::passed);
  for (double Energies::*energy : {&Energies::kinetic, &Energies::gravity, &Energies::elastic}) {
    bless();
    record_otherwise([&](Golden& golden) { golden.windows[1].energies.*energy += 1e-6; });
    const SceneResult result = check();
    EXPECT_EQ(result.windows.motion, MotionVerdict::changed);
    ASSERT_EQ(result.findings.size(), 1U);
    const std::string text = sentences(result)[0];
    EXPECT_NE(text.find("energies"), std::string::npos) << text;
  }
}

}  // namespace
}  // namespace drape
