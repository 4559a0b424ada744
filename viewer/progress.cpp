#include "viewer/progress.h"

#include <algorithm>
#include <cmath>

#include "viewer/text_format.h"

namespace lumivec {
namespace {

int percent(const RenderProgress& progress) {
  if (!(progress.fraction > 0.0)) return 0;
  return int(std::floor(std::min(progress.fraction, 1.0) * 100.0));
}

std::string samples_text(double samples) {
  return samples < 10.0 && samples != std::floor(samples) ? format_fixed(samples, 1)
                                                          : format_fixed(samples, 0);
}

// In whole seconds: the estimate is no better.
std::string time_left(const RenderProgress& progress) {
  if (progress.seconds_left < 59.5) {
    return ", " + format_fixed(std::max(progress.seconds_left, 0.0), 0) + " s left";
  }
  const std::string left = format_duration(progress.seconds_left);
  return left == "?" ? "" : ", " + left + " left";
}

std::string error_text(const RenderProgress& progress) {
  return progress.error >= 0.0 ? ", error " + format_number(progress.error * 100.0, 3) + "%" : "";
}

}  // namespace

std::string progress_bar(const RenderProgress& progress, int columns) {
  constexpr int longest_bar = 40;
  constexpr int shortest_bar = 8;
  const std::string number = std::to_string(percent(progress));
  std::string line = std::string(number.size() < 3 ? 3 - number.size() : 0, ' ') + number + "%";
  const std::string text =
      samples_text(progress.samples) + " samples" + time_left(progress) + error_text(progress);
  const int room = columns - int(line.size() + text.size()) - 5;  // " [", "] ", the cursor
  const int length = std::min(room, longest_bar);
  if (length >= shortest_bar) {
    const int done = std::clamp(int(progress.fraction * length), 0, length);
    line += " [" + std::string(std::size_t(done), '=') +
            std::string(std::size_t(length - done), ' ') + "] ";
  } else {
    line += " ";
  }
  line += text;
  return line.substr(0, std::size_t(std::max(columns - 1, 0)));
}

std::string progress_line(const RenderProgress& progress) {
  return std::to_string(percent(progress)) + "%: " + samples_text(progress.samples) +
         " samples a pixel" + time_left(progress) + error_text(progress);
}

void ProgressPrinter::update(const RenderProgress& progress) {
  constexpr double longest_pause = 60.0;
  if (style_ == ProgressStyle::bar) {
    out_ << "\r\033[K" << progress_bar(progress, columns_) << std::flush;  // start of line, erase
    shown_ = true;
  } else if (style_ == ProgressStyle::lines && progress.seconds >= next_line_) {
    out_ << progress_line(progress) << std::endl;
    next_line_ = progress.seconds + std::min(progress.seconds, longest_pause);
  }
}

void ProgressPrinter::clear() {
  if (shown_) out_ << "\r\033[K" << std::flush;
  shown_ = false;
}

}  // namespace lumivec
