#include "loader/pov/transforms.h"

#include "loader/pov/expression.h"
#include "loader/pov/rotations.h"

namespace lumivec::pov {
namespace {

// A zero would flatten things; the language takes it for 1.
M44d parse_scale(Parser& parser) {
  V3d scale = parse_vector(parser);
  for (int i = 0; i < 3; ++i) {
    if (scale[i] != 0.0) continue;
    parser.mention(parser.place(), "a scale of 0 is taken for 1");
    scale[i] = 1.0;
  }
  M44d m;
  m.setScale(scale);
  return m;
}

M44d parse_matrix(Parser& parser) {
  M44d m;
  parser.expect('<', "a matrix");
  for (int row = 0; row < 4; ++row) {
    for (int column = 0; column < 3; ++column) {
      m[row][column] = parse_float(parser, "a matrix");
      skip_comma(parser);
    }
  }
  parser.expect('>', "a matrix");
  return m;
}

const M44d* declared_transform(Parser& parser) {
  const Slot* slot = parser.meaning(parser.peek());
  if (!slot) return nullptr;
  return (*slot)->kind == ValueKind::transform ? &(*slot)->as<M44d>() : nullptr;
}

}  // namespace

M44d parse_transform_block(Parser& parser) {
  if (const M44d* declared = declared_transform(parser)) {
    const M44d m = *declared;
    parser.take();
    return m;
  }
  const Nesting nesting(parser);
  parser.expect('{', "a transform");
  M44d m;
  bool inverse = false;
  while (!parser.accept('}')) {
    if (const M44d* declared = declared_transform(parser)) {
      m = m * *declared;
      parser.take();
    } else if (parser.accept(K::inverse_)) {
      inverse = true;
    } else if (const auto part = parse_transform(parser)) {
      m = m * *part;
    } else {
      parser.fail_expected("a transform");
    }
  }
  return inverse ? m.inverse() : m;
}

std::optional<M44d> parse_transform(Parser& parser) {
  if (parser.accept(K::translate_)) return M44d().setTranslation(parse_vector(parser));
  if (parser.accept(K::rotate_)) return rotation_matrix(parse_vector(parser));
  if (parser.accept(K::scale_)) return parse_scale(parser);
  if (parser.accept(K::matrix_)) return parse_matrix(parser);
  if (parser.accept(K::transform_)) return parse_transform_block(parser);
  return std::nullopt;
}

}  // namespace lumivec::pov
