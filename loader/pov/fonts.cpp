#include "loader/pov/fonts.h"

#include <ft2build.h>
#include FT_FREETYPE_H
#include FT_OUTLINE_H

#include <algorithm>
#include <array>
#include <memory>

#include "loader/pov/curves.h"

namespace lumivec::pov {
namespace {

struct CloseLibrary {
  void operator()(FT_Library library) const { FT_Done_FreeType(library); }
};
struct CloseFace {
  void operator()(FT_Face face) const { FT_Done_Face(face); }
};

// A font in memory, and what reads it.
struct Font {
  std::vector<std::uint8_t> bytes;
  std::unique_ptr<FT_LibraryRec_, CloseLibrary> library;
  std::unique_ptr<FT_FaceRec_, CloseFace> face;
};

// POV-Ray comes with these; where it is not installed they are not to be had, and scenes that name
// them are shown without.
bool is_standard(const std::string& file) {
  constexpr std::array<std::string_view, 4> names = {"timrom.ttf", "cyrvetic.ttf", "crystal.ttf",
                                                     "povlogo.ttf"};
  return std::find(names.begin(), names.end(), file) != names.end();
}

// As the language has it, the extension may be left out. Without a face: a standard font that is
// not there, which is mentioned.
Font open_font(Parser& parser, const FontName& name) {
  Font font;
  std::string file = name.file;
  if (!parser.sources.exists(file, name.named_in)) {
    const std::string extended = file + ".ttf";
    if (is_standard(extended) || parser.sources.exists(extended, name.named_in)) file = extended;
  }
  try {
    font.bytes = parser.sources.read(file, name.named_in);
  } catch (const FileProblem& problem) {
    if (is_standard(file)) {
      parser.mention(name.place, "a text is left out: " + problem.problem + "; " + problem.remedy);
      return font;
    }
    parser.fail_at(name.place, "the font of a text cannot be had: " + problem.problem,
                   problem.remedy);
  }
  FT_Library library = nullptr;
  FT_Face face = nullptr;
  if (FT_Init_FreeType(&library) == 0) font.library.reset(library);
  const bool opened =
      library && FT_New_Memory_Face(library, font.bytes.data(),
                                    static_cast<FT_Long>(font.bytes.size()), 0, &face) == 0;
  if (opened) font.face.reset(face);
  if (!opened || !FT_IS_SCALABLE(face) || face->units_per_EM == 0) {
    parser.fail_at(name.place, "\"" + name.file + "\" is no font with outlines",
                   "name a TrueType font");
  }
  if (!face->charmap && face->num_charmaps > 0) FT_Set_Charmap(face, face->charmaps[0]);
  return font;
}

// Outlines as FreeType tells them: each ends where it began.
struct Pen {
  double unit;
  std::vector<CurvePiece> pieces;
  Point2 first{};
  Point2 at{};

