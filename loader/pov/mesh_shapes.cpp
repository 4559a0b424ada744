#include <limits>
#include <map>

#include "loader/pov/expression.h"
#include "loader/pov/shape_parsers.h"
#include "loader/pov/textures.h"

namespace lumivec::pov {
namespace {

constexpr std::size_t most_vertices = std::numeric_limits<std::uint32_t>::max() / 4;

std::size_t parse_count(Parser& parser, std::string_view construct) {
  const int count = parse_int(parser, construct);
  if (count < 0) parser.fail("the number for " + std::string(construct) + " is below 0");
  skip_comma(parser);
  return static_cast<std::size_t>(count);
}

template <class T, class Read>
void parse_list(Parser& parser, std::string_view construct, std::vector<T>& list, Read read) {
  parser.expect('{', construct);
  const std::size_t count = parse_count(parser, construct);
  parser.claim(count * sizeof(T));
  list.reserve(count);
  for (std::size_t i = 0; i < count; ++i) {
    list.push_back(read());
    skip_comma(parser);
  }
  parser.expect('}', construct);
}

std::array<std::uint32_t, 3> parse_indices(Parser& parser, std::size_t limit,
                                           std::string_view construct) {
  const V3d given = parse_vector(parser);
  std::array<std::uint32_t, 3> indices{};
  for (int i = 0; i < 3; ++i) {
    if (!(given[i] >= 0.0 && given[i] < static_cast<double>(limit))) {
      parser.fail("an index of " + std::string(construct) + " is outside the " +
                  std::to_string(limit) + " that there are");
    }
    indices[static_cast<std::size_t>(i)] = static_cast<std::uint32_t>(given[i]);
  }
  return indices;
}

void parse_face_indices(Parser& parser, MeshShape& mesh) {
  parser.expect('{', "face_indices");
  const std::size_t count = parse_count(parser, "face_indices");
  parser.claim(count * sizeof(mesh.faces[0]));
  mesh.faces.reserve(count);
  const auto texture_index = [&] {
    const int index = parse_int(parser, "a texture's index");
    if (index < 0 || static_cast<std::size_t>(index) >= mesh.textures.size())
      parser.fail("the index of a texture is outside texture_list");
    return index;
  };
  for (std::size_t i = 0; i < count; ++i) {
    mesh.faces.push_back(parse_indices(parser, mesh.points.size(), "face_indices"));
    skip_comma(parser);
    // Textures of the corners, or of the whole, follow as plain numbers.
    if (mesh.textures.empty() || parser.at('<') || !begins_number(parser)) {
      if (!mesh.face_textures.empty()) mesh.face_textures.push_back({-1, -1, -1});
      continue;
    }
    if (mesh.face_textures.empty()) mesh.face_textures.assign(i, {-1, -1, -1});
    const int first = texture_index();
    std::array<int, 3> corners = {first, first, first};
    skip_comma(parser);
    for (std::size_t c = 1; c < 3 && begins_number(parser) && !parser.at('<'); ++c) {
      corners[c] = texture_index();
      skip_comma(parser);
    }
    mesh.face_textures.push_back(corners);
  }
  parser.expect('}', "face_indices");
}

bool parse_mesh2_list(Parser& parser, MeshShape& mesh) {
  if (parser.accept(K::vertex_vectors_)) {
    parse_list(parser, "vertex_vectors", mesh.points, [&] { return parse_vector(parser); });
  } else if (parser.accept(K::normal_vectors_)) {
    parse_list(parser, "normal_vectors", mesh.normals, [&] { return parse_vector(parser); });
  } else if (parser.accept(K::uv_vectors_)) {
    parse_list(parser, "uv_vectors", mesh.uvs, [&] { return parse_pair(parser); });
  } else if (parser.accept(K::texture_list_)) {
    parse_list(parser, "texture_list", mesh.textures, [&] {
      if (!parser.accept(K::texture_)) parser.fail_expected("a texture");
      return parse_texture_block(parser);
    });
  } else if (parser.accept(K::face_indices_)) {
    parse_face_indices(parser, mesh);
  } else if (parser.accept(K::normal_indices_)) {
    parse_list(parser, "normal_indices", mesh.face_normals,
               [&] { return parse_indices(parser, mesh.normals.size(), "normal_indices"); });
  } else if (parser.accept(K::uv_indices_)) {
    parse_list(parser, "uv_indices", mesh.face_uvs,
               [&] { return parse_indices(parser, mesh.uvs.size(), "uv_indices"); });
  } else if (parser.accept(K::inside_vector_)) {
    mesh.inside_vector = parse_vector(parser);
    mesh.has_inside = true;
  } else {
    return false;
  }
  return true;
}

// Lists of indices that are left out are the faces' own.
void check_mesh2(Parser& parser, const MeshShape& mesh) {
  const auto covers = [&](const auto& indices, std::size_t count, const char* name) {
    if (count == 0) return;
    if (!indices.empty() && indices.size() != mesh.faces.size()) {
      parser.fail("the mesh has " + std::to_string(mesh.faces.size()) + " faces, but " +
                  std::to_string(indices.size()) + " " + name);
    }
    if (indices.empty() && count < mesh.points.size())
      parser.fail(std::string("the mesh needs ") + name);
  };
  covers(mesh.face_normals, mesh.normals.size(), "normal_indices");
  covers(mesh.face_uvs, mesh.uvs.size(), "uv_indices");
}

// A triangle of a mesh, with its own normals and UVs.
struct FaceReader {
  Parser& parser;
  MeshShape& mesh;
  std::map<const void*, int> textures;

