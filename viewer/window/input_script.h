// Events to replay against the window, for tests and for recording what it does: a text file of
// one command a line.
//
//   key Ctrl+C          press and let go          hold W / let W     keep down, let go
//   move X Y            of the mouse, pixels      wheel STEPS
//   press BUTTON        left, middle, right       release BUTTON
//   click X Y           double X Y                drag BUTTON X Y X Y [Shift|Ctrl]
//   text WORDS          typed                     drop FILE
//   resize WxH          minimise / restore
//   wait SECONDS        frames N
//   until loaded        the view that is asked for is shown; likewise:
//   until rest          it is finished            until samples N   of it at rest
//   until wipe          with path tracing beside  until errors      its error map
//   until records       records of cached light   until picked      double clicks are answered
//   until opened N      files, counted            until size WxH    of the window
//   until idle          nothing is loaded or rendered in the background
//   until error         a message of a failure    until minimised / restored
//   shot FILE.png       the whole window          state FILE.json    what there is
//   check-display       that the picture is what DisplayTransform makes, within 1/255
//   copy FROM TO        a file                    quit
//
// Empty lines and those that begin with # are passed over.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace lumivec {

struct ScriptLine {
  int number = 0;
  std::vector<std::string> words;  // at least one
};

// Throws CommandError with file and line for what is no command, or lacks arguments.
std::vector<ScriptLine> read_script(const std::filesystem::path& file);

struct ScriptKey {
  int code = 0, modifiers = 0;  // GLFW's
};
// "Shift+F1". where: for the message. Throws CommandError.
ScriptKey parse_script_key(const std::string& text, const std::string& where);

}  // namespace lumivec
