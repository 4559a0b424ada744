#include "loader/gltf/textures.h"

#include <cmath>

#include "loader/gltf/extensions.h"

namespace lumivec::gltf {
namespace {

constexpr const char* transform_name = "KHR_texture_transform";

// UV sets are arrays of a mesh; one that names thousands of them is broken.
constexpr int max_uv_sets = 16;

Wrap wrap_of(Context& context, int wrap, const std::string& where) {
  switch (wrap) {
    case TINYGLTF_TEXTURE_WRAP_REPEAT:
      return Wrap::repeat;
    case TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT:
      return Wrap::mirrored_repeat;
    case TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE:
      return Wrap::clamp_to_edge;
    default:
      context.warn(where, "wrap mode " + std::to_string(wrap) + " is unknown, taken as repeat");
      return Wrap::repeat;
  }
}

// (u, v) is scaled, then turned by rotation counter-clockwise as seen in the image, then shifted.
M33f transform_of(const tinygltf::Value& transform) {
  const V2f offset = vector_or(transform, "offset", V2f(0.0f));
  const V2f scale = vector_or(transform, "scale", V2f(1.0f));
  const double rotation = number_or(transform, "rotation", 0.0);
  const auto c = static_cast<float>(std::cos(rotation));
  const auto s = static_cast<float>(std::sin(rotation));
  return {c * scale.x, -s * scale.x, 0, s * scale.y, c * scale.y, 0, offset.x, offset.y, 1};
}

}  // namespace

TextureMap Textures::map(const tinygltf::Value& extension, const std::string& name,
                         Encoding encoding, const std::string& where) {
  if (!extension.Has(name)) return {};
  const tinygltf::Value& info = extension.Get(name);
  const tinygltf::Value* transform = nullptr;
  if (info.Has("extensions") && info.Get("extensions").Has(transform_name)) {
    transform = &info.Get("extensions").Get(transform_name);
  }
  return map(index_or(info, "index", -1), index_or(info, "texCoord", 0), transform, encoding,
             where + "/" + name);
}

TextureMap Textures::map(int texture, int uv_set, const tinygltf::ExtensionMap& extensions,
                         Encoding encoding, const std::string& where) {
  return map(texture, uv_set, find_extension(extensions, transform_name), encoding, where);
}

TextureMap Textures::map(int index, int uv_set, const tinygltf::Value* transform, Encoding encoding,
                         const std::string& where) {
  TextureMap map;
  if (index < 0) return map;
  const auto place = static_cast<std::size_t>(index);
  const tinygltf::Texture& texture = document_.model.textures[place];
  int source = texture.source;
  if (const auto* webp = find_extension(texture.extensions, "EXT_texture_webp")) {
    source = index_or(*webp, "source", source);
  }
  map.uv_set = transform ? index_or(*transform, "texCoord", uv_set) : uv_set;
  if (source < 0 || map.uv_set >= max_uv_sets) {
    context_.warn(where, source < 0 ? "texture " + std::to_string(index) +
                                          " has no image of a supported kind and is left out"
                                    : "UV set " + std::to_string(map.uv_set) +
                                          " is out of reach, and the texture is left out");
    return {};
  }
  map.image = source;
  map.encoding = encoding;
  if (transform) map.uv_transform = transform_of(*transform);
  if (texture.sampler >= 0) {
    const auto& sampler = document_.model.samplers[static_cast<std::size_t>(texture.sampler)];
    const std::string at = pointer({"samplers", static_cast<std::size_t>(texture.sampler)});
    map.wrap_u = wrap_of(context_, sampler.wrapS, at);
    map.wrap_v = wrap_of(context_, sampler.wrapT, at);
    if (sampler.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST) map.filter = Filter::nearest;
  }
  return map;
}

}  // namespace lumivec::gltf
