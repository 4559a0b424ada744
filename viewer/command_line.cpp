#include "viewer/command_line.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <iostream>
#include <new>

#include "viewer/commands/compare.h"
#include "viewer/commands/info.h"
#include "viewer/commands/render.h"
#include "viewer/commands/view.h"
#include "viewer/commands/walk.h"
#include "viewer/errors.h"
#include "viewer/suggestion.h"
#include "viewer/version.h"

namespace lumivec {
namespace {

// CLI11's own help says "TEXT" and "Positionals"; this one says what a file's user knows.
class HelpFormatter : public CLI::Formatter {
 public:
  HelpFormatter() {
    constexpr std::size_t description_column = 34;
    column_width(description_column);
    label("Positionals", "Arguments");
  }

  std::string make_option_opts(const CLI::Option* option) const override {
    return option->get_type_name().empty() || !option->nonpositional()
               ? ""
               : " " + option->get_type_name();
  }

  std::string make_usage(const CLI::App* app, std::string) const override {
    if (app->get_parent() == nullptr) return "Usage: lumivec COMMAND [options]\n";
    std::string usage = "Usage: lumivec " + app->get_name();
    for (const CLI::Option* option : app->get_options()) {
      if (option->get_positional()) usage += " " + option->get_name(true);
    }
    return usage + " [options]\n";
  }
};

struct Commands {
  CLI::App app{"Renders scenes with global illumination, split into five parts of the light.",
               "lumivec"};
  RenderOptions render_options;
  WalkOptions walk_options;
  ViewOptions view_options;
  InfoOptions info_options;
  CompareOptions compare_options;
  std::string help_topic;
  CLI::App* render = nullptr;
  CLI::App* walk = nullptr;
  CLI::App* view = nullptr;
  CLI::App* info = nullptr;
  CLI::App* compare = nullptr;
  CLI::App* help = nullptr;

  Commands() {
    app.formatter(std::make_shared<HelpFormatter>());
    app.set_help_flag("-h,--help", "Print this help");
    app.set_version_flag("--version", version_text, "Print the version");
    app.require_subcommand(0, 1);
    app.footer("lumivec help COMMAND tells the options of a command.");
    view = app.add_subcommand("view", "Look at a scene in a window: lumivec SCENE does, too");
    add_view_options(*view, view_options);
    view->footer(view_footer());
    render = app.add_subcommand("render", "Render a scene file to picture files");
    add_render_options(*render, render_options);
    render->footer(
        "Ctrl-C ends sampling and writes what there is (exit status 130); a second one quits.\n\n"
        "  lumivec render room.gltf -o room.exr -o room.png --spp 256\n"
        "  lumivec render room.gltf -o room.exr --error 2 --terms direct,indirect");
    walk = app.add_subcommand("walk", "Move through a scene along a path, frame by frame");
    add_walk_options(*walk, walk_options);
    walk->footer(
        "A file for --path: {\"keys\": [{\"eye\": [x, y, z], \"target\": [x, y, z]}, ...]}, and "
        "if\n"
        "wanted \"up\" and \"yfov\" (degrees) in each key.\n\n"
        "  lumivec walk room.gltf --path orbit:60 --frames 60 -o frames\n"
        "  lumivec walk room.gltf --path dolly:2 --reference truth --stats walk.json");
    info = app.add_subcommand("info", "Tell what a scene file holds");
    add_info_options(*info, info_options);
    info->footer("  lumivec info room.gltf --json");
    compare = app.add_subcommand("compare", "Measure how far a picture is from a reference");
    add_compare_options(*compare, compare_options);
    compare->footer("  lumivec compare fast.exr reference.exr --heatmap difference.png");
    help = app.add_subcommand("help", "Explain a command");
    help->add_option("COMMAND", help_topic, "The command to explain")->type_name("");
    // What nobody expects is looked at after parsing, to suggest what was meant.
    app.allow_extras();
    for (CLI::App* command : {view, render, walk, info, compare, help}) {
      command->allow_extras();
      command->group("Commands");
    }
  }

