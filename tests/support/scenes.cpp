// Procedural meshes with known shapes and counts.
#include "support/scenes.h"

#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <numbers>

#include "support/scene_writer.h"

namespace jalousie::test {
namespace {

asset::Primitive finish(std::vector<glm::vec3> positions, std::vector<glm::vec3> normals,
                        std::vector<std::uint32_t> indices, std::uint32_t material) {
  asset::Primitive primitive;
  primitive.uvs.resize(positions.size());
  for (std::size_t v = 0; v < positions.size(); ++v)
    primitive.uvs[v] = 0.5F * glm::vec2(positions[v]) + 0.5F;
  primitive.colors.assign(positions.size(), glm::vec4(1.0F));
  primitive.positions = std::move(positions);
  primitive.normals = std::move(normals);
  primitive.indices = std::move(indices);
  primitive.material = material;
  return primitive;
}

}  // namespace

asset::Primitive sphere(std::uint32_t segments, std::uint32_t rings, std::uint32_t material) {
  std::vector<glm::vec3> positions = {{0.0F, 1.0F, 0.0F}};
  for (std::uint32_t r = 1; r < rings; ++r) {
    const float polar = std::numbers::pi_v<float> * static_cast<float>(r) / static_cast<float>(rings);
    for (std::uint32_t s = 0; s < segments; ++s) {
      const float azimuth = 2.0F * std::numbers::pi_v<float> * static_cast<float>(s) / static_cast<float>(segments);
      positions.emplace_back(std::sin(polar) * std::sin(azimuth), std::cos(polar), std::sin(polar) * std::cos(azimuth));
    }
  }
  positions.emplace_back(0.0F, -1.0F, 0.0F);
  const auto at = [&](std::uint32_t ring, std::uint32_t segment) {
    return 1 + (ring - 1) * segments + segment % segments;
  };
  const auto bottom = static_cast<std::uint32_t>(positions.size()) - 1;
  std::vector<std::uint32_t> indices;
  for (std::uint32_t s = 0; s < segments; ++s) {
    indices.insert(indices.end(), {0, at(1, s), at(1, s + 1)});
    for (std::uint32_t r = 1; r + 1 < rings; ++r)
      indices.insert(indices.end(),
                     {at(r, s), at(r + 1, s), at(r + 1, s + 1), at(r, s), at(r + 1, s + 1), at(r, s + 1)});
    indices.insert(indices.end(), {bottom, at(rings - 1, s + 1), at(rings - 1, s)});
  }
  std::vector<glm::vec3> normals = positions;
  return finish(std::move(positions), std::move(normals), std::move(indices), material);
}

asset::Primitive box(const glm::vec3& halfExtent, std::uint32_t material) {
  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;
  std::vector<std::uint32_t> indices;
  for (int axis = 0; axis < 3; ++axis) {
    for (const float sign : {-1.0F, 1.0F}) {
      glm::vec3 normal(0.0F);
      normal[axis] = sign;
      glm::vec3 u(0.0F);
      u[(axis + 1) % 3] = 1.0F;
      const glm::vec3 v = glm::cross(normal, u);
      const auto first = static_cast<std::uint32_t>(positions.size());
      for (const auto& [a, b] : {std::array{-1.0F, -1.0F}, {1.0F, -1.0F}, {1.0F, 1.0F}, {-1.0F, 1.0F}}) {
        positions.push_back((normal + a * u + b * v) * halfExtent);
        normals.push_back(normal);
      }
      indices.insert(indices.end(), {first, first + 1, first + 2, first, first + 2, first + 3});
    }
  }
  return finish(std::move(positions), std::move(normals), std::move(indices), material);
}

asset::Primitive perforatedWall(std::uint32_t cells, float openShare, Random& random, std::uint32_t material) {
  std::vector<glm::vec3> positions;
  std::vector<std::uint32_t> indices;
  const float size = 2.0F / static_cast<float>(cells);
  for (std::uint32_t y = 0; y < cells; ++y) {
    for (std::uint32_t x = 0; x < cells; ++x) {
      if (random.uniform() < openShare) continue;
      const glm::vec3 low(-1.0F + size * static_cast<float>(x), -1.0F + size * static_cast<float>(y), 0.0F);
      const auto first = static_cast<std::uint32_t>(positions.size());
      positions.insert(positions.end(),
                       {low, low + glm::vec3(size, 0, 0), low + glm::vec3(size, size, 0), low + glm::vec3(0, size, 0)});
      indices.insert(indices.end(), {first, first + 1, first + 2, first, first + 2, first + 3});
    }
  }
  std::vector<glm::vec3> normals(positions.size(), glm::vec3(0.0F, 0.0F, 1.0F));
  return finish(std::move(positions), std::move(normals), std::move(indices), material);
}

void groupFaces(asset::Primitive& primitive, asset::FaceGrouping grouping) {
  std::vector<asset::Triangle> triangles;
  Aabb bounds;
  for (std::size_t i = 0; i < primitive.indices.size(); i += 3) {
    const auto corner = [&](std::size_t k) { return primitive.positions[primitive.indices[i + k]]; };
    triangles.push_back({corner(0), corner(1), corner(2)});
    for (const glm::vec3& point : triangles.back())
      bounds.add(point);
  }
  const asset::FaceOrder order = asset::groupFaces(triangles, bounds, grouping);
  std::vector<std::uint32_t> indices;
  for (const std::uint32_t t : order.triangles)
    for (std::size_t k = 0; k < 3; ++k)
      indices.push_back(primitive.indices[3 * std::size_t{t} + k]);
  primitive.indices = std::move(indices);
  primitive.faceTree = order.tree;
  primitive.cellEnds.clear();
}

void groupFaces(asset::SceneFile& file, asset::FaceGrouping grouping) {
  for (asset::Mesh& mesh : file.meshes)
    for (asset::Primitive& primitive : mesh.primitives)
      groupFaces(primitive, grouping);
}

asset::SceneFile sphereChain(std::uint32_t levels) {
  asset::SceneFile file;
  file.materials.emplace_back();
  file.materials.back().baseColor = glm::vec4(0.7F, 0.65F, 0.6F, 1.0F);
  asset::Chain chain{"sphere", {}};
  for (std::uint32_t k = 0; k < levels; ++k) {
    const std::uint32_t segments = std::max(4U, 64U >> k);
    file.meshes.push_back({"sphere", {sphere(segments, std::max(3U, segments / 2))}});
    const float error = k == 0 ? 0.0F : 1.0F - std::cos(std::numbers::pi_v<float> / static_cast<float>(segments));
    chain.levels.push_back({k, error});
    chain.coverage.push_back(k + 1 < levels ? 0.02F / static_cast<float>(1U << 2 * k) : 0.0F);
  }
  file.chains.push_back(std::move(chain));
  return file;
}

void addInstance(asset::SceneFile& file, std::uint32_t chain, const glm::vec3& translation, const glm::vec3& scale,
                 float angle, const glm::vec3& axis) {
  glm::mat4 matrix = glm::translate(glm::mat4(1.0F), translation);
  matrix = glm::rotate(matrix, angle, glm::normalize(axis));
  file.instances.push_back({chain, glm::scale(matrix, scale)});
}

asset::SceneFile randomSpheres(std::uint32_t count, float halfSide, std::uint64_t seed) {
  asset::SceneFile file = sphereChain(4);
  Random random(seed);
  for (std::uint32_t i = 0; i < count; ++i) {
    const glm::vec3 place(random.uniform(-halfSide, halfSide), random.uniform(-halfSide, halfSide),
                          random.uniform(-halfSide, halfSide));
    glm::vec3 scale(random.uniform(0.02F, 0.2F) * halfSide);
    if (random.below(4) == 0) scale.y *= 0.1F;
    if (random.below(4) == 0) scale.x = -scale.x;
    addInstance(file, 0, place, scale, random.uniform(0.0F, 6.0F), {random.uniform(), 1.0F, random.uniform()});
  }
  return file;
}

std::string spherePly(std::uint32_t segments, std::uint32_t rings) {
  return plyText(sphere(segments, rings));
}

}  // namespace jalousie::test
