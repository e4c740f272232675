// Interactive pages of a cloth, decoded and drawn by a browser.

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <thread>

#include "drape/core/error.hpp"
#include "output/html_writer.hpp"
#include "output/png_encoder.hpp"
#include "render/camera_path.hpp"
#include "tests/html/html_page.hpp"
#include "tests/support/random.hpp"

namespace drape {
namespace {

class MotionPage : public test::InBrowser {
 protected:
  MotionPage() {
    cloth.velocities = Vertices::Zero(cloth.positions.rows(), 3);
    film.scene = "F <flag>";
    film.fps = 10;
    film.seconds_per_frame = 0.1;
    film.expected_frames = frames;
    film.cloth = &cloth;
    look.color = {1, 0, 0};
    look.sphere_color = {0, 1, 0};
    look.body_color = {0, 0, 1};
    film.look = &look;
  }

  /// Makes a frame of a cloth that swings and stretches, above a falling ball, a turning body, and a ground.
  [[nodiscard]] Frame frame(int k) const {
    const double t = 0.1 * k;
    Frame frame{.index = k, .time = t, .positions = cloth.positions};
    for (auto x : frame.positions.rowwise()) {
      const double s = x[0];
      x[0] = s * (1 + 0.3 * t);
      x[2] = 0.3 * std::sin(2 * s + 5 * t);
    }
    Vertices body = box;
    body.rowwise() += Eigen::RowVector3d(0.6 - 0.1 * t, 0, -0.8);
    frame.colliders = {SphereShape{.center = {-0.6, 0, -0.8 - 0.2 * t}, .radius = 0.3},
                       MeshShape{.triangles = box_triangles, .positions = body},
                       GroundShape{.normal = Eigen::Vector3d::UnitZ(), .height = -1.5}};
    return frame;
  }

