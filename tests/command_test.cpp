// The program as a user meets it: every error is one line that says what to do, with the right exit
// status.
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "command_runner.h"
#include "temporary_folder.h"

namespace fs = std::filesystem;

namespace {

// A white square that faces the camera, before a lamp, and two cameras.
constexpr const char* lit_quad = R"({
  "asset": {"version": "2.0"},
  "extensionsUsed": ["KHR_lights_punctual"],
  "extensions": {"KHR_lights_punctual": {"lights": [{"type": "point", "intensity": 20}]}},
  "scene": 0,
  "scenes": [{"name": "room", "nodes": [0, 1, 2, 3]}],
  "nodes": [
    {"name": "quad", "mesh": 0},
    {"name": "front", "camera": 0, "translation": [0, 0, 3]},
    {"name": "lamp", "translation": [0, 0, 2], "extensions": {"KHR_lights_punctual": {"light": 0}}},
    {"name": "wide", "camera": 1, "translation": [0, 0, 3]}],
  "cameras": [
    {"name": "front", "type": "perspective", "perspective": {"yfov": 0.8, "znear": 0.01}},
    {"name": "wide", "type": "perspective",
     "perspective": {"yfov": 0.8, "znear": 0.01, "aspectRatio": 2.0}}],
  "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
  "accessors": [
    {"bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3",
     "min": [-1, -1, 0], "max": [1, 1, 0]},
    {"bufferView": 1, "componentType": 5123, "count": 6, "type": "SCALAR"}],
  "bufferViews": [
    {"buffer": 0, "byteOffset": 0, "byteLength": 48},
    {"buffer": 0, "byteOffset": 48, "byteLength": 12}],
  "buffers": [{"byteLength": 60, "uri": "data:application/octet-stream;base64,@BUFFER@"}]
})";

// Four corners as floats, then two triangles as 16-bit indices.
constexpr const char* quad_buffer =
    "AACAvwAAgL8AAAAAAACAPwAAgL8AAAAAAACAPwAA"
    "gD8AAAAAAACAvwAAgD8AAAAAAAABAAIAAAACAAMA";

class Command : public testing::Test {
 protected:
  Command() {
    std::string text = lit_quad;
    const std::string mark = "@BUFFER@";
    text.replace(text.find(mark), mark.size(), quad_buffer);
    std::ofstream(folder / "quad.gltf") << text;
  }

  CommandResult run(const std::vector<std::string>& arguments) const {
    return run_command(LUMIVEC_PROGRAM, arguments, folder.path());
  }

  // Expects exit status 2 and exactly this line on stderr, after the program's name.
  void expect_usage_error(const std::vector<std::string>& arguments,
                          const std::string& line) const {
    expect_error(arguments, line, 2);
  }
  void expect_failure(const std::vector<std::string>& arguments, const std::string& line) const {
    expect_error(arguments, line, 1);
  }

  TemporaryFolder folder;

 private:
  void expect_error(const std::vector<std::string>& arguments, const std::string& line,
                    int status) const {
    const CommandResult result = run(arguments);
    EXPECT_EQ(result.err, "lumivec: " + line + "\n");
    EXPECT_EQ(result.status, status);
    EXPECT_EQ(result.out, "");
    EXPECT_EQ(folder.files(), 1u) << "something was left behind";
  }
};

}  // namespace

