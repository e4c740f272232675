#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/files.hpp"
#include "drape/render/image.hpp"
#include "drape/sim/state.hpp"

namespace drape {

/// A complete file.
struct OutputFile {
  std::filesystem::path path;
  std::uintmax_t size = 0;  ///< [bytes]
  std::string note = {};    ///< remark for the user: "412x343 pixels instead of 480x400"
};

/// Receives the frames of a film in order and writes files. A file appears under its name only when it is complete, and
/// replaces an older one. A sink destroyed without finish() leaves nothing behind but the complete files of a sequence.
/// Use it from one thread at a time.
/// @tparam Item kind of frame: an Image, which was drawn, or a Frame, which needs no drawing
template <class Item>
class Sink {
 public:
  virtual ~Sink() = default;

  /// Adds the next frame.
  /// @throws OutputError           if it cannot be stored
  /// @throws std::invalid_argument if it is an image of another size than the first one
  virtual void add(const Item& item) = 0;

  /// Returns true if it needs the film's frame with this index, counted from the first added frame. Other frames may be
  /// skipped, unless they become the last because the film ends early.
  [[nodiscard]] virtual bool needs(int /*index*/) const { return true; }
  /// Skips the next frame, which is not needed.
  virtual void skip() {}

  /// Completes the files with all frames added so far. Call it once, at the end.
  /// @param ending  early: frames are missing, so the film gets its partial_name(); files of a sequence keep their
  ///                names
  /// @returns the written files; none without a frame
  /// @throws OutputError
  virtual std::vector<OutputFile> finish(Ending ending) = 0;
  std::vector<OutputFile> finish() { return finish(Ending::complete); }

  /// Returns the codec that was chosen on this machine: "H.264".
  [[nodiscard]] virtual std::string codec() const { return {}; }
};

using Encoder = Sink<Image>;       ///< takes drawn images
using MotionWriter = Sink<Frame>;  ///< needs no rendering

/// One file per frame, each of which appears complete. Files of an earlier, longer sequence stay.
template <class Item>
class FrameFiles final : public Sink<Item> {
 public:
  /// @param name  returns the file name of a frame's number
  /// @param bytes returns the content of a frame's file
  FrameFiles(std::function<std::string(int)> name, int first_frame, std::function<std::string(const Item&)> bytes)
      : name_(std::move(name)), frame_(first_frame), bytes_(std::move(bytes)) {
    const PartialFile writable(name_(frame_));  // throws if it is not writable
  }

  void add(const Item& item) override {
    const std::string file = name_(frame_);
    files_.push_back({file, write_file_atomically(file, bytes_(item))});
    ++frame_;
  }
  std::vector<OutputFile> finish(Ending) override { return std::move(files_); }

 private:
  std::function<std::string(int)> name_;
  int frame_;
  std::function<std::string(const Item&)> bytes_;
  std::vector<OutputFile> files_;
};

/// A single file of the last frame added.
template <class Item>
class LastFrameFile final : public Sink<Item> {
 public:
  /// @param last index of the film's last frame, from 0
  LastFrameFile(std::filesystem::path file, int last, std::function<std::string(const Item&)> bytes)
      : file_(std::move(file)), last_index_(last), bytes_(std::move(bytes)) {
    const PartialFile writable(file_);  // throws if it is not writable
  }

  void add(const Item& item) override { last_ = item; }
  [[nodiscard]] bool needs(int index) const override { return index >= last_index_; }

  std::vector<OutputFile> finish(Ending ending) override {
    if (!last_) return {};
    PartialFile file(file_);
    file.write(bytes_(*last_));
    const std::uintmax_t size = file.commit(ending);
    return {{file.name(ending), size}};
  }

 private:
  std::filesystem::path file_;
  int last_index_;
  std::function<std::string(const Item&)> bytes_;
  std::optional<Item> last_;
};

}  // namespace drape
