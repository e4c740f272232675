#pragma once

#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>
#include <vector>

#include "render/gl/context.hpp"
#include "render/gl/program.hpp"

namespace drape {

/// An OpenGL context with compiled programs that outlive a renderer: llvmpipe compiles them as slowly as it draws
/// dozens of pictures.
class GlDevice {
 public:
  /// Makes the device and makes it current on the calling thread.
  /// @param data_folder holds shaders/
  /// @throws OutputError as make_gl_context()
  GlDevice(std::filesystem::path data_folder, GlBackend backend);

  /// Returns true if the device was made with these arguments.
  [[nodiscard]] bool is_of(const std::filesystem::path& data_folder, GlBackend backend) const {
    return data_folder_ == data_folder && backend_ == backend;
  }

  /// Directs the GL calls of the calling thread to this device.
  /// @throws OutputError if the library refuses
  void make_current();
  /// Detaches the device, which must be current, so that any thread may use it.
  void release() { context_->release(); }

  [[nodiscard]] const GlFunctions& gl() const { return gl_; }

  /// Returns the program of these shaders, see Program; compiled at first use. Its uniforms keep their last values, so
  /// each user sets all of them.
  const Program& program(const std::string& name, const std::vector<std::string>& defines);

 private:
  std::filesystem::path data_folder_;
  GlBackend backend_;
  std::unique_ptr<GlContext> context_;
  GlFunctions gl_;
  std::map<std::pair<std::string, std::vector<std::string>>, Program> programs_;
};

/// Returns a lock that each thread holds while it calls functions of any device. Mesa's llvmpipe searches the scenes of
/// all contexts without locking them (llvmpipe_flush_resource in Mesa 22.3), so that contexts which draw at once crash.
/// Its own threads draw on meanwhile. A thread may hold several.
[[nodiscard]] std::unique_lock<std::recursive_mutex> lock_gl();

/// Returns a device to the pool, unless it has an error.
struct GiveBack {
  void operator()(GlDevice* device) const noexcept;
};

using BorrowedDevice = std::unique_ptr<GlDevice, GiveBack>;

/// Borrows a device for exclusive use: the matching one returned last, by any thread, or a new one. It is current on
/// the calling thread. Return it on the thread that uses it, after everything in it but its programs is destroyed.
/// @throws OutputError as GlDevice
BorrowedDevice borrow_device(const std::filesystem::path& data_folder, GlBackend backend);

}  // namespace drape
