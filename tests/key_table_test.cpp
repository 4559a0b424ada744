#include "viewer/window/key_table.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <gtest/gtest.h>

#include <map>
#include <set>

namespace lumivec {
namespace {

TEST(KeyTable, FindsWhatKeysDo) {
  const auto term = find_action(GLFW_KEY_3, 0);
  ASSERT_TRUE(term);
  EXPECT_EQ(term->action, Action::toggle_term);
  EXPECT_EQ(term->index, 2);
  EXPECT_EQ(find_action(GLFW_KEY_3, GLFW_MOD_SHIFT)->action, Action::solo_term);
  EXPECT_EQ(find_action(GLFW_KEY_3, GLFW_MOD_CONTROL)->action, Action::store_view);
  EXPECT_EQ(find_action(GLFW_KEY_3, GLFW_MOD_CONTROL)->index, 3);
  EXPECT_EQ(find_action(GLFW_KEY_F1, GLFW_MOD_CAPS_LOCK)->action, Action::help);
  EXPECT_EQ(find_action(GLFW_KEY_EQUAL, GLFW_MOD_SHIFT)->action, Action::brighter);
  EXPECT_FALSE(find_action(GLFW_KEY_F1, GLFW_MOD_CONTROL));
  EXPECT_FALSE(find_action(GLFW_KEY_W, 0)) << "is held to fly";
}

TEST(KeyTable, GivesNoKeyTwice) {
  std::set<std::pair<int, int>> taken;
  for (const KeyRow& row : key_table()) {
    for (const int code : row.codes)
      EXPECT_TRUE(taken.insert({code, row.modifiers}).second) << row.keys << ": " << row.does;
  }
  for (const int held : {GLFW_KEY_W, GLFW_KEY_A, GLFW_KEY_S, GLFW_KEY_D, GLFW_KEY_Q, GLFW_KEY_E}) {
    for (const int modifiers : {0, GLFW_MOD_SHIFT, GLFW_MOD_ALT})
      EXPECT_EQ(taken.count({held, modifiers}), 0u) << "is held to fly";
  }
}

TEST(KeyTable, HasAKeyForEveryAction) {
  std::set<Action> found;
  for (const KeyRow& row : key_table()) {
    if (row.action != Action::none) {
      EXPECT_FALSE(row.codes.empty()) << row.keys;
      EXPECT_TRUE(found.insert(row.action).second) << row.keys;
    }
  }
  for (int i = 1; i <= int(Action::quit); ++i)
    EXPECT_EQ(found.count(Action(i)), 1u) << "action " << i;
}

TEST(KeyTable, IsToldInTheHelp) {
  const std::string help = key_help();
  for (const KeyRow& row : key_table()) {
    EXPECT_NE(help.find(row.keys), std::string::npos);
    EXPECT_NE(help.find(row.does), std::string::npos);
    EXPECT_LE(row.does.size() + row.keys.size(), 80u) << row.does;
  }
}

}  // namespace
}  // namespace lumivec
