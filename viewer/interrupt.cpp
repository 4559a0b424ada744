#include "viewer/interrupt.h"

namespace lumivec {
namespace {

// A signal handler reaches nothing but variables of static storage.
volatile std::sig_atomic_t interrupt_requested = 0;

extern "C" void note_interrupt(int signal_number) {
  if (interrupt_requested) {
    std::signal(signal_number, SIG_DFL);
    std::raise(signal_number);
  }
  interrupt_requested = 1;
}

void catch_signal(int signal_number, struct sigaction& old_action) {
  sigaction(signal_number, nullptr, &old_action);
  if (old_action.sa_handler == SIG_IGN) return;
  struct sigaction action {};
  action.sa_handler = note_interrupt;
  action.sa_flags = SA_RESTART;  // reads and writes go on: only sampling is to stop
  sigemptyset(&action.sa_mask);
  sigaction(signal_number, &action, nullptr);
}

}  // namespace

InterruptGuard::InterruptGuard() {
  interrupt_requested = 0;
  catch_signal(SIGINT, old_interrupt_);
  catch_signal(SIGTERM, old_terminate_);
}

InterruptGuard::~InterruptGuard() {
  sigaction(SIGINT, &old_interrupt_, nullptr);
  sigaction(SIGTERM, &old_terminate_, nullptr);
}

bool InterruptGuard::requested() const {
  return interrupt_requested != 0;
}

}  // namespace lumivec