TEST_F(Command, TellsItsVersion) {
  const CommandResult result = run({"--version"});
  EXPECT_EQ(result.status, 0);
  EXPECT_EQ(result.out.substr(0, 8), "lumivec ");
}
TEST_F(Command, ExplainsItself) {
  const std::string help = run({"help"}).out;
  for (const char* word : {"view", "render", "walk", "info", "compare"}) {
    EXPECT_NE(help.find(word), std::string::npos) << help;
  }
  EXPECT_EQ(run({"--help"}).out, help);
}
TEST_F(Command, ExplainsACommand) {
  const std::string help = run({"help", "render"}).out;
  EXPECT_EQ(run({"render", "--help"}).out, help);
  for (const char* option : {"--output",
                             "--size",
                             "--camera",
                             "--scene",
                             "--filter",
                             "--integrator",
                             "--validity",
                             "--spp",
                             "--time",
                             "--error",
                             "--terms",
                             "--threads",
                             "--seed",
                             "--max-depth",
                             "--specular-roughness",
                             "--exposure",
                             "--display",
                             "--view",
                             "--ocio",
                             "--environment",
                             "--environment-strength",
                             "--environment-rotation",
                             "--allow-outside-files",
                             "--stats",
                             "--quiet",
                             "--half",
                             "--float"}) {
    EXPECT_NE(help.find(option), std::string::npos) << option;
  }
}

TEST_F(Command, NeedsACommand) {
  expect_usage_error({}, "no command is given; write: lumivec view SCENE, or lumivec --help");
}
TEST_F(Command, SuggestsACommand) {
  expect_usage_error({"rendr", "quad.gltf"}, "there is no command 'rendr'; did you mean 'render'?");
  expect_usage_error({"help", "compar"},
                     "help: there is no command 'compar'; did you mean 'compare'?");
}
TEST_F(Command, TellsTheKeysOfTheWindow) {
  const std::string help = run({"view", "--help"}).out;
  for (const char* word : {"--pixel-size", "--look", "W A S D", "Shift+1 to 5", "Ctrl+S"})
    EXPECT_NE(help.find(word), std::string::npos) << word;
}
TEST_F(Command, SuggestsAnOption) {
  expect_usage_error({"render", "quad.gltf", "-o", "a.exr", "--sise", "64"},
                     "render: there is no option '--sise'; did you mean '--size'?");
  expect_usage_error({"render", "quad.gltf", "-o", "a.exr", "--env=a.hdr"},
                     "render: there is no option '--env'; did you mean '--environment'?");
  expect_usage_error({"info", "quad.gltf", "--jsno"},
                     "info: there is no option '--jsno'; did you mean '--json'?");
  expect_usage_error({"quad.gltf", "--sise", "64"},
                     "view: there is no option '--sise'; did you mean '--size'?");
  expect_usage_error({"--vesion"},
                     "there is no option '--vesion' before a command; did you mean '--version'?");
}
TEST_F(Command, RefusesWhatItDoesNotKnow) {
  expect_usage_error({"render", "quad.gltf", "-o", "a.exr", "--frobnicate"},
                     "render: there is no option '--frobnicate'; see lumivec render --help");
}

