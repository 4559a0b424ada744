#include "tools/bench_program.h"

#include <cstdio>
#include <exception>

#include "viewer/atomic_file.h"
#include "viewer/errors.h"
#include "viewer/json_text.h"

namespace lumivec {

int run_benchmark(const char* program, int argc, char** argv, int (*run)(int, char**)) {
  try {
    return run(argc, argv);
  } catch (const UsageError& e) {
    std::fprintf(stderr, "%s: %s\n", program, e.what());
    return exit_usage;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s: %s\n", program, e.what());
    return exit_failure;
  }
}

void add_json_option(CLI::App& app, std::string& file) {
  app.add_option_function<std::string>(
         "--json",
         [&file](const std::string& name) {
           check_writable(name);
           file = name;
         },
         "write all figures to this file")
      ->type_name("FILE");
}

void write_json(const std::string& file, const nlohmann::json& json) {
  if (!file.empty()) write_text_atomically(file, json_text(json));
}

}  // namespace lumivec
