#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <fstream>
#include <functional>
#include <iterator>
#include <numbers>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>
#include <sstream>

#include "check/check_scene.hpp"
#include "check/golden.hpp"
#include "drape/scene/scene.hpp"
#include "tests/support/files.hpp"
#include "tests/support/scratch_folder.hpp"

// Reliability of the check: changes of every part of a film, as small as plausible mistakes, must be caught and named;
// changes without effect must pass.

namespace drape {
namespace {

namespace fs = std::filesystem;

/// The checked scene: one of the homework in the test's own folder, with its golden from this source tree.
struct Subject {
  fs::path folder;
  std::string file = "5.toml";
  std::vector<std::string> overrides;
  std::vector<std::function<void(LoadedScene&)>> edits;  // of the loaded scene

  [[nodiscard]] fs::path golden() const { return golden_folder(folder / file); }
};

struct Mutation {
  const char* name;
  std::function<void(Subject&)> apply;
  MotionVerdict motion;  // required verdict
  PictureVerdict picture;
};

void PrintTo(const Mutation& mutation, std::ostream* out) { *out << mutation.name; }

using Apply = std::function<void(Subject&)>;

Apply set(const char* override_text) {
  return [=](Subject& subject) { subject.overrides.emplace_back(override_text); };
}

Apply edit(const std::function<void(LoadedScene&)>& change) {
  return [=](Subject& subject) { subject.edits.push_back(change); };
}

Apply cloth(const std::function<void(Cloth&)>& change) {
  return edit([=](LoadedScene& scene) { change(scene.simulation.cloth); });
}

/// Applies a change to the scene with a texture.
Apply textured(const Apply& apply) {
  return [=](Subject& subject) {
    subject.file = "4.toml";
    apply(subject);
  };
}

/// Replaces a text in a file, which must contain it.
void replace(const fs::path& file, const std::string& from, const std::string& to) {
  std::string text = test::content(file);
  const std::size_t at = text.find(from);
  ASSERT_NE(at, std::string::npos) << file << " has no '" << from << "'";
  text.replace(at, from.size(), to);
  std::ofstream(file, std::ios::binary) << text;
}

/// Makes a change of a shader.
Apply shader(const char* file, const char* from, const char* to) {
  return [=](Subject& subject) { replace(subject.folder / "data" / "shaders" / file, from, to); };
}

/// Changes the golden picture of the second frame, as if the film had looked different when it was recorded.
Apply golden_picture_of(const std::function<void(cv::Mat&)>& change) {
  return [=](Subject& subject) {
    const Golden golden = read_golden(subject.golden());
    std::vector<Png> pictures;
    for (const GoldenFrame& frame : golden.frames) {
      const std::string file = golden_picture(subject.golden(), frame.frame).string();
      if (&frame == &golden.frames[1]) {
        cv::Mat picture = cv::imread(file);
        ASSERT_FALSE(picture.empty());
        change(picture);
        cv::imwrite(file, picture);
      }
      pictures.push_back(test::content(file));
    }
    write_golden(subject.golden(), golden, pictures);
  };
}

/// Moves the camera sideways so that the middle of the picture moves by some pixels.
void shift_camera(LoadedScene& scene, double pixels) {
  const Golden golden = read_golden(golden_folder(scene.source.file));
  const View view = golden.frames.front().view;
  const double distance = (view.position - view.target).norm();
  const double height = 2 * distance * std::tan(view.field_of_view / 2 * std::numbers::pi / 180);
  const Eigen::Vector3d aside = view.axes().row(0).transpose() * (pixels * height / golden.size.y());
  scene.camera.position = view.position + aside;
  scene.camera.target = view.target + aside;
  scene.camera.up = view.up;
}

/// Turns the camera about the vertical axis through its target.
void turn_camera(LoadedScene& scene, double degrees) {
  const View view = read_golden(golden_folder(scene.source.file)).frames.front().view;
  const Eigen::AngleAxisd turn(degrees * std::numbers::pi / 180, Eigen::Vector3d::UnitZ());
  scene.camera.position = view.target + turn * (view.position - view.target);
  scene.camera.target = view.target;
  scene.camera.up = view.up;
}

void swap_texture_axes(LoadedScene& scene) {
  for (auto& uv : scene.uvs) std::swap(uv[0], uv[1]);
}

constexpr auto same_bits = MotionVerdict::same_bits;
constexpr auto moved = MotionVerdict::changed;
constexpr auto exact = PictureVerdict::exact;
constexpr auto altered = PictureVerdict::changed;

const std::vector<Mutation> mutations{
    // Changes of appearance only.
    {"LightOnePercentBrighter", shader("lighting.glsl", "const vec3 key_light = ", "const vec3 key_light = 1.01 * "),
     same_bits, altered},
    {"ADotOfFourByFourPixels",
     golden_picture_of([](cv::Mat& p) { p(cv::Rect(200, 40, 4, 4)) = cv::Scalar(200, 200, 200); }), same_bits, altered},
    {"APictureShiftedByATenthOfAPixel", edit([](LoadedScene& scene) { shift_camera(scene, 0.1); }), same_bits, altered},
    {"TheCameraTurnedByAFiftiethOfADegree", edit([](LoadedScene& scene) { turn_camera(scene, 0.02); }), same_bits,
     altered},
    {"AMarginOneThousandthWider", set("camera.margin=0.061"), same_bits, altered},
    {"AFieldOfViewOfThirtyOneDegrees", set("camera.field_of_view=31"), same_bits, altered},
    {"SwappedTextureAxes", textured(edit(swap_texture_axes)), same_bits, altered},
    {"AMirroredTexture", textured(edit([](LoadedScene& scene) {
       for (auto& uv : scene.uvs) uv[0] = 1 - uv[0];
     })),
     same_bits, altered},
    {"NoTexture", textured(set("look.texture=\"\"")), same_bits, altered},
    {"OneMissingTriangle", edit([](LoadedScene& scene) {
       scene.simulation.cloth.triangles.erase(scene.simulation.cloth.triangles.begin() + 210);
       scene.uvs.erase(scene.uvs.begin() + 630, scene.uvs.begin() + 633);
     }),
     same_bits, altered},
    {"AnotherPalette", golden_picture_of([](cv::Mat& p) {
       cv::Mat swapped;
       cv::cvtColor(p, swapped, cv::COLOR_BGR2RGB);
       swapped.copyTo(p);
     }),
     same_bits, altered},
    {"AClothOneStepYellower", set("look.color=#d9a722"), same_bits, altered},
    {"ABackgroundOneStepDarker", set("look.background_top=#a7b4c3"), same_bits, altered},
    {"NoMeshLines", set("look.mesh_lines=false"), same_bits, altered},
    {"MeshLinesATenthWider", set("look.line_width=0.88"), same_bits, altered},
    {"ASphereOfAnotherRed", set("look.sphere_color=#c30a0a"), same_bits, altered},
    {"OutlinesOfFourSamples", set("look.samples=4"), same_bits, altered},
    {"AFilmThatRunsOnePercentFaster", set("video.speed=1.01"), same_bits, altered},
    {"NormalsTheOtherWayRound", shader("cloth.vert", "world_normal = normal", "world_normal = -normal"), same_bits,
     altered},
    // Changes of motion only.
    {"StiffnessATenthOfAPercentHigher", set("cloth.stiffness=180.18"), moved, exact},
    {"AMassATenthOfAPercentHigher", set("cloth.mass=1.001"), moved, exact},
    {"GravityOfTheNextDigit", set("effects.gravity.acceleration=[0, 0, -9.81]"), moved, exact},
    {"OneStepMore", set("time.duration=8.36"), moved, exact},
    {"AStepOnePerMilleLonger", set("time.step=0.02002"), moved, exact},
    {"ALooserTolerance", set("integrator.tolerance=1.1e-3"), moved, exact},
    {"AnotherMethod", set("integrator.method=quasi-newton"), moved, exact},
    {"OneVertexMovedByATenthOfAMillimetre", cloth([](Cloth& c) { c.positions(230, 0) += 1e-4; }), moved, exact},
    {"OneSpringATenthOfAPercentLonger", cloth([](Cloth& c) { c.springs[600].rest_length *= 1.001; }), moved, exact},
    {"OneMissingSpring", cloth([](Cloth& c) { c.springs.erase(c.springs.begin() + 600); }), moved, exact},
    {"OneVertexAPercentHeavier", cloth([](Cloth& c) { c.masses[220] *= 1.01; }), moved, exact},
    {"OnePinMore", cloth([](Cloth& c) { c.pins.push_back(440); }), moved, exact},
    {"APinThatSlipped", set("cloth.pins=[0]"), moved, exact},
    {"ABitOfDamping", set("effects.damping.factor=0.999"), moved, exact},
    {"AStartWithAHundredthOfAMillimetrePerSecond", set("cloth.velocity=[0, 0, 1e-5]"), moved, exact},
    {"ASphereOnePerTenThousandStiffer", set("effects.sphere.stiffness=8000.8"), moved, exact},
    // Changes of both.
    {"ASphereOneMillimetreLarger", set("effects.sphere.radius=0.401"), moved, altered},
    {"ACoarserMesh", set("cloth.mesh={grid = [19, 19]}"), moved, altered},
};

class MutationTest : public test::InScratchFolder {
 protected:
  MutationTest() {
    const fs::path source = DRAPE_SOURCE_DIR;
    subject_.folder = folder_;
    for (const char* scene : {"4", "5"}) {
      fs::copy(source / "scenes/homework" / (std::string(scene) + ".toml"), folder_);
      fs::copy(source / "scenes/homework" / (std::string(scene) + ".golden"),
               folder_ / (std::string(scene) + ".golden"), fs::copy_options::recursive);
    }
    fs::create_directories(folder_ / "data");
    fs::copy(source / "shaders", folder_ / "data/shaders", fs::copy_options::recursive);
    fs::create_directory_symlink(source / "textures", folder_ / "data/textures");
    use_data_folder(folder_ / "data");
  }
  ~MutationTest() override { use_data_folder({}); }

