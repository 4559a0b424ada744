// Scene files that nobody would write: loads mutants of real ones, in memory, until its time is
// over. Meant for builds with sanitizers (presets asan and tsan): each mutant has to give a scene
// whose every index and number can be relied on, or one line that says what is wrong.
//
// Mutants come from a seed: the same call tries the same ones in the same order. The one being
// tried is kept in a file, so that it is there when the program dies.
#include <chrono>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include "loader/error.h"
#include "loader/gltf/read_gltf.h"
#include "loader/pov/read_pov.h"
#include "tools/bench_program.h"
#include "viewer/errors.h"

namespace lumivec {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

// Bounds that a mutant reaches within a second or so.
LoadOptions tight_options() {
  LoadOptions options;
  options.language.max_steps = 200'000;
  options.language.max_macro_depth = 200;
  options.language.max_nesting = 60;
  options.language.max_depth = 200;
  options.language.max_parts = 200'000;
  options.max_bytes = std::uint64_t{1} << 28;
  return options;
}

struct Seed {
  fs::path file;
  bool pov = false;
  std::vector<std::string> tokens;  // joined, they are the file
};

// Words, numbers, strings, runs of white space, and single characters of all else.
std::vector<std::string> tokens_of(const std::string& text) {
  std::vector<std::string> tokens;
  const auto is_word = [](unsigned char c) { return std::isalnum(c) != 0 || c == '_' || c == '.'; };
  for (std::size_t i = 0; i < text.size();) {
    std::size_t end = i + 1;
    const auto c = static_cast<unsigned char>(text[i]);
    if (is_word(c)) {
      while (end < text.size() && is_word(static_cast<unsigned char>(text[end]))) ++end;
    } else if (c == '"') {
      while (end < text.size() && text[end] != '"' && text[end] != '\n') ++end;
      end = std::min(end + 1, text.size());
    } else if (std::isspace(c) != 0) {
      while (end < text.size() && std::isspace(static_cast<unsigned char>(text[end])) != 0) ++end;
    }
    tokens.push_back(text.substr(i, end - i));
    i = end;
  }
  return tokens;
}

class Mutator {
 public:
  Mutator(std::vector<Seed> seeds, std::uint64_t seed) : seeds_(std::move(seeds)), random_(seed) {}

  const Seed& next(std::string& text) {
    const Seed& seed = seeds_[below(seeds_.size())];
    std::vector<std::string> tokens = seed.tokens;
    for (std::size_t i = 0, n = 1 + below(8); i < n && !tokens.empty(); ++i)
      mutate(tokens, seed.pov);
    text.clear();
    for (const std::string& token : tokens) text += token;
    if (below(8) == 0 && !text.empty()) text.resize(below(text.size()));
    for (std::size_t i = 0, n = below(4) == 0 ? below(6) : 0; i < n && !text.empty(); ++i)
      text[below(text.size())] = static_cast<char>(below(256));
    return seed;
  }

 private:
  std::size_t below(std::size_t n) {
    return std::uniform_int_distribution<std::size_t>(0, n - 1)(random_);
  }

  std::vector<std::string> some_of(const std::vector<std::string>& tokens, std::size_t most) {
    const std::size_t first = below(tokens.size());
    const std::size_t count = std::min(1 + below(most), tokens.size() - first);
    return {tokens.begin() + std::ptrdiff_t(first), tokens.begin() + std::ptrdiff_t(first + count)};
  }

  void mutate(std::vector<std::string>& tokens, bool pov) {
    constexpr std::size_t most = 40;
    const auto at = [&] { return tokens.begin() + std::ptrdiff_t(below(tokens.size())); };
    switch (below(7)) {
      case 0: {
        const auto first = at();
        const auto left = static_cast<std::size_t>(tokens.end() - first);
        tokens.erase(first, first + std::ptrdiff_t(1 + below(std::min(most, left))));
        break;
      }
      case 1: {
        const std::vector<std::string> again = some_of(tokens, most);
        tokens.insert(at(), again.begin(), again.end());
        break;
      }
      case 2:
        std::swap(*at(), *at());
        break;
      case 3:
      case 4:
        replace_number(tokens);
        break;
      case 5:
        *at() = tokens[below(tokens.size())];
        break;
      default: {
        const Seed& other = seeds_[below(seeds_.size())];
        if (other.pov != pov || other.tokens.empty()) break;
        const std::vector<std::string> part = some_of(other.tokens, 4 * most);
        tokens.insert(at(), part.begin(), part.end());
      }
    }
  }

