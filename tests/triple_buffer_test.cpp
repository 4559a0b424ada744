#include "viewer/window/triple_buffer.h"

#include <gtest/gtest.h>

#include <thread>

namespace lumivec {
namespace {

TEST(TripleBuffer, HandsOverTheLatest) {
  TripleBuffer<int> buffer;
  EXPECT_FALSE(buffer.take());
  buffer.back() = 1;
  buffer.publish();
  buffer.back() = 2;
  buffer.publish();
  EXPECT_TRUE(buffer.take());
  EXPECT_EQ(buffer.front(), 2);
  EXPECT_FALSE(buffer.take()) << "nothing is handed over twice";
  EXPECT_EQ(buffer.front(), 2);
}

// What arrives is whole and never older than what came before; the last one arrives.
TEST(TripleBuffer, KeepsValuesWholeBetweenThreads) {
  struct Value {
    std::array<int, 64> parts{};
  };
  TripleBuffer<Value> buffer;
  constexpr int last = 20000;
  std::thread maker([&] {
    for (int i = 1; i <= last; ++i) {
      buffer.back().parts.fill(i);
      buffer.publish();
    }
  });
  int seen = 0;
  while (seen < last) {
    if (!buffer.take()) continue;
    const Value& value = buffer.front();
    EXPECT_GT(value.parts[0], seen);
    for (const int part : value.parts) ASSERT_EQ(part, value.parts[0]);
    seen = value.parts[0];
  }
  maker.join();
}

}  // namespace
}  // namespace lumivec
