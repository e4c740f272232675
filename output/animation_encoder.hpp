#pragma once

#include <string>

#include "codecs/codecs.hpp"
#include "core/atomic_file.hpp"
#include "output/format.hpp"

namespace drape {

/// An animated picture in full colour that repeats for ever: WebP, almost exact and exact where nothing moves, or APNG,
/// exact. Frame k is shown from k/fps on, in WebP to the millisecond.
class AnimationEncoder final : public Encoder {
 public:
  /// @param form as in Codecs::begin_animation()
  /// @throws UsageError if fps is not within 0.01 … 90, OutputError if there is no encoder
  AnimationEncoder(const std::filesystem::path& file, std::string form, double fps, int width, int height);

  void add(const Image& image) override;
  std::vector<OutputFile> finish(Ending ending) override;

 private:
  template <class Work>
  void attempt(Work work);

  std::string form_;
  double fps_;
  PartialFile file_;
  AnimationPen pen_;
  int width_ = 0, height_ = 0;
};

OutputFormat webp_format();
OutputFormat apng_format();

}  // namespace drape
