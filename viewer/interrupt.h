// Ctrl-C that ends the work and keeps what there is.
#pragma once

#include <csignal>

namespace lumivec {

// While one exists, the first SIGINT or SIGTERM only sets a flag, and a second one ends the process
// as if nothing had caught it. A signal that the process was told to ignore (nohup) stays ignored.
// At most one guard at a time.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

  bool requested() const;

 private:
  struct sigaction old_interrupt_ {};
  struct sigaction old_terminate_ {};
};

}  // namespace lumivec