  void read(bool smooth) {
    parser.expect('{', "a triangle");
    if (mesh.points.size() > most_vertices) parser.fail("the mesh has too many triangles");
    parser.claim(3 * (2 * sizeof(V3d) + 3 * sizeof(std::array<std::uint32_t, 3>)));
    const auto first = static_cast<std::uint32_t>(mesh.points.size());
    const std::array<std::uint32_t, 3> face = {first, first + 1, first + 2};
    V3d normals[3] = {V3d(0.0), V3d(0.0), V3d(0.0)};
    for (V3d& normal : normals) {
      mesh.points.push_back(parse_vector(parser));
      skip_comma(parser);
      if (!smooth) continue;
      normal = parse_vector(parser);
      skip_comma(parser);
    }
    if (smooth && mesh.normals.empty()) mesh.normals.assign(first, V3d(0.0));
    if (!mesh.normals.empty()) mesh.normals.insert(mesh.normals.end(), normals, normals + 3);
    mesh.faces.push_back(face);
    int texture = -1;
    while (!parser.accept('}')) {
      if (parser.accept(K::uv_vectors_)) {
        mesh.uvs.resize(first);
        for (int i = 0; i < 3; ++i) {
          mesh.uvs.push_back(parse_pair(parser));
          skip_comma(parser);
        }
      } else if (parser.accept(K::texture_)) {
        const TexturePtr given = parse_texture_block(parser);
        const auto [known, fresh] =
            textures.try_emplace(given.get(), static_cast<int>(mesh.textures.size()));
        if (fresh) mesh.textures.push_back(given);
        texture = known->second;
      } else {
        parser.fail_expected("'}' of a triangle");
      }
    }
    if (!mesh.uvs.empty()) mesh.uvs.resize(mesh.points.size());
    if (texture >= 0 && mesh.face_textures.empty())
      mesh.face_textures.assign(mesh.faces.size() - 1, {-1, -1, -1});
    if (texture >= 0 || !mesh.face_textures.empty())
      mesh.face_textures.push_back({texture, texture, texture});
  }
};

}  // namespace

Shape parse_mesh(Parser& parser) {
  auto mesh = std::make_shared<MeshShape>();
  FaceReader reader{parser, *mesh, {}};
  for (;;) {
    if (parser.accept(K::triangle_)) {
      reader.read(false);
    } else if (parser.accept(K::smooth_triangle_)) {
      reader.read(true);
    } else if (parser.accept(K::inside_vector_)) {
      mesh->inside_vector = parse_vector(parser);
      mesh->has_inside = true;
    } else {
      break;
    }
  }
  for (const V3d& point : mesh->points) mesh->bounds.extendBy(point);
  return std::shared_ptr<const MeshShape>(std::move(mesh));
}

Shape parse_mesh2(Parser& parser) {
  auto mesh = std::make_shared<MeshShape>();
  while (parse_mesh2_list(parser, *mesh)) {
  }
  check_mesh2(parser, *mesh);
  for (const V3d& point : mesh->points) mesh->bounds.extendBy(point);
  return std::shared_ptr<const MeshShape>(std::move(mesh));
}

}  // namespace lumivec::pov
