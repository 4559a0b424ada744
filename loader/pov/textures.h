// Textures, and what is the usual for objects that say nothing.
#pragma once

#include "loader/pov/parser.h"

namespace lumivec::pov {

using TexturePtr = std::shared_ptr<const Texture>;

// After the word "texture": { ... }.
TexturePtr parse_texture_block(Parser& parser);

// After the word "texture_map": { ... }.
std::vector<std::pair<double, TexturePtr>> parse_texture_map(Parser& parser);

// pigment, normal or finish outside of a texture, if one stands here: changes a copy of base, which
// may be null for the default.
bool parse_bare_part(Parser& parser, const TexturePtr& base, TexturePtr& result);

// After the word "material": { ... } or a declared one in braces.
MaterialBlock parse_material_block(Parser& parser);

// lower with upper's layers on top; each may be null.
TexturePtr layered(Parser& parser, const TexturePtr& lower, const TexturePtr& upper);

// #default.
void set_default(Parser& parser);

}  // namespace lumivec::pov
