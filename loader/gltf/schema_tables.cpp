// The properties of glTF 2.0 and of the supported extensions, as tables: one line a property, in
// the order of the specification.
#include <array>

#include "loader/gltf/schema.h"

namespace lumivec::gltf {
namespace {

constexpr bool required = true;
constexpr bool optional = false;

constexpr Property boolean(std::string_view name) {
  return {name, Kind::boolean};
}
constexpr Property string(std::string_view name, bool must = optional) {
  return {name, Kind::string, must};
}
constexpr Property strings(std::string_view name) {
  return {name, Kind::strings};
}
constexpr Property number(std::string_view name, bool must = optional) {
  return {name, Kind::number, must};
}
constexpr Property numbers(std::string_view name, std::size_t length = 0) {
  return {name, Kind::numbers, optional, {}, nullptr, length};
}
constexpr Property small(std::string_view name, bool must = optional) {
  return {name, Kind::small, must};
}
constexpr Property size(std::string_view name, bool must = optional) {
  return {name, Kind::size, must};
}
constexpr Property index(std::string_view name, std::string_view target, bool must = optional) {
  return {name, Kind::index, must, target};
}
constexpr Property indices(std::string_view name, std::string_view target, bool must = optional) {
  return {name, Kind::indices, must, target};
}
constexpr Property object(std::string_view name, const Schema& schema, bool must = optional) {
  return {name, Kind::object, must, {}, &schema};
}
constexpr Property objects(std::string_view name, const Schema& schema, bool must = optional) {
  return {name, Kind::objects, must, {}, &schema};
}

constexpr Schema empty{};

// asset, buffers, accessors

constexpr std::array asset_table{string("version", required), string("generator"),
                                 string("minVersion")};
constexpr Schema asset{asset_table};

constexpr std::array buffer_table{string("uri"), size("byteLength", required)};
constexpr Schema buffer{buffer_table};

constexpr std::array buffer_view_table{index("buffer", "buffers", required), size("byteOffset"),
                                       size("byteLength", required), size("byteStride")};
constexpr Schema buffer_view{buffer_view_table};

constexpr std::array sparse_indices_table{index("bufferView", "bufferViews", required),
                                          size("byteOffset"), small("componentType", required)};
constexpr Schema sparse_indices{sparse_indices_table};
constexpr std::array sparse_values_table{index("bufferView", "bufferViews", required),
                                         size("byteOffset")};
constexpr Schema sparse_values{sparse_values_table};
constexpr std::array sparse_table{size("count", required),
                                  object("indices", sparse_indices, required),
                                  object("values", sparse_values, required)};
constexpr Schema sparse{sparse_table};
constexpr std::array accessor_table{index("bufferView", "bufferViews"),
                                    size("byteOffset"),
                                    small("componentType", required),
                                    boolean("normalized"),
                                    size("count", required),
                                    string("type", required),
                                    object("sparse", sparse)};
constexpr Schema accessor{accessor_table};

// textures

constexpr std::array image_table{string("uri"), string("mimeType"),
                                 index("bufferView", "bufferViews"), string("name")};
constexpr Schema image{image_table};

constexpr std::array sampler_table{small("magFilter"), small("minFilter"), small("wrapS"),
                                   small("wrapT")};
constexpr Schema sampler{sampler_table};

constexpr std::array texture_webp_table{index("source", "images")};
constexpr Schema texture_webp{texture_webp_table};
constexpr std::array texture_extensions_table{object("EXT_texture_webp", texture_webp)};
constexpr Schema texture_extensions{texture_extensions_table};
constexpr std::array texture_table{index("sampler", "samplers"), index("source", "images"),
                                   object("extensions", texture_extensions)};
constexpr Schema texture{texture_table};

constexpr std::array texture_transform_table{numbers("offset", 2), number("rotation"),
                                             numbers("scale", 2), small("texCoord")};
constexpr Schema texture_transform{texture_transform_table};
constexpr std::array texture_info_extensions_table{
    object("KHR_texture_transform", texture_transform)};
constexpr Schema texture_info_extensions{texture_info_extensions_table};
constexpr std::array texture_info_table{index("index", "textures", required), small("texCoord"),
                                        number("scale"),
                                        object("extensions", texture_info_extensions)};
constexpr Schema texture_info{texture_info_table};

// materials

constexpr std::array metallic_roughness_table{numbers("baseColorFactor", 4),
                                              object("baseColorTexture", texture_info),
                                              number("metallicFactor"), number("roughnessFactor"),
                                              object("metallicRoughnessTexture", texture_info)};
constexpr Schema metallic_roughness{metallic_roughness_table};

constexpr std::array emissive_strength_table{number("emissiveStrength")};
constexpr Schema emissive_strength{emissive_strength_table};
constexpr std::array ior_table{number("ior")};
constexpr Schema ior{ior_table};
constexpr std::array transmission_table{number("transmissionFactor"),
                                        object("transmissionTexture", texture_info)};
constexpr Schema transmission{transmission_table};
constexpr std::array volume_table{number("thicknessFactor"), number("attenuationDistance"),
                                  numbers("attenuationColor", 3)};
constexpr Schema volume{volume_table};
constexpr std::array specular_table{
    number("specularFactor"), object("specularTexture", texture_info),
    numbers("specularColorFactor", 3), object("specularColorTexture", texture_info)};
constexpr Schema specular{specular_table};
constexpr std::array clearcoat_table{
    number("clearcoatFactor"), object("clearcoatTexture", texture_info),
    number("clearcoatRoughnessFactor"), object("clearcoatRoughnessTexture", texture_info),
    object("clearcoatNormalTexture", texture_info)};
constexpr Schema clearcoat{clearcoat_table};

constexpr std::array material_extensions_table{
    object("KHR_materials_emissive_strength", emissive_strength),
    object("KHR_materials_ior", ior),
    object("KHR_materials_transmission", transmission),
    object("KHR_materials_volume", volume),
    object("KHR_materials_specular", specular),
    object("KHR_materials_clearcoat", clearcoat),
    object("KHR_materials_unlit", empty)};
constexpr Schema material_extensions{material_extensions_table};
constexpr std::array material_table{string("name"),
                                    object("pbrMetallicRoughness", metallic_roughness),
                                    object("normalTexture", texture_info),
                                    object("emissiveTexture", texture_info),
                                    numbers("emissiveFactor", 3),
                                    string("alphaMode"),
                                    number("alphaCutoff"),
                                    boolean("doubleSided"),
                                    object("extensions", material_extensions)};
constexpr Schema material{material_table};

// meshes

constexpr std::array primitive_table{Property{"attributes", Kind::index_map, required, "accessors"},
                                     index("indices", "accessors"),
                                     index("material", "materials"),
                                     small("mode"),
                                     Property{"targets", Kind::index_maps, optional, "accessors"},
                                     Property{"extras", Kind::sphere_extras}};
constexpr Schema primitive{primitive_table};
constexpr std::array mesh_table{string("name"), objects("primitives", primitive, required),
                                numbers("weights")};
constexpr Schema mesh{mesh_table};

constexpr std::array skin_table{string("name"), index("inverseBindMatrices", "accessors"),
                                indices("joints", "nodes", required)};
constexpr Schema skin{skin_table};

// cameras and lights

constexpr std::array perspective_table{number("aspectRatio"), number("yfov", required),
                                       number("zfar"), number("znear", required)};
constexpr Schema perspective{perspective_table};
constexpr std::array orthographic_table{number("xmag", required), number("ymag", required),
                                        number("zfar", required), number("znear", required)};
constexpr Schema orthographic{orthographic_table};
constexpr std::array camera_table{string("name"), string("type", required),
                                  object("perspective", perspective),
                                  object("orthographic", orthographic)};
constexpr Schema camera{camera_table};

constexpr std::array spot_table{number("innerConeAngle"), number("outerConeAngle")};
constexpr Schema spot{spot_table};
constexpr std::array light_table{string("name"),      numbers("color", 3),
                                 number("intensity"), string("type", required),
                                 number("range"),     object("spot", spot)};
constexpr Schema light{light_table};
constexpr std::array lights_table{objects("lights", light)};
constexpr Schema lights{lights_table};
constexpr std::array root_extensions_table{object("KHR_lights_punctual", lights)};
constexpr Schema root_extensions{root_extensions_table};

// nodes, scenes, animations

constexpr std::array node_light_table{
    index("light", "extensions/KHR_lights_punctual/lights", required)};
constexpr Schema node_light{node_light_table};
constexpr std::array instancing_table{
    Property{"attributes", Kind::index_map, required, "accessors"}};
constexpr Schema instancing{instancing_table};
constexpr std::array node_extensions_table{object("KHR_lights_punctual", node_light),
                                           object("EXT_mesh_gpu_instancing", instancing)};
constexpr Schema node_extensions{node_extensions_table};
constexpr std::array node_table{string("name"),
                                indices("children", "nodes"),
                                index("camera", "cameras"),
                                index("mesh", "meshes"),
                                index("skin", "skins"),
                                numbers("matrix", 16),
                                numbers("rotation", 4),
                                numbers("scale", 3),
                                numbers("translation", 3),
                                numbers("weights"),
                                object("extensions", node_extensions)};
constexpr Schema node{node_table};

constexpr std::array scene_table{string("name"), indices("nodes", "nodes")};
constexpr Schema scene{scene_table};

constexpr std::array target_table{index("node", "nodes"), string("path", required)};
constexpr Schema target{target_table};
constexpr std::array channel_table{small("sampler", required), object("target", target, required)};
constexpr Schema channel{channel_table};
constexpr std::array animation_sampler_table{index("input", "accessors", required),
                                             string("interpolation"),
                                             index("output", "accessors", required)};
constexpr Schema animation_sampler{animation_sampler_table};
constexpr std::array animation_table{string("name"), objects("channels", channel, required),
                                     objects("samplers", animation_sampler, required)};
constexpr Schema animation{animation_table};

constexpr std::array root_table{object("asset", asset, required),
                                strings("extensionsUsed"),
                                strings("extensionsRequired"),
                                objects("buffers", buffer),
                                objects("bufferViews", buffer_view),
                                objects("accessors", accessor),
                                objects("images", image),
                                objects("samplers", sampler),
                                objects("textures", texture),
                                objects("materials", material),
                                objects("meshes", mesh),
                                objects("skins", skin),
                                objects("cameras", camera),
                                objects("nodes", node),
                                index("scene", "scenes"),
                                objects("scenes", scene),
                                objects("animations", animation),
                                object("extensions", root_extensions)};

}  // namespace

constexpr Schema root_schema{root_table};

}  // namespace lumivec::gltf
