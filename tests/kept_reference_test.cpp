#include "tools/kept_reference.h"

#include <gtest/gtest.h>

#include <fstream>

#include "loader/load_scene.h"
#include "temporary_folder.h"
#include "viewer/errors.h"

using namespace lumivec;
namespace fs = std::filesystem;

namespace {

class KeptReference : public testing::Test {
 protected:
  KeptReference() {
    for (const char* name : {"cornell_box_1.gltf", "cornell_box_1.bin"}) {
      fs::copy_file(fs::path(LUMIVEC_SOURCE_DIR) / "scenes" / name, folder / name);
    }
    request.scene_file = folder / "cornell_box_1.gltf";
    request.width = request.height = 8;
    request.samples = 4;
    request.folder = folder / "references";
    LoadReport report;
    scene = load_scene(request.scene_file, LoadOptions(), report);
  }

  fs::path description() const { return reference_file(request).replace_extension(".json"); }

  TemporaryFolder folder;
  ReferenceRequest request;
  Scene scene;
};

}  // namespace

TEST_F(KeptReference, IsRenderedOnce) {
  int renders = 0;
  const Reference first = kept_reference(scene, request, [&] { ++renders; });
  const Reference second = kept_reference(scene, request, [&] { ++renders; });
  EXPECT_EQ(renders, 1);
  EXPECT_FALSE(first.was_kept);
  EXPECT_TRUE(second.was_kept);
  EXPECT_EQ(second.core_seconds, first.core_seconds);
  for (std::size_t i = 0; i < layer_count; ++i) {
    EXPECT_EQ(second.pictures[i].pixels, first.pictures[i].pixels) << error_layer_name(i);
    EXPECT_EQ(second.noise[i].rmse, first.noise[i].rmse);
    EXPECT_EQ(second.noise[i].relmse, first.noise[i].relmse);
  }
  EXPECT_GT(first.noise[sum_layer].relmse, 0.0);
}
TEST_F(KeptReference, IsOfOneSizeAndNumberOfSamples) {
  kept_reference(scene, request);
  request.width = 4;
  EXPECT_FALSE(kept_reference(scene, request).was_kept);
  request.samples = 2;
  EXPECT_FALSE(kept_reference(scene, request).was_kept);
  EXPECT_TRUE(kept_reference(scene, request).was_kept);
}
TEST_F(KeptReference, IsOfOneContent) {
  kept_reference(scene, request);
  const std::string hash = scene_hash(request.scene_file);
  std::ofstream(folder / "cornell_box_1.bin", std::ios::app) << "more";
  EXPECT_NE(scene_hash(request.scene_file), hash);
  EXPECT_FALSE(kept_reference(scene, request).was_kept);
}
TEST_F(KeptReference, IsRenderedAgainWhereItIsBroken) {
  kept_reference(scene, request);
  std::ofstream(reference_file(request), std::ios::trunc) << "no picture";
  EXPECT_FALSE(kept_reference(scene, request).was_kept);
  std::ofstream(description(), std::ios::trunc) << "{\"identity\": ";
  EXPECT_FALSE(kept_reference(scene, request).was_kept);
  fs::remove(description());
  EXPECT_FALSE(kept_reference(scene, request).was_kept);
  EXPECT_TRUE(kept_reference(scene, request).was_kept);
}
TEST_F(KeptReference, NeedsHalves) {
  request.samples = 3;
  EXPECT_THROW(kept_reference(scene, request), UsageError);
}
TEST_F(KeptReference, NeedsAScene) {
  request.scene_file = folder / "nothing.gltf";
  EXPECT_THROW(kept_reference(scene, request), CommandError);
}
