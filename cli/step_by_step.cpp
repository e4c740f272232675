#include "cli/step_by_step.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <string>
#include <system_error>

#include "core/console.hpp"
#include "core/text.hpp"

namespace drape {
namespace {

/// An event with a file descriptor that becomes readable.
class Event {
 public:
  Event() : descriptor_(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {
    if (descriptor_ < 0) throw std::system_error(errno, std::generic_category(), "cannot wait for input");
  }
  Event(const Event&) = delete;
  Event& operator=(const Event&) = delete;
  ~Event() { close(descriptor_); }

  void set() const { eventfd_write(descriptor_, 1); }
  [[nodiscard]] int descriptor() const { return descriptor_; }

 private:
  int descriptor_;
};

}  // namespace

void StepByStep::begin(const Simulation&) { print_text(stdout, "Press Enter for the next step, q to stop.\n"); }

void StepByStep::after_step(const Simulation& simulation, const StepReport& report, double seconds) {
  const Energies e = simulation.energies();
  std::string text = fmt::format("step {}: total {:.6g} = kinetic {:.6g} + gravity {:.6g} + elastic {:.6g} J",
                                 simulation.state().step, e.total(), e.kinetic, e.gravity, e.elastic);
  if (!is_explicit(simulation.settings().integrator.method)) {
    text += fmt::format(", {} iterations{}", report.iterations, report.converged ? "" : " (not converged)");
  }
  if (report.estimate) {
    text += fmt::format(", {} substeps, estimated error {}{}", report.substeps, readable_length(*report.estimate),
                        report.converged ? "" : ", above the requested accuracy");
  }
  print_text(stdout, text + fmt::format(", {:.1f} µs\n", 1e6 * seconds));
  wait_for_line();
}

void StepByStep::wait_for_line() {
  if (input_ended_) return;
  const Event stopped;
  const std::stop_callback wake(stop_.get_token(), [&] { stopped.set(); });
  while (!input_ended_ && !stop_.stop_requested()) {
    std::array<pollfd, 2> either{{{.fd = STDIN_FILENO, .events = POLLIN, .revents = 0},
                                  {.fd = stopped.descriptor(), .events = POLLIN, .revents = 0}}};
    if (poll(either.data(), either.size(), -1) < 0 && errno == EINTR) continue;
    if (either[1].revents != 0) return;
    char character = 0;
    if (read(STDIN_FILENO, &character, 1) != 1) {
      input_ended_ = true;  // input from a file or a closed input does not block the run
    } else if (character == 'q') {
      stop_.request_stop();
    } else if (character == '\n') {
      return;
    }
  }
}

}  // namespace drape
