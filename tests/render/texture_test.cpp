#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "drape/core/error.hpp"
#include "drape/render/image.hpp"
#include "tests/render/drawing.hpp"
#include "tests/support/files.hpp"

namespace drape::test {
namespace {

/// A file in the temporary folder, removed with the object.
class TemporaryFile {
 public:
  TemporaryFile(const std::string& name, const std::string& bytes)
      : path_(std::filesystem::path(testing::TempDir()) / (std::to_string(getpid()) + name)) {
    std::ofstream(path_, std::ios::binary) << bytes;
  }
  ~TemporaryFile() { std::filesystem::remove(path_); }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// Returns a PPM image with one character per pixel: '#' is black, anything else white.
std::string ppm(const std::vector<std::string>& rows) {
  std::string bytes = "P6\n" + std::to_string(rows[0].size()) + " " + std::to_string(rows.size()) + "\n255\n";
  for (const std::string& row : rows) {
    for (const char c : row) bytes.append(3, c == '#' ? '\0' : '\xff');
  }
  return bytes;
}

std::string message_of(const std::filesystem::path& texture) {
  Look look;
  look.texture = texture;
  try {
    draw(make_grid(1, 1), from_above(), look);
  } catch (const UsageError& error) {
    return error.what();
  }
  return "no UsageError";
}

TEST(Texture, IsUprightAndNotMirroredOnTheFront) {
  const std::vector<std::string> letter{"........",  //
                                        ".######.",  //
                                        ".#......",  //
                                        ".#......",  //
                                        ".####...",  //
                                        ".#......",  //
                                        ".#......",  //
                                        "........"};
  const TemporaryFile file("letter.ppm", ppm(letter));
  Look look;
  look.texture = file.path();
  const Image image = draw(make_grid(3, 3), from_above(), look, {160, 160});
  for (int row = 0; row < 8; ++row) {
    for (int column = 0; column < 8; ++column) {
      const int value = image.at(20 * column + 10, 20 * row + 10)[1];
      const bool black = letter[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)] == '#';
      EXPECT_EQ(value < 128, black) << "row " << row << ", column " << column << " is " << value;
    }
  }
}

TEST(Texture, IsMinifiedInLinearLight) {
  const TemporaryFile file("checker.ppm", ppm({"#.", ".#"}));
  const std::vector<TextureLevel> levels = load_texture_image(file.path());
  ASSERT_EQ(levels.size(), 2);
  EXPECT_EQ(levels[1].width, 1);
  // Half of the light has the sRGB byte 188; averaged bytes would be 128, a fifth of the light.
  EXPECT_NEAR(levels[1].pixels[0], 32768, 1);
}

TEST(Texture, LevelsHalveUntilOnePixelInEitherDirection) {
  const TemporaryFile file("odd.ppm", ppm({"#.#.#", "....#", "##..#"}));
  const std::vector<TextureLevel> levels = load_texture_image(file.path());
  ASSERT_EQ(levels.size(), 3);
  EXPECT_EQ(levels[1].width, 2);
  EXPECT_EQ(levels[1].height, 1);
  EXPECT_EQ(levels[2].width, 1);
}

TEST(Texture, ThatIsMissingOrCutOrNoImageIsNamed) {
  EXPECT_NE(message_of("no/such/plaid.png").find("no/such/plaid.png"), std::string::npos);

  const std::string whole = test::content(data_folder() / "textures/plaid.png");
  ASSERT_GT(whole.size(), 1000);
  const TemporaryFile cut("cut.png", whole.substr(0, whole.size() / 2));
  EXPECT_NE(message_of(cut.path()).find(cut.path().string()), std::string::npos);

  const TemporaryFile text("text.png", "this is not an image");
  EXPECT_NE(message_of(text.path()).find(text.path().string()), std::string::npos);
  const TemporaryFile empty("empty.png", "");
  EXPECT_NE(message_of(empty.path()).find(empty.path().string()), std::string::npos);
}

TEST(Texture, ThatIsTooLargeIsRefusedBeforeItIsDecoded) {
  // Headers without pictures, of 8000×7 pixels.
  const std::string png("\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\x1f\x40\0\0\0\x07\x08\x02\0\0\0", 29);
  const std::string jpeg("\xff\xd8\xff\xe0\0\x04\0\0\xff\xc2\0\x0b\x08\0\x07\x1f\x40\x01\0\0\0", 21);
  for (const std::string& header : {png, jpeg}) {
    const TemporaryFile file("large", header);
    try {
      load_texture_image(file.path(), 7999);
      ADD_FAILURE() << "no error";
    } catch (const UsageError& error) {
      EXPECT_NE(std::string(error.what()).find("8000x7 pixels; at most 7999x7999"), std::string::npos) << error.what();
    }
    try {
      load_texture_image(file.path(), 8000);
      ADD_FAILURE() << "no error";
    } catch (const UsageError& error) {
      EXPECT_NE(std::string(error.what()).find("is damaged"), std::string::npos) << error.what();
    }
  }
}

TEST(Texture, ThatIsAPipeIsRefusedAndNotWaitedFor) {
  const TemporaryFile pipe("pipe.png", "");
  std::filesystem::remove(pipe.path());
  ASSERT_EQ(mkfifo(pipe.path().c_str(), 0600), 0);
  EXPECT_NE(message_of(pipe.path()).find("a pipe cannot be read twice"), std::string::npos);
}

/// Draws a cloth that fills most of the picture.
Image draw_textured(Mesh mesh, const std::vector<std::string>& rows) {
  const TemporaryFile file("rows.ppm", ppm(rows));
  Look look;
  look.texture = file.path();
  look.thickness = 0.1;
  mesh.positions *= 0.8;
  return draw(mesh, from_above(), look, {160, 160});
}

// Textures that are equal on a half draw that half alike, with its hem, whatever is on the other half.
TEST(Texture, TheHemTakesNoColorFromTheOppositeBorder) {
  const Mesh grid = make_grid(6, 6);
  const Image plain = draw_textured(grid, {"....", "....", "....", "...."});
  const Image left = draw_textured(grid, {"#...", "#...", "#...", "#..."});
  const Image top = draw_textured(grid, {"####", "....", "....", "...."});
  int dark = 0;
  for (int y = 0; y < 160; ++y) {
    for (int x = 80; x < 160; ++x) {
      ASSERT_EQ(left.at(x, y)[1], plain.at(x, y)[1]) << x << ", " << y;
      ASSERT_EQ(top.at(y, x)[1], plain.at(y, x)[1]) << y << ", " << x;
      dark += left.at(159 - x, y)[1] < 100 ? 1 : 0;
    }
  }
  EXPECT_GT(dark, 1000);
}

TEST(Texture, RepeatsBeyondItsBorders) {
  Mesh twice = make_grid(6, 6);
  for (std::array<float, 2>& uv : twice.uvs) uv[0] *= 2;
  const Image image = draw_textured(twice, {"#...", "#...", "#...", "#..."});
  // Middles of the first and the last texel, left and right of the middle of the cloth: the first is black in both.
  for (const int x : {24, 88}) EXPECT_LT(image.at(x, 80)[1], 100) << x;
  for (const int x : {72, 136}) EXPECT_GT(image.at(x, 80)[1], 150) << x;
}

// The cloth's middle is a seam between u = 1 and u = 0. The texture's first texel is black and its last is white, so
// the filter draws a ramp over a texel's width.
TEST(Texture, RunsThroughTheSeamOfATube) {
  Mesh seam = make_grid(2, 2);
  for (std::size_t i = 0; i < seam.uvs.size(); ++i) {
    const Triangle& t = seam.triangles[i / 3];
    const double middle = (seam.positions(t[0], 0) + seam.positions(t[1], 0) + seam.positions(t[2], 0)) / 3;
    seam.uvs[i][0] += middle < 0 ? 0.5F : -0.5F;
  }
  const Image image = draw_textured(seam, {"#...", "#...", "#...", "#..."});
  const auto value = [&image](int x) { return int{image.at(x, 80)[1]}; };
  EXPECT_LT(value(80), value(74) - 20);
  EXPECT_LT(value(74), value(66) - 5);
  EXPECT_LT(value(90), value(80) - 20);
}

TEST(Texture, NeedsTextureCoordinates) {
  Mesh mesh = make_grid(1, 1);
  mesh.uvs.clear();
  Look look;
  look.texture = data_folder() / "textures/plaid.png";
  EXPECT_THROW(draw(mesh, from_above(), look), UsageError);
}

// Between the last column and the first lies a border of two threads and two bands, as between 511 and 512.
TEST(Texture, OfDrapeTiles) {
  for (const char* name : {"textures/plaid.png", "textures/gingham.png"}) {
    const TextureLevel texture = load_texture_image(data_folder() / name).front();
    ASSERT_EQ(texture.width, 1024) << name;
    const auto step = [&texture](int a, int b) {  // mean difference between two columns
      double sum = 0;
      for (int y = 0; y < texture.height; ++y) {
        const auto at = [&](int x) { return texture.pixels[3 * static_cast<std::size_t>(y * texture.width + x) + 1]; };
        sum += std::abs(at(a) - at(b));
      }
      return sum / texture.height;
    };
    EXPECT_LT(step(1023, 0), 1.5 * step(511, 512)) << name;
  }
}

/// Returns the mean difference of green across a yarn of plaid, within a mixed check of a texture, relative to the
/// mean.
double contrast_of_mixed_check(const char* name) {
  const TextureLevel texture = load_texture_image(data_folder() / "textures" / name).front();
  double sum = 0, mean = 0;
  for (int y = 8; y < 56; ++y) {
    for (int x = 8; x < 52; ++x) {
      const auto green = [&](int column) {
        return static_cast<double>(texture.pixels[3 * static_cast<std::size_t>(y * texture.width + column) + 1]);
      };
      sum += std::abs(green(x + 4) - green(x));
      mean += green(x);
    }
  }
  return sum / mean;
}

// Yarns of a centimetre alternate in plaid; those of gingham are too fine for the texture.
TEST(Texture, GinghamHasNoCoarseYarns) {
  EXPECT_GT(contrast_of_mixed_check("plaid.png"), 0.5);
  EXPECT_LT(contrast_of_mixed_check("gingham.png"), 0.1);
}

}  // namespace
}  // namespace drape::test