  [[nodiscard]] SceneResult check() const {
    LoadedScene scene = load_scene(subject_.folder / subject_.file, subject_.overrides);
    for (const auto& change : subject_.edits) change(scene);
    CheckOptions options;
    options.update = UpdateMode::none;
    Progress progress;
    return check_scene(scene, scene.name, scene.check, options, {}, progress);
  }

  Subject subject_;
};

class Caught : public MutationTest, public ::testing::WithParamInterface<Mutation> {};
INSTANTIATE_TEST_SUITE_P(Mutation, Caught, ::testing::ValuesIn(mutations),
                         [](const auto& tested) { return std::string(tested.param.name); });

TEST_P(Caught, WithTheRightVerdict) {
  GetParam().apply(subject_);
  const SceneResult result = check();
  EXPECT_EQ(result.verdict, SceneVerdict::changed);
  EXPECT_STREQ(verdict_name(result.windows.motion), verdict_name(GetParam().motion));
  EXPECT_STREQ(verdict_name(result.windows.picture), verdict_name(GetParam().picture));
  EXPECT_FALSE(result.findings.empty());
}

/// A change of files without effect.
struct Harmless {
  const char* name;
  Apply apply;
};

void PrintTo(const Harmless& harmless, std::ostream* out) { *out << harmless.name; }

/// Rewrites the golden pictures with another compression, and thus other bytes.
Apply compressed(int level) {
  return [=](Subject& subject) {
    for (const auto& entry : fs::directory_iterator(subject.golden() / "frames")) {
      const std::string before = test::content(entry.path());
      const cv::Mat picture = cv::imread(entry.path().string());
      cv::imwrite(entry.path().string(), picture, {cv::IMWRITE_PNG_COMPRESSION, level});
      EXPECT_NE(test::content(entry.path()), before);
    }
  };
}

/// Reverses the order of the scene's tables.
void reverse_tables(Subject& subject) {
  const fs::path file = subject.folder / subject.file;
  std::istringstream lines(test::content(file));
  std::vector<std::string> blocks(1);
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("[")) blocks.emplace_back();
    blocks.back() += line + "\n";
  }
  ASSERT_GT(blocks.size(), 6u);
  std::ofstream out(file, std::ios::binary);
  for (auto block = blocks.rbegin(); block != blocks.rend(); ++block) out << *block << "\n";
}

