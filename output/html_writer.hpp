#pragma once

#include "output/motion_packer.hpp"

namespace drape {

/// Writes the motion as a self-contained page whose player turns the cloth, plays it and colours it by stretch. Only
/// the compressed motion is in memory.
class HtmlWriter final : public MotionWriter {
 public:
  HtmlWriter(const std::filesystem::path& file, const FilmInfo& film);

  void add(const Frame& frame) override;
  std::vector<OutputFile> finish(Ending ending) override;

 private:
  std::string scene_;
  PartialFile file_;
  MotionPacker packer_;
};

OutputFormat html_format();

}  // namespace drape
