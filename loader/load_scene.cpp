#include "loader/load_scene.h"

#include <new>
#include <stdexcept>

#include "loader/byte_source.h"
#include "loader/error.h"
#include "loader/gltf/read_gltf.h"
#include "loader/pov/read_pov.h"

namespace lumivec {
namespace {

ByteSource open(const std::filesystem::path& file) {
  try {
    return ByteSource::open(file, true);
  } catch (const std::runtime_error& error) {
    throw SceneError(file.string(), "", std::string("cannot be opened: ") + error.what(),
                     "check the name and the permissions");
  }
}

}  // namespace

Scene load_scene(const std::filesystem::path& file, const LoadOptions& options,
                 LoadReport& report) {
  report = {};
  const ByteSource bytes = open(file);
  try {
    if (gltf::looks_like_gltf(bytes)) return gltf::read_gltf(file, bytes, options, report);
    if (pov::looks_like_pov(file)) return pov::read_pov(file, bytes, options, report);
  } catch (const SceneError&) {
    throw;
  } catch (const std::bad_alloc&) {
    throw SceneError(file.string(), "", "does not fit into memory", "load a smaller scene");
  } catch (const std::length_error&) {
    throw SceneError(file.string(), "", "does not fit into memory", "load a smaller scene");
  } catch (const std::exception& error) {
    throw SceneError(file.string(), "", error.what(), "check that the files can be read");
  }
  throw SceneError(file.string(), "", "is no scene file that lumivec knows",
                   "give a glTF 2.0 file, .gltf or .glb, or a POV-Ray scene, .pov");
}

}  // namespace lumivec
