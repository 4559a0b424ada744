// What the benchmarks have in common: how they are started, how they end, where their figures go.
#pragma once

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>
#include <string>

namespace lumivec {

// Calls run, and says on stderr in one line, after the program's name, what it throws. Returns the
// exit status.
int run_benchmark(const char* program, int argc, char** argv, int (*run)(int, char**));

// --json FILE: where all figures go. The option itself refuses a place that cannot be written, so
// that no long run ends in vain.
void add_json_option(CLI::App& app, std::string& file);

// Replaces file as a whole; an empty name writes nothing. Throws CommandError.
void write_json(const std::string& file, const nlohmann::json& json);

}  // namespace lumivec
