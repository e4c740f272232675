#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "render/gl/context.hpp"
#include "render/gl/functions.hpp"
#include "render/gl/program.hpp"

namespace drape {

/// An OpenGL context, and what outlives a renderer in it: programs, which take llvmpipe as long to compile as dozens of
/// pictures to draw.
class GlDevice {
 public:
  /// Is current on the calling thread from then on.
  /// @param data_folder holds shaders/
  /// @throws OutputError as make_gl_context()
  GlDevice(std::filesystem::path data_folder, GlBackend backend);

  /// Whether it was made with these.
  [[nodiscard]] bool is_of(const std::filesystem::path& data_folder, GlBackend backend) const {
    return data_folder_ == data_folder && backend_ == backend;
  }

  /// Directs the GL calls of the calling thread to this device.
  /// @throws OutputError if the library refuses
  void make_current() { context_->make_current(); }
  /// Leaves the device, which must be current, to any other thread.
  void release() { context_->release(); }

  [[nodiscard]] const GlFunctions& gl() const { return gl_; }

  /// The program of these shaders, see Program. Made when it is first asked for; its uniforms are as its last user has
  /// left them, so each sets all of them.
  const Program& program(const std::string& name, const std::vector<std::string>& defines);

 private:
  std::filesystem::path data_folder_;
  GlBackend backend_;
  std::unique_ptr<GlContext> context_;
  GlFunctions gl_;
  std::map<std::pair<std::string, std::vector<std::string>>, Program> programs_;
};

/// Gives a device back for others to borrow, unless something is wrong with it.
struct GiveBack {
  void operator()(GlDevice* device) const noexcept;
};

using BorrowedDevice = std::unique_ptr<GlDevice, GiveBack>;

/// A device for one user alone: one that was given back, on whatever thread that was, or else a new one. It is current
/// on the calling thread from then on, and is given back on the thread that uses it, when nothing is left in it but its
/// programs.
/// @throws OutputError as GlDevice
BorrowedDevice borrow_device(const std::filesystem::path& data_folder, GlBackend backend);

}  // namespace drape