TEST_F(Command, RefusesBadValues) {
  const auto expect = [&](const std::vector<std::string>& options, const std::string& line) {
    std::vector<std::string> arguments = {"render", "quad.gltf", "-o", "a.exr"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    expect_usage_error(arguments, line);
  };
  expect({"--size", "0"}, "--size: 0 is out of range; give a number from 1 to 65536");
  expect({"--size", "70000x2"}, "--size: 70000 is out of range; give a number from 1 to 65536");
  expect({"--spp", "0"}, "--spp: 0 is out of range; give a number from 1 to 4194304");
  expect({"--spp", "many"}, "--spp: 'many' is not a whole number");
  expect({"--time", "nan"}, "--time: 'nan' is not a finite number");
  expect({"--time", "0"}, "--time: 0 is out of range; give a number above 0, at most 31536000");
  expect({"--error", "-1"}, "--error: -1 is out of range; give a number above 0, at most 100");
  expect({"--specular-roughness", "1.5"},
         "--specular-roughness: 1.5 is out of range; give a number from 0 to 1");
  expect({"--max-depth", "-1"},
         "--max-depth: -1 is out of range; give a number from 0 to 2147483647");
  expect({"--terms", "direct,caustics"},
         "--terms: there is no term 'caustics'; did you mean 'caustic'?");
  expect({"--filter", "gausian"},
         "--filter: there is no filter 'gausian'; did you mean 'gaussian'?");
  expect({"--integrator", "paht"}, "--integrator: there is no 'paht'; did you mean 'path'?");
  expect({"--integrator", "light-vectors", "--validity", "papr"},
         "--validity: there is no 'papr'; did you mean 'paper'?");
  expect({"--integrator", "path", "--validity", "paper"},
         "--validity: path keeps no records; leave out --integrator path");
  expect({"--paper-needed", "0"},
         "--paper-needed: 0 is out of range; give a number from 1 to 1073741824");
  expect({"--exposure", "bright"}, "--exposure: 'bright' is not a number");
  expect({"--png-bits", "12", "-o", "a.png"}, "--png-bits: there is no '12'; known are 8, 16");
}
TEST_F(Command, RefusesMissingAndRepeatedValues) {
  expect_usage_error({"render", "quad.gltf", "-o", "a.exr", "--spp"},
                     "--spp: has no value; give one after it");
  expect_usage_error({"render", "quad.gltf", "-o", "a.exr", "--spp", "1", "--spp", "2"},
                     "--spp: is given more than once; give it once");
}
TEST_F(Command, TakesNegativeNumbers) {
  EXPECT_EQ(
      run({"render", "quad.gltf", "-o", "a.png", "--size", "8", "--spp", "1", "--exposure", "-.5"})
          .err,
      "");
}
TEST_F(Command, RefusesContradictions) {
  expect_usage_error({"render", "quad.gltf", "-o", "a.exr", "--half", "--float"},
                     "--half, --float: contradict each other; give one of them");
  expect_usage_error({"render", "quad.gltf", "-o", "a.png", "--float"},
                     "--float: is for OpenEXR and there is no such output; add -o OUT.exr");
  expect_usage_error({"render", "quad.gltf", "-o", "a.exr", "--environment-strength", "2"},
                     "--environment-strength: there is no environment; add --environment FILE or "
                     "--environment sky");
}
TEST_F(Command, LightsWhatBringsNoLight) {
  std::ofstream(folder / "dark.gltf") << R"({"asset": {"version": "2.0"}, "scene": 0,
    "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}], "meshes": [{"primitives": [
    {"attributes": {"POSITION": 0}}]}], "buffers": [{"byteLength": 36, "uri":
    "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}],
    "bufferViews": [{"buffer": 0, "byteLength": 36}], "accessors": [{"bufferView": 0, "count": 3,
    "componentType": 5126, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]}]})";
  const auto warnings = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"render", "dark.gltf", "-o",    "a.png",
                                          "--size", "8",         "--spp", "1"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments).err;
  };
  EXPECT_NE(warnings({}).find("dark.gltf: holds no light; a plain sky lights it"),
            std::string::npos);
  EXPECT_EQ(warnings({"--environment", "sky"}).find("no light"), std::string::npos);
  EXPECT_NE(warnings({"--environment", "none"}).find("so that the picture is black"),
            std::string::npos);
}
TEST_F(Command, NeedsASceneAndAnOutput) {
  expect_usage_error({"render", "-o", "a.exr"},
                     "render: no scene is given; write: lumivec render SCENE -o OUT.exr");
  expect_usage_error({"render", "quad.gltf"},
                     "render: no output is given; add -o OUT.exr, .png or .jpg");
  expect_usage_error({"render", "quad.gltf", "b.gltf", "-o", "a.exr"},
                     "render: 'b.gltf' is one argument too many");
  expect_usage_error({"info"}, "info: no scene is given; write: lumivec info SCENE");
  expect_usage_error({"compare", "a.exr"},
                     "compare: two pictures are needed; write: lumivec compare A.exr B.exr");
}

