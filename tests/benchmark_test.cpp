// The benchmarks as a user meets them, on tiny pictures: what they write, not how fast they are.
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "command_runner.h"
#include "temporary_folder.h"

namespace {

class Benchmark : public testing::Test {
 protected:
  CommandResult run(const std::string& program, std::vector<std::string> arguments) const {
    for (const char* word : {"--size", "16x16", "--reference-samples", "4", "--json", "out.json"}) {
      arguments.emplace_back(word);
    }
    return run_command(program, arguments, folder.path());
  }
  nlohmann::json written() const {
    std::ifstream stream(folder / "out.json");
    return nlohmann::json::parse(stream);
  }

  TemporaryFolder folder;
};

}  // namespace

TEST_F(Benchmark, TellsErrorsAndKeepsItsReference) {
  const std::vector<std::string> arguments = {
      "--scene", "cornell_box_1", "--method", "path",    "--method",    "light-vectors-hessian",
      "--first", "0.05",          "--plot",   "out.svg", "--doublings", "1"};
  const CommandResult first = run(LUMIVEC_BENCH_ERROR, arguments);
  ASSERT_EQ(first.status, 0) << first.err;
  EXPECT_NE(first.err.find("renders a reference"), std::string::npos) << first.err;
  nlohmann::json scene = written()["scenes"][0];
  EXPECT_EQ(scene["reference"]["kept_from_before"], false);
  ASSERT_EQ(scene["methods"].size(), 2u);
  for (const nlohmann::json& method : scene["methods"]) {
    ASSERT_EQ(method["renders"].size(), 2u);
    for (const nlohmann::json& render : method["renders"]) {
      EXPECT_GT(render["core_seconds"], 0.0);
      EXPECT_GE(render["samples_per_pixel"], 1.0);
      for (const char* term : {"emitted", "specular", "direct", "indirect", "caustic", "sum"}) {
        EXPECT_GE(render["errors"][term]["relmse"], 0.0) << term;
        EXPECT_GE(render["errors"][term]["rmse"], 0.0) << term;
      }
    }
    EXPECT_TRUE(method["to_target"]["sum"].contains("kind"));
  }
  EXPECT_GT(scene["methods"][1]["renders"][0]["records"], 0);

  std::ifstream plot(folder / "out.svg");
  const std::string svg(std::istreambuf_iterator<char>(plot), {});
  EXPECT_EQ(svg.substr(0, 4), "<svg");
  EXPECT_NE(svg.find("light-vectors-hessian"), std::string::npos);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_EQ(svg.find("inf"), std::string::npos);

  const CommandResult second = run(LUMIVEC_BENCH_ERROR, arguments);
  ASSERT_EQ(second.status, 0) << second.err;
  EXPECT_EQ(second.err, "");
  EXPECT_EQ(written()["scenes"][0]["reference"]["kept_from_before"], true);
}
TEST_F(Benchmark, TellsWhatPartsAreWorth) {
  const CommandResult result =
      run(LUMIVEC_BENCH_VALIDITY, {"--records", "90", "--samples", "1", "--time", "0.05"});
  ASSERT_EQ(result.status, 0) << result.err;
  const nlohmann::json json = written();
  for (const char* kind : {"equal_records", "equal_time"}) {
    ASSERT_EQ(json[kind].size(), 7u);
    EXPECT_EQ(json[kind][0]["variant"], "all parts");
    EXPECT_GT(json[kind][0]["records"], 0);
    EXPECT_EQ(json[kind][1]["variant"], "no hessian");
    EXPECT_GE(json[kind][1]["relmse"], 0.0);
  }
}
TEST_F(Benchmark, RefusesWhatItCannotWrite) {
  const CommandResult result =
      run_command(LUMIVEC_BENCH_ERROR, {"--json", "no/such/folder.json"}, folder.path());
  EXPECT_EQ(result.status, 1);
  EXPECT_EQ(result.err,
            "bench_error: no/such/folder.json: the folder no/such does not exist; make it first, "
            "or choose another place\n");
}
