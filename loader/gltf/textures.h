// glTF textures as TextureMap: image, sampler, UV set and KHR_texture_transform.
#pragma once

#include "loader/gltf/document.h"

namespace lumivec::gltf {

// Reads texture references. TextureMap::image is an index into the images of the file until
// images.h replaces it.
class Textures {
 public:
  Textures(Context& context, const Document& document) : context_(context), document_(document) {}

  // A core texture reference (TextureInfo, NormalTextureInfo); no image where there is none.
  template <class Info>
  TextureMap map(const Info& info, Encoding encoding, const std::string& where) {
    return map(info.index, info.texCoord, info.extensions, encoding, where);
  }

  // A texture reference inside an extension of a material.
  TextureMap map(const tinygltf::Value& extension, const std::string& name, Encoding encoding,
                 const std::string& where);

 private:
  TextureMap map(int texture, int uv_set, const tinygltf::ExtensionMap& extensions,
                 Encoding encoding, const std::string& where);
  TextureMap map(int texture, int uv_set, const tinygltf::Value* transform, Encoding encoding,
                 const std::string& where);

  Context& context_;
  const Document& document_;
};

}  // namespace lumivec::gltf
