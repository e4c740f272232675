#include "render/gl/device.hpp"

#include <unistd.h>
#include <algorithm>
#include <atomic>
#include <exception>
#include <iterator>
#include <mutex>
#include <tuple>

#include "drape/core/error.hpp"

namespace drape {
namespace {

/// The unused devices. They are never destroyed: when the process ends, their libraries may already be unloaded.
struct IdleDevices {
  std::mutex mutex;
  std::vector<std::unique_ptr<GlDevice>> devices;

  /// Takes the matching device that was used last; null if there is none.
  std::unique_ptr<GlDevice> take(const std::filesystem::path& data_folder, GlBackend backend) {
    const std::scoped_lock lock(mutex);
    const auto found = std::find_if(devices.rbegin(), devices.rend(),
                                    [&](const auto& device) { return device->is_of(data_folder, backend); });
    if (found == devices.rend()) return nullptr;
    std::unique_ptr<GlDevice> device = std::move(*found);
    devices.erase(std::next(found).base());
    return device;
  }

  void give(std::unique_ptr<GlDevice> device) {
    const std::scoped_lock lock(mutex);
    devices.push_back(std::move(device));
  }
};

IdleDevices& idle() {
  static auto* const all = new IdleDevices;
  return *all;
}

/// Refuses to draw in a process forked from one that has drawn: Mesa's threads do not exist in it, so that waiting for
/// them would never end.
void require_own_mesa() {
  static std::atomic<pid_t> owner = 0;
  pid_t none = 0;
  const pid_t self = ::getpid();
  if (owner.compare_exchange_strong(none, self) || none == self) return;
  throw OutputError(
      "cannot draw: this process was forked from one that had drawn, and Mesa's threads stayed there; draw first in "
      "the "
      "new process, or start it anew (in Python multiprocessing.set_start_method(\"spawn\"))");
}

std::unique_ptr<GlContext> make_current_context(GlBackend backend) {
  std::unique_ptr<GlContext> context = make_gl_context(backend);
  context->make_current();
  return context;
}

}  // namespace

std::unique_lock<std::recursive_mutex> lock_gl() {
  static auto* const mutex = new std::recursive_mutex;  // as the idle devices, never destroyed
  return std::unique_lock(*mutex);
}

GlDevice::GlDevice(std::filesystem::path data_folder, GlBackend backend)
    : data_folder_(std::move(data_folder)),
      backend_(backend),
      context_(make_current_context(backend)),
      gl_(*context_) {}

void GlDevice::make_current() {
  const auto lock = lock_gl();
  context_->make_current();
}

const Program& GlDevice::program(const std::string& name, const std::vector<std::string>& defines) {
  const auto found = programs_.find({name, defines});
  if (found != programs_.end()) return found->second;
  const auto lock = lock_gl();
  return programs_
      .emplace(std::piecewise_construct, std::forward_as_tuple(name, defines),
               std::forward_as_tuple(gl_, data_folder_, name, defines))
      .first->second;
}

void GiveBack::operator()(GlDevice* device) const noexcept {
  std::unique_ptr<GlDevice> given(device);
  const auto lock = lock_gl();
  try {
    given->make_current();
    // Mesa's threads may still draw pictures that nobody has read. A process that ends meanwhile would wait for them
    // for ever, so they finish here.
    given->gl().Finish();
    if (given->gl().GetError() != GL_NO_ERROR) return;
    given->release();
    idle().give(std::move(given));
  } catch (const std::exception&) {
    // The next user makes a new device.
  }
}

BorrowedDevice borrow_device(const std::filesystem::path& data_folder, GlBackend backend) {
  require_own_mesa();
  const auto lock = lock_gl();
  BorrowedDevice device(idle().take(data_folder, backend).release());
  if (!device) return BorrowedDevice(std::make_unique<GlDevice>(data_folder, backend).release());
  device->make_current();
  return device;
}

}  // namespace drape
