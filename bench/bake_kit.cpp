// bake_kit: writes a kit of many small hard-surface meshes, one node each, for the times of bench/bake_bench.
//
//   bake_kit OUT.glb [MESHES]        4000 meshes unless told: boxes, plates with subdivided faces, prisms
#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <numbers>
#include <string_view>

#include "asset/accessor.h"
#include "asset/gltf_file.h"
#include "cli/program.h"
#include "core/error.h"

namespace {

using namespace jalousie;

/// Flat-shaded triangles: every face has vertices of its own.
struct Part {
  std::vector<glm::vec3> positions, normals;
  std::vector<std::uint32_t> indices;

  void addQuad(const glm::vec3& corner, const glm::vec3& u, const glm::vec3& v, std::uint32_t cells) {
    const auto first = static_cast<std::uint32_t>(positions.size());
    for (std::uint32_t y = 0; y <= cells; ++y) {
      for (std::uint32_t x = 0; x <= cells; ++x) {
        const auto n = static_cast<float>(cells);
        positions.push_back(corner + u * (static_cast<float>(x) / n) + v * (static_cast<float>(y) / n));
        normals.push_back(glm::normalize(glm::cross(u, v)));
        if (x == cells || y == cells) continue;
        const std::uint32_t i = first + y * (cells + 1) + x;
        indices.insert(indices.end(), {i, i + 1, i + cells + 2, i, i + cells + 2, i + cells + 1});
      }
    }
  }
};

Part box(const glm::vec3& size, std::uint32_t cells) {
  Part part;
  const glm::vec3 x(size.x, 0, 0);
  const glm::vec3 y(0, size.y, 0);
  const glm::vec3 z(0, 0, size.z);
  const glm::vec3 o(0.0F);
  part.addQuad(z, x, y, cells);
  part.addQuad(o, y, x, cells);
  part.addQuad(o, z, y, cells);
  part.addQuad(x, y, z, cells);
  part.addQuad(o, x, z, cells);
  part.addQuad(y, z, x, cells);
  return part;
}

/// A prism without its ends.
Part tube(float radius, float height, std::uint32_t sides) {
  Part part;
  const auto at = [&](std::uint32_t k) {
    const double angle = 2.0 * std::numbers::pi * k / sides;
    return glm::vec3(radius * std::cos(angle), 0.0, radius * std::sin(angle));
  };
  for (std::uint32_t k = 0; k < sides; ++k)
    part.addQuad(at(k + 1), at(k) - at(k + 1), glm::vec3(0, height, 0), 1);
  return part;
}

Part partOf(std::uint32_t k) {
  const float size = 0.5F + 0.01F * static_cast<float>(k % 37);
  if (k % 8 == 0) return box({size, 0.1F, 2.0F * size}, 2);
  if (k % 8 == 1) return tube(size, 3.0F, 10 + k % 7);
  return box({size, 2.0F * size, 0.3F}, 1);
}

void write(const char* file, std::uint32_t meshes) {
  tinygltf::Model model;
  model.asset.version = "2.0";
  model.scenes.emplace_back();
  model.defaultScene = 0;
  for (std::uint32_t k = 0; k < meshes; ++k) {
    const Part part = partOf(k);
    tinygltf::Primitive primitive;
    primitive.mode = TINYGLTF_MODE_TRIANGLES;
    primitive.attributes["POSITION"] = asset::appendVec3(model, part.positions, TINYGLTF_TARGET_ARRAY_BUFFER);
    primitive.attributes["NORMAL"] = asset::appendVec3(model, part.normals, TINYGLTF_TARGET_ARRAY_BUFFER);
    primitive.indices = asset::appendIndices(model, part.indices);
    tinygltf::Mesh mesh;
    mesh.name = fmt::format("part{}", k);
    mesh.primitives.push_back(primitive);
    tinygltf::Node node;
    node.name = mesh.name;
    node.mesh = static_cast<int>(k);
    node.translation = {4.0 * (k % 64), 0.0, 4.0 * (k / 64)};
    model.meshes.push_back(mesh);
    model.nodes.push_back(node);
    model.scenes[0].nodes.push_back(static_cast<int>(k));
  }
  asset::saveGlb(model, file);
}

}  // namespace

int main(int argc, char** argv) {
  std::uint32_t meshes = 4000;
  const std::string_view count = argc > 2 ? argv[2] : "4000";
  const auto read = std::from_chars(count.data(), count.data() + count.size(), meshes);
  if (argc < 2 || argc > 3 || read.ec != std::errc() || read.ptr != count.data() + count.size() || meshes == 0 ||
      meshes > 100'000) {
    fmt::print(stderr, "usage: bake_kit OUT.glb [MESHES]\nexample: bake_kit kit.glb 4000\n");
    return 2;
  }
  return jalousie::cli::runProgram("bake_kit", [&] {
    write(argv[1], meshes);
    return 0;
  });
}
