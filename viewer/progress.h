// How far a render is, for a person: a bar on a terminal, now and then a line in a log.
#pragma once

#include <ostream>
#include <string>

#include "integrator/render.h"

namespace lumivec {

enum class ProgressStyle { none, bar, lines };

// "  42% [========>           ] 27 samples, 0:12 left, error 2.3%", at most columns wide.
std::string progress_bar(const RenderProgress& progress, int columns);

// "42%: 27 samples a pixel, 0:12 left, error 2.3%".
std::string progress_line(const RenderProgress& progress);

// Calls of update come from one thread at a time; out must outlive this.
class ProgressPrinter {
 public:
  ProgressPrinter(std::ostream& out, ProgressStyle style, int columns)
      : out_(out), style_(style), columns_(columns) {}

  void update(const RenderProgress& progress);
  void clear();  // takes the bar off the terminal

 private:
  std::ostream& out_;
  ProgressStyle style_;
  int columns_;
  bool shown_ = false;
  double next_line_ = 2.0;  // seconds of sampling; twice as late each time, up to a minute
};

}  // namespace lumivec