TEST_F(Command, RefusesOutputsBeforeRendering) {
  expect_usage_error({"render", "quad.gltf", "-o", "a.tif"},
                     "a.tif: '.tif' is no picture; use .exr, .png or .jpg");
  expect_usage_error({"render", "quad.gltf", "-o", "a"},
                     "a: has no extension; use .exr, .png or .jpg");
  expect_usage_error({"render", "quad.gltf", "-o", "a.exr", "-o", "./a.exr"},
                     "./a.exr: is given twice as an output; choose another name");
  expect_usage_error({"render", "quad.gltf", "-o", "a.exr", "--stats", "quad.gltf"},
                     "quad.gltf: is read and would be overwritten; choose another name");
  expect_failure({"render", "quad.gltf", "-o", "none/a.exr"},
                 "none/a.exr: the folder none does not exist; make it first, or choose another "
                 "place");
  expect_failure({"render", "quad.gltf", "-o", "a.exr", "--stats", "none/a.json"},
                 "none/a.json: the folder none does not exist; make it first, or choose another "
                 "place");
}
TEST_F(Command, RefusesDisplaysItDoesNotHave) {
  expect_usage_error({"render", "quad.gltf", "-o", "a.png", "--display", "srbg"},
                     "--display: 'srbg' is no display; did you mean 'sRGB'?");
  expect_usage_error({"render", "quad.gltf", "-o", "a.png", "--view", "raww"},
                     "--view: 'raww' is no view of display 'sRGB'; did you mean 'Raw'?");
  expect_failure({"render", "quad.gltf", "-o", "a.png", "--ocio", "none.ocio"},
                 "none.ocio: no such file; give an OpenColorIO configuration, or --ocio builtin");
}
TEST_F(Command, RefusesPicturesBeyondTheMachine) {
  const CommandResult result = run({"render", "quad.gltf", "-o", "a.exr", "--size", "65536"});
  EXPECT_EQ(result.status, 1);
  EXPECT_NE(result.err.find("--size: a picture of 65536x65536 takes 4"), std::string::npos)
      << result.err;
}
TEST_F(Command, NamesAMissingScene) {
  const CommandResult result = run({"render", "none.gltf", "-o", "a.exr"});
  EXPECT_EQ(result.status, 1);
  EXPECT_EQ(result.err.substr(0, 20), "lumivec: none.gltf: ") << result.err;
  EXPECT_EQ(std::count(result.err.begin(), result.err.end(), '\n'), 1);
  EXPECT_EQ(run({"info", "none.gltf"}).status, 1);
}
TEST_F(Command, SuggestsACamera) {
  expect_usage_error({"render", "quad.gltf", "-o", "a.exr", "--camera", "frnot"},
                     "--camera: there is no camera 'frnot'; did you mean 'front'?");
  expect_usage_error({"render", "quad.gltf", "-o", "a.exr", "--camera", "2"},
                     "--camera: there is no camera 2; there are 2, counted from 0");
}

TEST_F(Command, RendersPicturesAndStatistics) {
  const CommandResult result = run({"render", "quad.gltf", "-o", "a.exr", "-o", "a.png", "-o",
                                    "a.jpg", "--size", "16x8", "--spp", "4", "--stats", "a.json"});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_EQ(result.err, "");
  for (const char* file : {"a.exr", "a.png", "a.jpg"}) {
    EXPECT_GT(fs::file_size(folder / file), 100u) << file;
    EXPECT_NE(result.out.find(file), std::string::npos) << result.out;
  }
  const auto json = nlohmann::json::parse(std::ifstream(folder / "a.json"));
  EXPECT_EQ(json["settings"]["width"], 16);
  EXPECT_EQ(json["samples"]["total"], 16 * 8 * 4);
  EXPECT_GT(json["rays"]["camera"], 0);
  EXPECT_EQ(json["scene"]["camera"], "front");
  EXPECT_EQ(json["interrupted"], false);
  EXPECT_EQ(folder.files(), 5u);
}
TEST_F(Command, IsSilentIfAsked) {
  const CommandResult result =
      run({"render", "quad.gltf", "-o", "a.exr", "--size", "8", "--spp", "1", "--quiet"});
  EXPECT_EQ(result.status, 0);
  EXPECT_EQ(result.out + result.err, "");
}
TEST_F(Command, TakesTheSizeFromTheCamera) {
  const CommandResult result =
      run({"render", "quad.gltf", "-o", "a.exr", "--camera", "wide", "--spp", "1"});
  EXPECT_EQ(result.out.substr(0, 9), "1024x512,") << result.out << result.err;
}
TEST_F(Command, RendersTheSamePictureTwice) {
  const std::vector<std::string> options = {"--size", "16", "--spp", "4", "--float"};
  const auto render = [&](const std::string& file, const std::vector<std::string>& more) {
    std::vector<std::string> arguments = {"render", "quad.gltf", "-o", file};
    arguments.insert(arguments.end(), options.begin(), options.end());
    arguments.insert(arguments.end(), more.begin(), more.end());
    EXPECT_EQ(run(arguments).status, 0);
  };
  render("a.exr", {"--threads", "1"});
  render("b.exr", {"--threads", "2"});
  const auto json = nlohmann::json::parse(run({"compare", "a.exr", "b.exr", "--json"}).out);
  EXPECT_EQ(json["layers"]["beauty"]["rmse"], 0.0);
  EXPECT_EQ(json["layers"]["beauty"]["flip"], 0.0);
  EXPECT_EQ(json["layers"].size(), 7u);
}