  Point2 point(const FT_Vector* v) const {
    return {static_cast<double>(v->x) * unit, static_cast<double>(v->y) * unit};
  }
  void add(const std::array<Point2, 4>& p) {
    CurvePiece piece;
    piece.u = cubic_of(CurveKind::bezier, {p[0][0], p[1][0], p[2][0], p[3][0]});
    piece.v = cubic_of(CurveKind::bezier, {p[0][1], p[1][1], p[2][1], p[3][1]});
    piece.end = at = p[3];
    pieces.push_back(piece);
  }
  void line(const Point2& to) {
    if (to == at) return;
    CurvePiece piece;
    piece.u = {at[0], to[0] - at[0], 0.0, 0.0};
    piece.v = {at[1], to[1] - at[1], 0.0, 0.0};
    piece.end = at = to;
    pieces.push_back(piece);
  }
  // A parabola has two thirds of the way to its control point in each of a cubic's.
  void parabola(const Point2& control, const Point2& to) {
    const auto between = [&](const Point2& a) -> Point2 {
      return {a[0] + 2.0 / 3.0 * (control[0] - a[0]), a[1] + 2.0 / 3.0 * (control[1] - a[1])};
    };
    add({at, between(at), between(to), to});
  }
};

Pen& pen_of(void* user) {
  return *static_cast<Pen*>(user);
}

std::vector<CurvePiece> pieces_of(FT_Outline& outline, double unit) {
  Pen pen{unit, {}, {}, {}};
  FT_Outline_Funcs tell{};
  tell.move_to = [](const FT_Vector* to, void* user) {
    Pen& p = pen_of(user);
    p.line(p.first);
    p.first = p.at = p.point(to);
    return 0;
  };
  tell.line_to = [](const FT_Vector* to, void* user) {
    pen_of(user).line(pen_of(user).point(to));
    return 0;
  };
  tell.conic_to = [](const FT_Vector* control, const FT_Vector* to, void* user) {
    Pen& p = pen_of(user);
    p.parabola(p.point(control), p.point(to));
    return 0;
  };
  tell.cubic_to = [](const FT_Vector* a, const FT_Vector* b, const FT_Vector* to, void* user) {
    Pen& p = pen_of(user);
    p.add({p.at, p.point(a), p.point(b), p.point(to)});
    return 0;
  };
  if (FT_Outline_Decompose(&outline, &tell, &pen) != 0) return {};
  pen.line(pen.first);
  return std::move(pen.pieces);
}

// Characters of UTF-8; of Latin-1 where it is none.
std::vector<FT_ULong> characters(std::string_view text) {
  std::vector<FT_ULong> result;
  for (std::size_t i = 0; i < text.size();) {
    const auto byte = [&](std::size_t at) { return static_cast<unsigned char>(text[at]); };
    const unsigned char lead = byte(i);
    const std::size_t more = lead >= 0xf0 && lead < 0xf8 ? 3 : lead >= 0xe0 ? 2 : 1;
    bool multiple = lead >= 0xc2 && lead < 0xf8 && i + more < text.size();
    for (std::size_t k = 1; multiple && k <= more; ++k) multiple = (byte(i + k) & 0xc0) == 0x80;
    FT_ULong character = multiple ? lead & (0x3fu >> more) : lead;
    for (std::size_t k = 1; multiple && k <= more; ++k)
      character = character << 6 | (byte(i + k) & 0x3fu);
    result.push_back(character);
    i += multiple ? more + 1 : 1;
  }
  return result;
}

FT_UInt glyph_of(FT_Face face, FT_ULong character) {
  constexpr FT_ULong symbols = 0xf000;  // where fonts of symbols have theirs
  const FT_UInt glyph = FT_Get_Char_Index(face, character);
  return glyph == 0 ? FT_Get_Char_Index(face, symbols + character) : glyph;
}

}  // namespace

TextShape text_of(Parser& parser, const FontName& name, std::string_view text, double thickness,
                  const V3d& offset) {
  const Font font = open_font(parser, name);
  FT_Face face = font.face.get();
  if (!face) return {};
  const double unit = 1.0 / face->units_per_EM;
  TextShape shape;
  shape.thickness = thickness;
  V3d pen(0.0);
  FT_UInt before = 0;
  for (const FT_ULong character : characters(text)) {
    const FT_UInt glyph = glyph_of(face, character);
    FT_Vector kerning{};
    if (before && FT_Get_Kerning(face, before, glyph, FT_KERNING_UNSCALED, &kerning) == 0)
      pen.x += static_cast<double>(kerning.x) * unit;
    before = glyph;
    constexpr FT_Int32 flags = FT_LOAD_NO_SCALE | FT_LOAD_NO_HINTING | FT_LOAD_NO_BITMAP;
    if (FT_Load_Glyph(face, glyph, flags) != 0 || face->glyph->format != FT_GLYPH_FORMAT_OUTLINE) {
      parser.mention(name.place, "a letter that the font does not hold whole is left out");
      continue;
    }
    FT_Outline& outline = face->glyph->outline;
    parser.claim(static_cast<std::uint64_t>(std::max<int>(outline.n_points, 0) + 1) *
                 sizeof(CurvePiece) * 2);
    std::vector<CurvePiece> pieces = pieces_of(outline, unit);
    for (const CurvePiece& piece : pieces) {
      const auto u = control_values(piece.u), v = control_values(piece.v);
      for (std::size_t i = 0; i < 4; ++i) {
        shape.bounds.extendBy(pen + V3d(u[i], v[i], 0.0));
        shape.bounds.extendBy(pen + V3d(u[i], v[i], thickness));
      }
    }
    if (!pieces.empty()) shape.glyphs.push_back({pen, std::move(pieces)});
    pen.x += static_cast<double>(face->glyph->advance.x) * unit;
    pen += offset;
  }
  return shape;
}

}  // namespace lumivec::pov
