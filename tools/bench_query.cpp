// The paper's query experiment (section 3.3) on the cache in five dimensions: the time of a look-up
// with more and more points, with more and more directions, and with both.
//
// Points are spread over the walls of a room and reach so far that about seven of them cover a
// place; directions are spread over the hemisphere above the wall. Look-ups are at random places of
// the walls and in random directions, which no cache of the processor foresees, and add up the
// light vectors that they find.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "integrator/frame.h"
#include "integrator/light_vector.h"
#include "integrator/light_vector_cache.h"
#include "integrator/sampling.h"
#include "tools/bench_program.h"

namespace lumivec {
namespace {

constexpr float room_size = 1.0f;
constexpr float wall_area = 6.0f * room_size * room_size;
constexpr float points_over_a_place = 7.0f;
// Look-ups between two readings of the clock: enough that the clock does not count.
constexpr std::size_t batch_size = 256;
// More than any case needs.
constexpr std::size_t max_bytes = std::size_t{16} << 30;

class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  float operator()() { return std::generate_canonical<float, 24>(engine_); }
  V2f pair() {
    const float u = (*this)();
    return V2f(u, (*this)());
  }

 private:
  std::mt19937_64 engine_;
};

struct Place {
  V3f position{0.0f}, normal{0.0f};
};

Place random_place(Random& random) {
  const int wall = std::min(static_cast<int>(random() * 6.0f), 5);
  const int axis = wall / 2;
  Place place;
  place.normal[axis] = wall % 2 == 0 ? 1.0f : -1.0f;
  for (int i = 0; i < 3; ++i) place.position[i] = random() * room_size;
  place.position[axis] = wall % 2 == 0 ? 0.0f : room_size;
  return place;
}

// Uniform on the hemisphere.
V3f random_direction(const Place& place, Random& random) {
  const V2f u = random.pair();
  const float sine = std::sqrt(std::max(0.0f, 1.0f - u.x * u.x));
  const float phi = 2.0f * std::numbers::pi_v<float> * u.y;
  return make_frame(place.normal)
      .to_world(V3f(sine * std::cos(phi), sine * std::sin(phi), u.x))
      .normalized();
}

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double percentile(std::vector<double>& values, double share) {
  std::sort(values.begin(), values.end());
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

// Keeps the compiler from leaving out a loop whose result is not used.
volatile float sink;

using Cache = LightVectorCache<LightVector>;

struct Case {
  int points = 0, directions = 0;
};

struct Options {
  std::size_t queries = 200'000;
  std::size_t packet = 16;
  float cone_degrees = 5.0f;
  bool scattered = false;
  bool balance = true;
};

nlohmann::json measure(const Case& c, const Options& options) {
  Random random(1);
  Cache cache(max_bytes);
  const float reach = std::sqrt(points_over_a_place * wall_area /
                                (std::numbers::pi_v<float> * static_cast<float>(c.points)));
  std::vector<Place> places(static_cast<std::size_t>(c.points));
  for (Place& place : places) place = random_place(random);
  LightVector record;
  record.magnitude = Color(1.0f);

  double insertion = 0.0;
  const auto insert = [&](const Place& place) {
    record.direction = random_direction(place, random);
    cache.insert(place.position, reach, 0.0f, record.direction, record);
  };
  const double start = now();
  if (options.scattered) {
    for (int d = 0; d < c.directions; ++d)
      for (const Place& place : places) insert(place);
  } else {
    for (const Place& place : places)
      for (int d = 0; d < c.directions; ++d) insert(place);
  }
  insertion = now() - start;
  const double records = cache.record_count();
  const double balance_start = now();
  if (options.balance) cache.balance();
  const double balance = now() - balance_start;

  std::vector<Cache::Query> queries(batch_size);
  const float min_cosine = std::cos(options.cone_degrees * std::numbers::pi_v<float> / 180.0f);
  std::vector<double> times;
  std::vector<V3f> totals(batch_size);
  std::uint64_t found = 0;
  float sum = 0.0f;
  for (std::size_t done = 0; done < options.queries; done += batch_size) {
    for (Cache::Query& q : queries) {
      const Place place = random_place(random);
      q = {place.position, random_direction(place, random), 1.0f, min_cosine};
    }
    std::fill(totals.begin(), totals.end(), V3f(0.0f));
    const double begin = now();
    for (std::size_t first = 0; first < batch_size; first += options.packet) {
      V3f* total = totals.data() + first;
      cache.look_up(queries.data() + first, std::min(options.packet, batch_size - first),
                    [&](std::size_t query, const LightVector& v, float distance2, float cosine) {
                      total[query] += v.direction * (v.magnitude.x * cosine * (1.0f - distance2));
                      ++found;
                    });
    }
    times.push_back((now() - begin) / batch_size);
    for (const V3f& total : totals) sum += total.x;
  }
  sink = sum;
  const double looked = static_cast<double>(times.size() * batch_size);
  const double mean_found = static_cast<double>(found) / looked;
  const double median = percentile(times, 0.5), slow = percentile(times, 0.95);
  const double bytes = static_cast<double>(cache.bytes()) / records;
  std::printf("%9d %10d %11.0f %9.2f %9.2f %9.1f %11.2f %9.3f %9.1f\n", c.points, c.directions,
              records, median * 1e6, slow * 1e6, mean_found, insertion / records * 1e6, balance,
              bytes);
  std::fflush(stdout);
  return {{"points", c.points},
          {"directions", c.directions},
          {"records", records},
          {"query_median_seconds", median},
          {"query_95th_percentile_seconds", slow},
          {"records_found", mean_found},
          {"insertion_seconds", insertion / records},
          {"balance_seconds", balance},
          {"bytes_per_record", bytes}};
}

int run(int argc, char** argv) {
  CLI::App app(
      "Time of a look-up in the five-dimensional cache with up to 100,000 points, up to 1,000 "
      "directions, and both; one thread.");
  Options options;
  std::string json_file;
  std::vector<int> only;
  add_json_option(app, json_file);
  app.add_option("--case", only, "only this number of points and of directions")->expected(2);
  app.add_option("--queries", options.queries, "look-ups a case")
      ->capture_default_str()
      ->check(CLI::Range(batch_size, std::size_t{100'000'000}));
  app.add_option(
         "--packet", options.packet,
         "look-ups that are made together, as a renderer shades several hits; 1: one by one")
      ->capture_default_str()
      ->check(CLI::Range(std::size_t{1}, batch_size));
  app.add_option("--cone", options.cone_degrees, "angle of directions that fit, in degrees")
      ->capture_default_str()
      ->check(CLI::Range(0.0, 180.0));
  app.add_flag("--scattered", options.scattered,
               "insert the records of one point far apart, not one after the other");
  app.add_flag("!--no-balance", options.balance,
               "look up in the cache as the insertions left it; else it is balanced before");
  CLI11_PARSE(app, argc, argv);

  std::vector<std::pair<std::string, std::vector<Case>>> series = {
      {"points", {{1'000, 100}, {3'000, 100}, {10'000, 100}, {30'000, 100}, {100'000, 100}}},
      {"directions", {{10'000, 1}, {10'000, 10}, {10'000, 100}, {10'000, 300}, {10'000, 1'000}}},
      {"both", {{100, 10}, {1'000, 32}, {3'000, 100}, {10'000, 320}, {31'623, 316}}}};
  if (!only.empty()) {
    for (const int n : only) {
      if (n < 1) throw std::invalid_argument("--case: numbers above 0 are needed");
    }
    series = {{"case", {{only[0], only[1]}}}};
  }

  std::printf("look-ups within %g degrees, %zu at a time, one thread; cache %s\n",
              static_cast<double>(options.cone_degrees), options.packet,
              options.balance ? "balanced after the insertions" : "as the insertions left it");
  std::printf("%9s %10s %11s %9s %9s %9s %11s %9s %9s\n", "points", "directions", "records",
              "median us", "95% us", "found", "insert us", "balance s", "B/record");
  nlohmann::json all;
  for (const auto& [name, cases] : series) {
    for (const Case& c : cases) all[name].push_back(measure(c, options));
  }
  write_json(json_file, {{"queries", options.queries},
                         {"cone_degrees", options.cone_degrees},
                         {"packet", options.packet},
                         {"scattered", options.scattered},
                         {"balanced", options.balance},
                         {"series", all}});
  return 0;
}

}  // namespace
}  // namespace lumivec

int main(int argc, char** argv) {
  return lumivec::run_benchmark("bench_query", argc, argv, lumivec::run);
}