TEST_F(Command, ComparesPictures) {
  const auto render = [&](const std::string& file, const std::string& size, const char* terms) {
    EXPECT_EQ(
        run({"render", "quad.gltf", "-o", file, "--size", size, "--spp", "2", "--terms", terms})
            .status,
        0);
  };
  render("a.exr", "16", "direct");
  render("b.exr", "16", "direct,emitted");
  render("c.exr", "8", "direct");
  const CommandResult result = run({"compare", "a.exr", "b.exr", "--heatmap", "heat.png"});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.out.find("relMSE"), std::string::npos);
  EXPECT_NE(result.out.find("\ndirect "), std::string::npos);
  EXPECT_EQ(result.out.find("\nemitted "), std::string::npos);
  EXPECT_TRUE(fs::exists(folder / "heat.png"));

  EXPECT_EQ(run({"compare", "a.exr", "c.exr"}).err,
            "lumivec: a.exr: is 16x16 and c.exr is 8x8; render both at one size\n");
  EXPECT_EQ(run({"compare", "a.exr", "b.exr", "--map", "direct=emited"}).err,
            "lumivec: --map: b.exr has no layer 'emited'; did you mean 'emitted'?\n");
  EXPECT_EQ(run({"compare", "a.exr", "b.exr", "--map", "direct=emitted"}).status, 0);
  EXPECT_EQ(run({"compare", "a.exr", "none.exr"}).err, "lumivec: none.exr: no such file\n");
}

TEST_F(Command, TellsWhatASceneHolds) {
  const CommandResult result = run({"info", "quad.gltf"});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_NE(result.out.find("2 triangles"), std::string::npos) << result.out;
  const auto json = nlohmann::json::parse(run({"info", "quad.gltf", "--json"}).out);
  EXPECT_EQ(json["triangles_instanced"], 2);
  EXPECT_EQ(json["lights"].size(), 1u);
  EXPECT_EQ(json["cameras"][1]["name"], "wide");
  EXPECT_EQ(json["bounds"]["max"][0], 1.0);
}

TEST_F(Command, CtrlCWritesWhatThereIs) {
  for (const int signal_number : {SIGINT, SIGTERM}) {
    bool sent = false;
    const CommandResult result = run_command(
        LUMIVEC_PROGRAM, {"render", "quad.gltf", "-o", "a.exr", "--size", "32", "--spp", "4000000"},
        folder.path(), [&](pid_t process, const std::string& text) {
          if (sent || text.find("samples a pixel") == std::string::npos) return;
          sent = true;
          kill(process, signal_number);
        });
    EXPECT_TRUE(sent);
    EXPECT_EQ(result.status, 130) << result.err;
    EXPECT_NE(result.out.find("interrupted"), std::string::npos) << result.out;
    EXPECT_TRUE(fs::exists(folder / "a.exr"));
    EXPECT_EQ(run({"compare", "a.exr", "a.exr"}).status, 0);
    fs::remove(folder / "a.exr");
  }
}
