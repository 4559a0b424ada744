// glTF materials: metallic-roughness with emissive strength, ior, transmission, volume, specular,
// clearcoat and unlit.
#pragma once

#include <vector>

#include "loader/gltf/textures.h"

namespace lumivec::gltf {

// The materials of a scene, read when an instance first uses them.
class Materials {
 public:
  Materials(Context& context, const Document& document, Scene& scene);

  // Index into Scene::materials of a material of the file, or of glTF's own default one for -1.
  int use(int material);

 private:
  Context& context_;
  const Document& document_;
  Scene& scene_;
  std::vector<int> used_;  // by material of the file, the default last; -1: not yet
};

// Calls function(TextureMap&) for every map of a material.
template <class Function>
void for_each_map(Material& m, const Function& function) {
  for (TextureMap* map :
       {&m.base_color_map, &m.metallic_roughness_map, &m.normal_map, &m.emission_map,
        &m.specular_map, &m.specular_color_map, &m.transmission_map, &m.clearcoat_map,
        &m.clearcoat_roughness_map, &m.clearcoat_normal_map}) {
    function(*map);
  }
}

}  // namespace lumivec::gltf
