// Replays a script's events (input_script.h) against the window, a step a frame, by the same calls
// that real ones make.
#pragma once

#include <deque>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "viewer/window/input_script.h"

namespace lumivec {

class Window;

class ScriptPlayer {
 public:
  // Throws as read_script.
  ScriptPlayer(const std::filesystem::path& file, Window& window);

  // The next step, if its time has come; false once all is done. Throws CommandError where a check
  // fails or something that is waited for does not happen.
  bool step();
  // Whether the next step waits for something that frames alone do not bring about.
  bool waiting() const { return waiting_ != nullptr; }

 private:
  void begin(const ScriptLine& line);
  void input(const ScriptLine& line);
  void wait_for(const ScriptLine& line);
  void press_key(const ScriptKey& key, int action);
  void move(double x, double y);
  void button(int which, int action, int modifiers);
  void write_state(const std::filesystem::path& file);
  std::string where(const ScriptLine& line) const;
  void then(std::function<void()> step) { steps_.push_back(std::move(step)); }

  std::filesystem::path file_;
  Window& window_;
  std::vector<ScriptLine> lines_;
  std::size_t next_ = 0;
  std::deque<std::function<void()>> steps_;  // of the line that is being replayed
  std::function<bool()> waiting_;            // until this is true
  double wait_end_ = 0.0;                    // or fails then
  std::string waiting_for_;
};

}  // namespace lumivec
