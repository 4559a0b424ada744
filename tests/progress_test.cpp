#include "viewer/progress.h"

#include <gtest/gtest.h>

#include <limits>
#include <sstream>

#include "viewer/text_format.h"

using namespace lumivec;

namespace {

RenderProgress some_progress() {
  RenderProgress progress;
  progress.fraction = 0.425;
  progress.seconds = 10.0;
  progress.seconds_left = 72.0;
  progress.samples = 27.0;
  progress.error = 0.0234;
  return progress;
}

}  // namespace

TEST(ProgressLine, SaysWhatIsKnown) {
  EXPECT_EQ(progress_line(some_progress()), "42%: 27 samples a pixel, 1:12 left, error 2.34%");
}
TEST(ProgressLine, LeavesOutWhatIsNot) {
  RenderProgress progress = some_progress();
  progress.seconds_left = std::numeric_limits<double>::infinity();
  progress.error = -1.0;
  EXPECT_EQ(progress_line(progress), "42%: 27 samples a pixel");
}
TEST(ProgressLine, CountsWholeSeconds) {
  RenderProgress progress = some_progress();
  progress.seconds_left = 3.7;
  EXPECT_EQ(progress_line(progress), "42%: 27 samples a pixel, 4 s left, error 2.34%");
}
TEST(ProgressLine, SurvivesNonsense) {
  RenderProgress progress;
  progress.fraction = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(progress_line(progress), "0%: 0 samples a pixel, 0 s left");
}

TEST(ProgressBar, FitsTheTerminal) {
  for (int columns = 0; columns < 200; ++columns) {
    EXPECT_LE(int(progress_bar(some_progress(), columns).size()), std::max(columns - 1, 0));
  }
}
TEST(ProgressBar, FillsWithTheFraction) {
  const std::string bar = progress_bar(some_progress(), 100);
  EXPECT_EQ(std::count(bar.begin(), bar.end(), '='), 17);  // of 40
  EXPECT_EQ(bar.substr(0, 6), " 42% [");
}

TEST(ProgressPrinter, PrintsLinesEverMoreRarely) {
  std::ostringstream out;
  ProgressPrinter printer(out, ProgressStyle::lines, 80);
  RenderProgress progress = some_progress();
  for (int second = 0; second <= 200; ++second) {
    progress.seconds = second;
    printer.update(progress);
  }
  const std::string text = out.str();
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 8);  // 2 4 8 16 32 64 124 184
}
TEST(ProgressPrinter, TakesTheBarAway) {
  std::ostringstream out;
  ProgressPrinter printer(out, ProgressStyle::bar, 80);
  printer.update(some_progress());
  printer.clear();
  EXPECT_TRUE(out.str().ends_with("\r\033[K"));
}
TEST(ProgressPrinter, IsSilentIfAsked) {
  std::ostringstream out;
  ProgressPrinter printer(out, ProgressStyle::none, 80);
  printer.update(some_progress());
  printer.clear();
  EXPECT_TRUE(out.str().empty());
}

TEST(FormatDuration, SuitsItsSize) {
  EXPECT_EQ(format_duration(0.0), "0.00 s");
  EXPECT_EQ(format_duration(0.0042), "4.2 ms");
  EXPECT_EQ(format_duration(0.42), "0.42 s");
  EXPECT_EQ(format_duration(12.34), "12.3 s");
  EXPECT_EQ(format_duration(59.97), "1:00");
  EXPECT_EQ(format_duration(245.0), "4:05");
  EXPECT_EQ(format_duration(7384.0), "2:03:04");
  EXPECT_EQ(format_duration(-1.0), "?");
}
TEST(FormatBytes, SuitsTheirSize) {
  EXPECT_EQ(format_bytes(1023), "1023 B");
  EXPECT_EQ(format_bytes(1536), "1.5 KiB");
  EXPECT_EQ(format_bytes(std::uint64_t{5} << 40), "5.0 TiB");
}
TEST(FormatCount, SeparatesThousands) {
  EXPECT_EQ(format_count(0), "0");
  EXPECT_EQ(format_count(999), "999");
  EXPECT_EQ(format_count(1000), "1,000");
  EXPECT_EQ(format_count(1234567), "1,234,567");
}