  /// Writes all frames and opens the page, waiting for its player.
  template <class FrameAt>
  void write(const FrameAt& at) {
    HtmlWriter writer(path("motion.html"), film);
    for (int k = 0; k < frames; ++k) writer.add(at(k));
    files_ = writer.finish(Ending::complete);
    browser_->set_width(1200);
    browser_->open(path("motion.html"));
    for (int i = 0; i < 200 && state() != "ready"; ++i) {
      ASSERT_NE(state(), "failed") << browser_->run("return document.querySelector('.turn-problem').textContent");
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
    ASSERT_EQ(state(), "ready");
  }
  void write() {
    write([this](int k) { return frame(k); });
  }

  [[nodiscard]] nlohmann::json state() const { return of_turn("dataset.state || ''"); }
  [[nodiscard]] nlohmann::json of_turn(const std::string& what) const {
    return browser_->run("return document.querySelector('.turn')." + what);
  }
  [[nodiscard]] double number(const std::string& name) const {
    return std::stod(of_turn("dataset." + name).get<std::string>());
  }

  /// Returns a mesh's positions in a frame as decoded by the page.
  [[nodiscard]] Vertices decoded(int mesh, int k) const {
    const auto all = browser_->run(
        "const m = document.querySelector('.turn').player.motion;"
        "return [...m.meshes[" +
        std::to_string(mesh) + "].frames[" + std::to_string(k) + "]].map((x, i) => m.origin[i % 3] + m.precision * x)");
    Vertices x(static_cast<Eigen::Index>(all.size()) / 3, 3);
    for (Eigen::Index i = 0; i < x.size(); ++i) x(i / 3, i % 3) = all[static_cast<std::size_t>(i)];
    return x;
  }
  [[nodiscard]] double precision() const { return of_turn("player.motion.precision").get<double>(); }

  /// Counts the picture's pixels in which a colour channel is far above both others.
  [[nodiscard]] int pixels_of(int channel) const {
    return browser_->run(
        "const from = document.querySelector('.turn canvas'), to = document.createElement('canvas');"
        "to.width = from.width; to.height = from.height;"
        "const pen = to.getContext('2d'); pen.drawImage(from, 0, 0);"
        "const p = pen.getImageData(0, 0, to.width, to.height).data, c = " +
        std::to_string(channel) +
        ";"
        "let count = 0; for (let i = 0; i < p.length; i += 4)"
        "  count += p[i + 3] > 200 && p[i + c] > 2 * Math.max(p[i + (c + 1) % 3], p[i + (c + 2) % 3]) && p[i + c] > 60;"
        "return count");
  }

  static constexpr int frames = 12;
  const Mesh grid = make_grid(8, 8);
  Cloth cloth = make_cloth(grid, grid, 1, 10, {});
  const Vertices box = (Vertices(4, 3) << 0, 0, 0, 0.4, 0, 0, 0, 0.4, 0, 0, 0, 0.4).finished();
  const std::shared_ptr<const std::vector<Triangle>> box_triangles =
      std::make_shared<const std::vector<Triangle>>(std::vector<Triangle>{{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {2, 0, 3}});
  Look look;
  FilmInfo film;
  std::vector<OutputFile> files_;
};

TEST_F(MotionPage, IsSoundAndShowsAllThings) {
  write();
  expect_sound();
  EXPECT_EQ(browser_->run("return document.querySelector('h1').textContent"), "F <flag>");
  browser_->set_width(1200);
  for (int channel = 0; channel < 3; ++channel) EXPECT_GT(pixels_of(channel), 300) << channel;
  EXPECT_LT(std::filesystem::file_size(path("motion.html")), 200'000);
  EXPECT_NE(files_.at(0).note.find("mm"), std::string::npos);
  keep_screenshots("motion");
}

TEST_F(MotionPage, HasPositionsToHalfItsPrecision) {
  write();
  const double allowed = 0.5000001 * precision();
  EXPECT_LT(precision(), 0.001);
  for (int k = 0; k < frames; ++k) {
    const Frame truth = frame(k);
    EXPECT_LE((decoded(0, k) - truth.positions).cwiseAbs().maxCoeff(), allowed) << k;
    const Vertices body = decoded(1, k);
    EXPECT_LE((body - std::get<MeshShape>(truth.colliders[1]).positions).cwiseAbs().maxCoeff(), allowed) << k;
  }
  EXPECT_EQ(of_turn("player.motion.balls[10][2]").get<float>(), static_cast<float>(-0.8 - 0.2 * 1.0));
}

// Any numbers are decoded correctly, however they jump.
TEST_F(MotionPage, HasAnyMotionToHalfItsPrecision) {
  std::vector<Vertices> x;
  test::Random random(7);
  for (int k = 0; k < frames; ++k) {
    x.push_back(cloth.positions);
    const double scale = std::pow(10, k - 7);
    for (double& c : x.back().reshaped()) c += scale * random.between(-1, 1);
  }
  x[5] = x[4];
  write([&](int k) { return Frame{.index = k, .time = 0.1 * k, .positions = x[static_cast<std::size_t>(k)]}; });
  for (int k = 0; k < frames; ++k) {
    EXPECT_LE((decoded(0, k) - x[static_cast<std::size_t>(k)]).cwiseAbs().maxCoeff(), 0.5000001 * precision()) << k;
  }
}

TEST_F(MotionPage, HasTheStretchOfVertices) {
  write();
  const VertexStretch stretch(cloth.rest, cloth.triangles);
  for (const int k : {0, 6, 11}) {
    const Eigen::VectorXd truth = stretch(frame(k).positions).array() - 1;
    const auto strains = browser_->run(
        "const m = document.querySelector('.turn').player.motion;"
        "return [...m.strains[" +
        std::to_string(k) + "]].map((e) => m.leastStrain * (2 ** (e / m.strainSteps) - 1))");
    for (Eigen::Index i = 0; i < truth.size(); ++i) {
      EXPECT_NEAR(strains[static_cast<std::size_t>(i)].get<double>(), truth[i], 0.01 * truth[i] + 1e-5);
    }
  }
}

TEST_F(MotionPage, ShowsItsPosterUntilItIsPlayedFromTheStart) {
  // A flat cloth that is folded about a diagonal, most in its frame 7.
  write([this](int k) {
    Frame frame{.index = k, .time = 0.1 * k, .positions = cloth.positions};
    for (auto x : frame.positions.rowwise()) x[2] = (7 - std::abs(k - 7)) * 0.1 * std::abs(x[0] - x[1]);
    return frame;
  });
  EXPECT_EQ(number("frame"), 7);
  EXPECT_EQ(of_turn("querySelector('output').textContent"), "t = 0.70 s");
  EXPECT_EQ(of_turn("querySelector('.moment-slider').value"), "7");
  // A tick of the clock shows a moment near the start.
  browser_->run(
      "window.tick = null; const wait = requestAnimationFrame; window.requestAnimationFrame = (f) => (window.tick = f, "
      "1); document.querySelector('.turn .play').click(); window.requestAnimationFrame = wait;"
      "window.tick(performance.now())");
  EXPECT_LE(number("frame"), 3);
}

TEST_F(MotionPage, PlaysAndScrubs) {
  write();
  browser_->run("const s = document.querySelector('.moment-slider'); s.value = 0; s.dispatchEvent(new Event('input'))");
  EXPECT_EQ(of_turn("querySelector('output').textContent"), "t = 0.00 s");
  browser_->run("document.querySelector('.moment-slider').focus()");
  browser_->press(test::Browser::arrow_right);
  EXPECT_EQ(of_turn("querySelector('output').textContent"), "t = 0.10 s");
  EXPECT_EQ(number("frame"), 1);
  browser_->press("...,");
  EXPECT_EQ(number("frame"), 3);
  browser_->click(".turn .play");
  EXPECT_EQ(of_turn("querySelector('.play').textContent"), "Pause");
  double played = 3;  // kept, since the film repeats
  for (int i = 0; i < 1000 && played == 3; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
    played = number("frame");
  }
  EXPECT_NE(played, 3);
  browser_->click(".turn .play");
  EXPECT_EQ(of_turn("querySelector('.play').textContent"), "Play");
  EXPECT_EQ(of_turn("player.moment % 1"), 0);
}

TEST_F(MotionPage, TurnsByKeysAndPointer) {
  write();
  browser_->run("document.querySelector('.turn canvas').focus()");
  EXPECT_EQ(number("azimuth"), Camera::usual_azimuth);
  browser_->press(test::Browser::arrow_right);
  EXPECT_EQ(number("azimuth"), Camera::usual_azimuth + 5);
  browser_->press("++");
  EXPECT_NEAR(number("zoom"), 1.15 * 1.15, 0.001);
  const int red = pixels_of(0);
  browser_->press("0");
  EXPECT_EQ(number("azimuth"), Camera::usual_azimuth);
  EXPECT_LT(pixels_of(0), red);
  browser_->run(
      "const c = document.querySelector('.turn canvas'), at = (x, y) => ({ pointerId: 1, clientX: x, clientY: y, "
      "bubbles: true });"
      "c.setPointerCapture = () => {};"
      "c.dispatchEvent(new PointerEvent('pointerdown', at(300, 300)));"
      "c.dispatchEvent(new PointerEvent('pointermove', at(400, 250)));"
      "c.dispatchEvent(new PointerEvent('pointerup', at(400, 250)));");
  EXPECT_LT(number("azimuth"), Camera::usual_azimuth - 5) << "what is dragged to the right turns to the right";
  EXPECT_LT(number("elevation"), Camera::usual_elevation) << "dragged up, it is seen from further below";
}

// A ground seen from behind is a veil, below the things or a wall before them.
TEST_F(MotionPage, ShowsThingsThroughAGround) {
  const Camera below{.azimuth = Camera::usual_azimuth, .elevation = -20};
  film.camera = &below;
  write();
  for (int channel = 0; channel < 3; ++channel) EXPECT_GT(pixels_of(channel), 300) << channel;
  keep_screenshots("motion-below");
  film.camera = nullptr;
  write([this](int k) {
    Frame frame = this->frame(k);
    frame.colliders.emplace_back(GroundShape{.normal = Eigen::Vector3d::UnitY(), .height = -1.2});
    return frame;
  });
  for (int channel = 0; channel < 3; ++channel) EXPECT_GT(pixels_of(channel), 300) << channel;
  keep_screenshots("motion-wall");
}

class FirstView : public MotionPage {
 protected:
  /// Returns the view of the film's first frame.
  [[nodiscard]] View of_film(const Camera& camera) const {
    const auto pass = [this](const auto& visit) {
      for (int k = 0; k < frames; ++k) visit(frame(k));
    };
    return camera_path(camera, {.aspect = 1,
                                .fps = film.fps,
                                .count = frames,
                                .triangles = cloth.triangles,
                                .start = cloth.positions,
                                .look = look,
                                .pass = pass})
        .at(0);
  }
  [[nodiscard]] Eigen::Matrix3d axes_of_page() const {
    const auto rows = of_turn("player.orbit.axes()");
    Eigen::Matrix3d axes;
    for (int i = 0; i < 9; ++i)
      axes(i / 3, i % 3) = rows[static_cast<std::size_t>(i / 3)][static_cast<std::size_t>(i % 3)];
    return axes;
  }
};

TEST_F(FirstView, IsThatOfTheFilm) {
  using Eigen::Vector3d;
  const Vector3d z = Vector3d::UnitZ(), y = Vector3d::UnitY();
  const std::vector<Camera> cameras{{.position = Vector3d(3, 2, 1), .target = Vector3d(0, 0, -0.5)},
                                    {.position = Vector3d(-3, 2, -1)},
                                    {.position = Vector3d(0, 0, 5), .target = Vector3d(0, 0, 0)},
                                    {.position = Vector3d(1, 2, 3), .target = Vector3d(0, 0, 0), .up = y},
                                    {.up = {1, 1, -1}, .azimuth = 10, .elevation = 15},
                                    {.azimuth = 50, .elevation = 90},
                                    {.up = -z},
                                    {.up = y},
                                    {}};
  for (const Camera& camera : cameras) {
    film.camera = &camera;
    write();
    const View first = of_film(camera);
    EXPECT_TRUE(axes_of_page().isApprox(first.axes(), 1e-4)) << first.axes();
    browser_->run("document.querySelector('.turn canvas').focus()");
    browser_->press(test::Browser::arrow_right);
    const Eigen::Matrix3d turned = axes_of_page();
    EXPECT_NEAR(turned.row(2).dot(camera.up.normalized()), first.axes().row(2).dot(camera.up.normalized()), 1e-4)
        << "it turns about its up";
    EXPECT_NEAR(turned.row(0).dot(camera.up.normalized()), 0, 1e-4) << "its up is upright";
  }
  EXPECT_FALSE(of_film({}).axes().isApprox(
      of_film({.azimuth = Camera::usual_azimuth, .elevation = Camera::usual_elevation}).axes(), 0.01))
      << "an automatic direction that would be a page's without a film";
}

TEST_F(MotionPage, ColoursByStretch) {
  write();
  browser_->run("document.querySelector('.turn canvas').focus()");
  EXPECT_FALSE(browser_->run("return document.querySelector('.stretch-scale').checkVisibility()").get<bool>());
  EXPECT_GT(pixels_of(0), 300);
  browser_->press("c");
  EXPECT_EQ(pixels_of(0), 0);
  EXPECT_TRUE(browser_->run("return document.querySelector('.stretch-scale').checkVisibility()").get<bool>());
  browser_->press("m.......");
  keep_screenshots("motion-stretch");
}

/// A texture with a green upper half and a blue lower half, on a cloth with shifted coordinates at one corner.
TEST_F(MotionPage, ShowsATexture) {
  Image picture(300, 300);
  for (int y = 0; y < 300; ++y) {
    for (int x = 0; x < 300; ++x) picture.at(x, y)[y < 150 ? 1 : 2] = 255;
  }
  put(path("picture.png"), encode_png(picture));
  look.texture = path("picture.png");
  std::vector<std::array<float, 2>> uvs = grid.uvs;
  film.uvs = &uvs;
  uvs[0] = {0.5F, 0.5F};  // gives its vertex two coordinates
  write([this](int k) { return Frame{.index = k, .time = 0.1 * k, .positions = cloth.positions}; });
  expect_sound();
  browser_->set_width(1200);
  const int green = pixels_of(1), blue = pixels_of(2);
  EXPECT_GT(green, 3000);
  EXPECT_GT(blue, 3000);
  EXPECT_EQ(pixels_of(0), 0) << "the plain colour is covered";
  // v points along +y, away from the viewer at −60°: the upper half is farther away and looks smaller.
  EXPECT_LT(green, blue);
  browser_->run("document.querySelector('.turn canvas').focus()");
  browser_->press("c");
  EXPECT_LT(pixels_of(1), green / 10);
}

TEST_F(MotionPage, RefusesWhatABrowserCannotHold) {
  film.expected_frames = 1'000'000;
  HtmlWriter writer(path("motion.html"), film);
  EXPECT_THROW(writer.add(frame(0)), OutputError);
}

}  // namespace
}  // namespace drape
