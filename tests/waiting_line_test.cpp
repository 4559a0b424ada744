#include "integrator/waiting_line.h"

#include <gtest/gtest.h>

#include <vector>

namespace lumivec {
namespace {

TEST(WaitingLine, ItemsLeaveInOrderWhenItIsFull) {
  WaitingLine<int, 4> line;
  std::vector<int> left;
  const auto leave = [&](int item) { left.push_back(item); };
  for (int i = 0; i < 4; ++i) line.add(i, leave);
  EXPECT_TRUE(left.empty());
  for (int i = 4; i < 11; ++i) line.add(i, leave);
  EXPECT_EQ(left, std::vector<int>({0, 1, 2, 3, 4, 5, 6}));
  line.finish(leave);
  EXPECT_EQ(left, std::vector<int>({0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10}));
}

TEST(WaitingLine, IsOfUseAgainAfterItsEnd) {
  WaitingLine<int, 2> line;
  std::vector<int> left;
  const auto leave = [&](int item) { left.push_back(item); };
  line.finish(leave);
  for (int round = 0; round < 3; ++round) {
    for (int i = 0; i < 3; ++i) line.add(i, leave);
    line.finish(leave);
  }
  EXPECT_EQ(left, std::vector<int>({0, 1, 2, 0, 1, 2, 0, 1, 2}));
}

}  // namespace
}  // namespace lumivec
