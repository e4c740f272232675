#include "cli/step_by_step.hpp"

#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <string>

#include "core/console.hpp"
#include "core/text.hpp"

namespace drape {
namespace {

constexpr int poll_milliseconds = 100;  // how soon an interruption is noticed

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
  while (!input_ended_ && !stop_.stop_requested()) {
    pollfd input{.fd = STDIN_FILENO, .events = POLLIN, .revents = 0};
    if (poll(&input, 1, poll_milliseconds) <= 0) continue;
    char character = 0;
    if (read(STDIN_FILENO, &character, 1) != 1) {
      input_ended_ = true;  // input that is a file or closed does not hold the run up
    } else if (character == 'q') {
      stop_.request_stop();
    } else if (character == '\n') {
      return;
    }
  }
}

}  // namespace drape
