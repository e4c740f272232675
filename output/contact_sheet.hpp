#pragma once

#include <filesystem>
#include <vector>

#include "output/format.hpp"
#include "overlay/pen.hpp"

namespace drape {

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

}  // namespace drape