  static std::vector<std::string> names() {
    return {"view", "render", "walk", "info", "compare", "help"};
  }
};

std::string without_dashes(const std::string& text) {
  const std::size_t begin = text.find_first_not_of('-');
  return begin == std::string::npos ? text : text.substr(begin);
}

bool is_option(const std::string& text) {
  return text.size() > 1 && text[0] == '-';
}

// Refuses the first argument that the parser had no place for: an option, if there is one.
void refuse_extras(const CLI::App& command, const std::string& command_name) {
  const std::vector<std::string> extras = command.remaining();
  if (extras.empty()) return;
  const auto option = std::find_if(extras.begin(), extras.end(), is_option);
  if (option == extras.end()) {
    throw UsageError(command_name + ": '" + extras.front() + "' is one argument too many");
  }
  std::vector<std::string> known;
  for (const CLI::Option* candidate : command.get_options()) {
    for (const std::string& name : candidate->get_lnames()) known.push_back(name);
  }
  const std::string name = option->substr(0, option->find('='));
  std::string remedy = "see lumivec " + command_name + " --help";
  if (const auto near = closest(without_dashes(name), known)) {
    remedy = "did you mean '--" + *near + "'?";
  }
  throw UsageError(command_name + ": there is no option '" + name + "'; " + remedy);
}

// What the parser itself refuses, in this program's words.
std::string parse_error_text(const CLI::ParseError& error) {
  const std::string text = error.what();
  const std::string name = text.substr(0, text.find(':'));
  if (dynamic_cast<const CLI::ArgumentMismatch*>(&error) && name != text) {
    if (text.ends_with("missing")) return name + ": has no value; give one after it";
    if (text.find("At Most") != std::string::npos) {
      return name + ": is given more than once; give it once";
    }
  }
  return text;
}

int explain(Commands& commands) {
  const std::string& topic = commands.help_topic;
  if (topic.empty()) {
    // App::help would explain the command that was given, which is this one.
    std::cout << commands.app.get_formatter()->make_help(&commands.app, "",
                                                         CLI::AppFormatMode::Normal);
    return exit_success;
  }
  for (CLI::App* command : {commands.view, commands.render, commands.walk, commands.info,
                            commands.compare, commands.help}) {
    if (command->get_name() != topic) continue;
    std::cout << command->help();
    return exit_success;
  }
  throw UsageError("help: there is no command '" + topic + "'; " +
                   suggestion(topic, Commands::names()));
}

[[noreturn]] void refuse_without_command(const CLI::App& app) {
  const std::vector<std::string> words = app.remaining();
  if (words.empty()) {
    throw UsageError("no command is given; write: lumivec view SCENE, or lumivec --help");
  }
  const auto word = std::find_if_not(words.begin(), words.end(), is_option);
  if (word == words.end()) {
    const auto near = closest(without_dashes(words.front()), {"help", "version"});
    throw UsageError("there is no option '" + words.front() + "' before a command; " +
                     (near ? "did you mean '--" + *near + "'?" : "see lumivec --help"));
  }
  throw UsageError("there is no command '" + *word + "'; " + suggestion(*word, Commands::names()));
}

// The command as one would type it again.
std::string quoted(const std::vector<std::string>& arguments) {
  std::string text;
  for (const std::string& argument : arguments) {
    const bool plain =
        !argument.empty() && argument.find_first_of(" \t\n'\"\\$&|;<>()*?`") == std::string::npos;
    std::string escaped;
    for (const char c : argument) escaped += c == '\'' ? std::string("'\\''") : std::string(1, c);
    text += (text.empty() ? "" : " ") + (plain ? argument : "'" + escaped + "'");
  }
  return text;
}

// `lumivec SCENE …` is `lumivec view SCENE …`.
std::vector<std::string> with_command(std::vector<std::string> arguments) {
  if (arguments.empty() || is_option(arguments.front())) return arguments;
  const std::string& word = arguments.front();
  const std::vector<std::string> names = Commands::names();
  if (std::find(names.begin(), names.end(), word) != names.end()) return arguments;
  std::error_code error;
  if (word.find_first_of("./") != std::string::npos || std::filesystem::exists(word, error))
    arguments.insert(arguments.begin(), "view");
  return arguments;
}

int run(const std::vector<std::string>& given) {
  const std::vector<std::string> arguments = with_command(given);
  Commands commands;
  commands.render_options.command = commands.walk_options.command = quoted(arguments);
  try {
    commands.app.parse(std::vector<std::string>(arguments.rbegin(), arguments.rend()));
  } catch (const CLI::CallForHelp&) {
    std::cout << commands.app.help();
    return exit_success;
  } catch (const CLI::CallForVersion&) {
    std::cout << version_text() << '\n';
    return exit_success;
  } catch (const CLI::ParseError& error) {
    throw UsageError(parse_error_text(error));
  }

  for (CLI::App* command : {commands.view, commands.render, commands.walk, commands.info,
                            commands.compare, commands.help}) {
    if (*command) refuse_extras(*command, command->get_name());
  }
  if (*commands.help) return explain(commands);
  if (*commands.view) {
    check_view_options(*commands.view, commands.view_options);
    return run_view(commands.view_options);
  }
  if (*commands.render) {
    check_render_options(*commands.render, commands.render_options);
    return run_render(commands.render_options);
  }
  if (*commands.walk) {
    check_walk_options(*commands.walk, commands.walk_options);
    return run_walk(commands.walk_options);
  }
  if (*commands.info) {
    check_info_options(commands.info_options);
    return run_info(commands.info_options);
  }
  if (*commands.compare) {
    check_compare_options(commands.compare_options);
    return run_compare(commands.compare_options);
  }
  refuse_without_command(commands.app);
}

int report(std::string problem, int status) {
  for (char& c : problem) {
    if (c == '\n' || c == '\r') c = ' ';
  }
  std::cout << std::flush;
  std::cerr << "lumivec: " << problem << std::endl;
  return status;
}

}  // namespace

int run_command_line(const std::vector<std::string>& arguments) {
  try {
    return run(arguments);
  } catch (const UsageError& error) {
    return report(error.what(), exit_usage);
  } catch (const std::bad_alloc&) {
    return report("out of memory; choose a smaller --size, or a scene with smaller textures",
                  exit_failure);
  } catch (const std::exception& error) {
    return report(error.what(), exit_failure);
  }
}

}  // namespace lumivec
