#pragma once

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include "drape/render/image.hpp"
#include "drape/render/overlay/pen.hpp"
#include "drape/sim/mesh.hpp"
#include "output/registry.hpp"

namespace drape {

/// Encodes an image as a PNG file. The same image gives the same bytes.
/// @throws OutputError
std::string encode_png(const Image& image);

/// Returns a texture as a PNG file: the largest level of its mipmap with at most `most` pixels a side.
/// @throws OutputError if it cannot be read
std::string png_of_texture(const std::filesystem::path& file, int most);

OutputFormat png_format();

/// Returns true if an item is among `shown` evenly spread ones of `count`, with the first and the last.
bool is_spread(int index, int count, int shown);

/// One picture of evenly spread moments of a film, with the first and the last. The legend and curves below the last
/// picture appear once, below all.
class ContactSheet final : public Encoder {
 public:
  /// @param film film with a `sheet`
  /// @throws OutputError if the file cannot be written, or there is no font
  ContactSheet(std::filesystem::path file, const FilmInfo& film);

  void add(const Image& image) override;
  [[nodiscard]] bool needs(int index) const override;
  void skip() override { ++added_; }
  std::vector<OutputFile> finish(Ending ending) override;

 private:
  /// @param time [s]
  Image labelled(Image picture, double time);

  std::filesystem::path file_;
  SheetGrid grid_;
  int first_frame_, expected_frames_;
  double seconds_per_frame_;
  int bands_;
  Pen pen_;
  int added_ = 0;
  std::vector<Image> pictures_;
  Image legend_;  // no rows: no legend
};

/// Finds the poster frame of a motion: the first of the frames in which its cloth is bent most. Bending is the sum of
/// the angles between neighbouring triangles, weighted by edge length.
class PosterFrame {
 public:
  explicit PosterFrame(const std::vector<Triangle>& triangles);

  /// Adds the next frame. Returns true if it is bent more than all before; true for the first.
  bool see(const Vertices& positions);

  /// Returns the number of the poster frame among those seen, from 0.
  [[nodiscard]] int index() const { return index_; }

 private:
  [[nodiscard]] double bend(const Vertices& x) const;

  struct Hinge {
    std::array<int, 2> edge, opposite;
  };
  std::vector<Hinge> hinges_;
  double most_ = -1;
  int seen_ = 0, index_ = 0;
};

/// Shrinks a picture: each pixel is the mean of its area, in linear light.
/// @param width, height at most the image's
Image scaled_image(const Image& image, int width, int height);

}  // namespace drape
