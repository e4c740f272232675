#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/atomic_file.hpp"
#include "output/sink.hpp"

namespace drape {

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