const std::vector<Harmless> harmless{
    {"PngCompressionNone", compressed(0)},
    {"PngCompressionBest", compressed(9)},
    {"OrderOfTables", reverse_tables},
    {"OrderOfKeys",
     [](Subject& subject) {
       replace(subject.folder / "5.toml", "mass = 1\nstiffness = 180\n", "stiffness = 180\nmass = 1\n");
     }},
    {"CommentsAndBlankLines",
     [](Subject& subject) { replace(subject.folder / "5.toml", "[time]", "# A remark.\n\n\n[time] # and another"); }},
    {"WaysToWriteANumber",
     [](Subject& subject) {
       replace(subject.folder / "5.toml", "step = 0.02", "step = 2e-2");
       replace(subject.folder / "5.toml", "stiffness = 180", "stiffness = 1_80.0");
     }},
    {"AValueThatIsTheDefault", set("look.samples=1")},
    {"SpacesInShaders", shader("cloth.frag", "void main() {", "void main()   {\n  // a remark\n")},
};

class Passed : public MutationTest, public ::testing::WithParamInterface<Harmless> {};
INSTANTIATE_TEST_SUITE_P(Harmless, Passed, ::testing::ValuesIn(harmless),
                         [](const auto& tested) { return std::string(tested.param.name); });

TEST_P(Passed, WithoutAWord) {
  GetParam().apply(subject_);
  const SceneResult result = check();
  EXPECT_EQ(result.verdict, SceneVerdict::passed);
  EXPECT_EQ(result.windows.motion, same_bits);
  EXPECT_NE(result.windows.picture, altered);
  EXPECT_TRUE(result.findings.empty());
}

}  // namespace
}  // namespace drape