  // By one that programs trip over.
  void replace_number(std::vector<std::string>& tokens) {
    static const std::vector<std::string> numbers = {
        "0",     "1",      "-1",         "2",          "0.5",       "1e-30", "1e30",
        "1e300", "-1e300", "4294967295", "2147483648", "100000",    "3",     "255",
        "65536", "1e-320", "-0.0",       "0.9999999",  "123456789", "(0/0)", "7"};
    const std::size_t start = below(tokens.size());
    for (std::size_t k = 0; k < tokens.size(); ++k) {
      std::string& token = tokens[(start + k) % tokens.size()];
      if (token.empty() || std::isdigit(static_cast<unsigned char>(token[0])) == 0) continue;
      token = numbers[below(numbers.size())];
      return;
    }
  }

  std::vector<Seed> seeds_;
  std::mt19937_64 random_;
};

bool within(int index, std::size_t count) {
  return index >= 0 && static_cast<std::size_t>(index) < count;
}

// What the contract promises (loader/scene.h); empty: it is kept.
std::string broken_promise(const Scene& scene) {
  const auto finite = [](const auto& v) { return std::isfinite(v.x + v.y + v.z); };
  for (const Mesh& mesh : scene.meshes) {
    for (const auto& t : mesh.triangles) {
      if (std::max({t.x, t.y, t.z}) >= mesh.positions.size()) return "a triangle's vertex";
    }
    for (const V3f& p : mesh.positions) {
      if (!finite(p)) return "a position";
    }
    for (const V3f& n : mesh.normals) {
      if (!finite(n)) return "a normal";
    }
    if (!mesh.normals.empty() && mesh.normals.size() != mesh.positions.size()) return "normals";
  }
  for (const Instance& instance : scene.instances) {
    const bool shape = within(instance.mesh, scene.meshes.size()) ||
                       within(instance.sphere, scene.spheres.size()) ||
                       (instance.mesh < 0 && instance.sphere < 0);
    if (!shape) return "an instance's shape";
    if (instance.material >= 0 && !within(instance.material, scene.materials.size()))
      return "an instance's material";
    const double d = instance.object_to_world.determinant();
    if (!std::isfinite(d) || d == 0.0) return "an instance's transform";
  }
  for (const Sphere& sphere : scene.spheres) {
    if (!(sphere.radius > 0.0f) || !std::isfinite(sphere.radius)) return "a sphere's radius";
  }
  for (const Material& m : scene.materials) {
    if (!finite(m.base_color) || !finite(m.emission)) return "a material's color";
    if (!std::isfinite(m.opacity + m.metallic + m.roughness + m.ior + m.transmission))
      return "a material's number";
  }
  for (const Light& light : scene.lights) {
    if (!finite(light.intensity)) return "a light's intensity";
  }
  return {};
}

void add_seeds(const fs::path& place, std::vector<Seed>& seeds) {
  std::vector<fs::path> files;
  if (fs::is_directory(place)) {
    for (const auto& entry : fs::recursive_directory_iterator(place)) files.push_back(entry.path());
  } else {
    files.push_back(place);
  }
  std::sort(files.begin(), files.end());
  for (const fs::path& file : files) {
    const bool pov = file.extension() == ".pov";
    if (!pov && file.extension() != ".gltf") continue;
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream text;
    text << stream.rdbuf();
    seeds.push_back({file, pov, tokens_of(text.str())});
  }
}

struct Counts {
  std::uint64_t loaded = 0, refused = 0;
  double last = 0.0, slowest = 0.0;  // seconds
};

// Throws CommandError for what no user should see.
void try_mutant(const Seed& seed, const std::string& text, LoadOptions options, Counts& counts) {
  const Clock::time_point start = Clock::now();
  LoadReport report;
  try {
    const ByteSource bytes = ByteSource::from_memory({text.begin(), text.end()});
    const Scene scene = seed.pov ? pov::read_pov(seed.file, bytes, options, report)
                                 : gltf::read_gltf(seed.file, bytes, options, report);
    const std::string broken = broken_promise(scene);
    if (!broken.empty())
      throw CommandError("a scene came through that breaks a promise: " + broken);
    ++counts.loaded;
  } catch (const SceneError& error) {
    const std::string line = error.what();
    if (line.empty() || line.find('\n') != std::string::npos)
      throw CommandError("an error that is not one line: " + line);
    ++counts.refused;
  } catch (const std::bad_alloc&) {
    ++counts.refused;  // load_scene says so in one line
  }
  counts.last = std::chrono::duration<double>(Clock::now() - start).count();
  counts.slowest = std::max(counts.slowest, counts.last);
}

int run(int argc, char** argv) {
  CLI::App app("Loads mutants of scene files and checks that each gives a sound scene or one line");
  std::vector<std::string> places;
  std::string json, keep = "mutant";
  double seconds = 60.0, slow = 20.0;
  std::uint64_t seed = 0;
  std::uint64_t most = 0;
  LoadOptions options = tight_options();
  std::vector<std::string> include_paths;
  app.add_option("SCENE", places, "Scene files, or folders of them: .pov, .gltf")->required();
  app.add_option("--include-path", include_paths, "Folder that POV-Ray's includes are searched in");
  app.add_option("--seconds", seconds, "How long [60]")->check(CLI::PositiveNumber);
  app.add_option("--count", most, "Mutants at most [0: as the time allows]");
  app.add_option("--seed", seed, "Of the mutants [0]");
  app.add_option("--keep", keep,
                 "Where the mutant being tried is kept; .pov or .gltf is added [mutant]");
  app.add_option("--slow", slow, "Mutants that take longer, in seconds, are kept too [20]");
  add_json_option(app, json);
  CLI11_PARSE(app, argc, argv);
  for (const std::string& path : include_paths) options.include_paths.emplace_back(path);
  std::vector<Seed> seeds;
  for (const std::string& place : places) {
    if (!fs::exists(place)) throw CommandError(place + ": there is no such file or folder");
    add_seeds(place, seeds);
  }
  if (seeds.empty()) throw CommandError("there is no .pov or .gltf file in what was given");

  Mutator mutator(seeds, seed);
  Counts counts;
  std::uint64_t tried = 0;
  std::string text;
  const Clock::time_point start = Clock::now();
  const auto passed = [&] { return std::chrono::duration<double>(Clock::now() - start).count(); };
  while (passed() < seconds && (most == 0 || tried < most)) {
    const Seed& from = mutator.next(text);
    const std::string extension = from.pov ? ".pov" : ".gltf";
    std::ofstream(keep + extension, std::ios::binary) << text;
    ++tried;
    try {
      try_mutant(from, text, options, counts);
    } catch (const CommandError& error) {
      throw CommandError("mutant " + std::to_string(tried) + " of " + from.file.string() + ": " +
                         error.what());
    }
    if (counts.last <= slow) continue;
    const std::string kept = keep + "_slow_" + std::to_string(tried) + extension;
    std::ofstream(kept, std::ios::binary) << text;
    std::printf("%s: %.1f s, from %s\n", kept.c_str(), counts.last, from.file.string().c_str());
  }
  std::printf("%llu mutants of %zu files in %.0f s: %llu loaded, %llu refused, %.1f s at most\n",
              static_cast<unsigned long long>(tried), seeds.size(), passed(),
              static_cast<unsigned long long>(counts.loaded),
              static_cast<unsigned long long>(counts.refused), counts.slowest);
  write_json(json, {{"mutants", tried},
                    {"files", seeds.size()},
                    {"seconds", passed()},
                    {"loaded", counts.loaded},
                    {"refused", counts.refused},
                    {"slowest_seconds", counts.slowest}});
  return 0;
}

}  // namespace
}  // namespace lumivec

int main(int argc, char** argv) {
  return lumivec::run_benchmark("fuzz_loaders", argc, argv, lumivec::run);
}
