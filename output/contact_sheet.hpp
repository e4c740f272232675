#pragma once

#include <filesystem>
#include <vector>

#include "output/format.hpp"
#include "overlay/pen.hpp"

namespace drape {

/// Whether an item is among `shown` evenly spread ones of `count`, of which the first and the last are two.
bool is_spread(int index, int count, int shown);

/// One picture of several moments of a film, evenly spread, the first and the last among them. What is below the last
/// one's picture, legend and curves of the whole, stands once below them all.
class ContactSheet final : public Encoder {
 public:
  /// @param film whose `sheet` says how many there are
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
  Image legend_;  // without rows where there is none
};

}  // namespace drape
