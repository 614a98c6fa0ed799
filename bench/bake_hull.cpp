// bake_hull: would a box be a better last level of a loose part than what the collapse leaves of it?
//
//   bake_hull FILE...      prints one JSON object per FILE
//
// Takes every closed loose part of more than 12 triangles, collapses it by itself to at most 12 triangles with the
// preset best, and compares the result with the two boxes of 12 triangles around the part: along the axes of the file
// and along the principal axes of the part's vertices. `stuck` parts keep more than 12 triangles. `better` parts have a
// box whose measured maximum (DeviationMeter) is smaller than that of the collapsed part; `better_mean` compares the
// mean distances. `typical` is the median, over all parts, of the better box's maximum over that of the collapsed part.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "bake/io/gltf_mesh.h"
#include "bake/io/import.h"
#include "bake/mesh/clean.h"
#include "bake/mesh/loose_parts.h"
#include "bake/mesh/mesh_edges.h"
#include "bake/mesh/normals.h"
#include "bake/mesh/wedges.h"
#include "bake/simplify/level_maker.h"
#include "bake/simplify/measure.h"
#include "cli/program.h"

namespace {

using namespace jalousie;
using bake::WedgeMesh;

constexpr std::uint32_t kBoxTriangles = 12;

/// Triangles with smooth normals.
WedgeMesh smoothMesh(std::vector<glm::vec3> positions, std::vector<std::uint32_t> indices) {
  WedgeMesh mesh;
  mesh.slots = {{"NORMAL", 3, 0, bake::AttributeKind::kNormal}};
  mesh.stride = 3;
  for (const glm::vec3& n : bake::smoothNormals(positions, indices))
    mesh.attributes.insert(mesh.attributes.end(), {n.x, n.y, n.z});
  for (std::uint32_t v = 0; v < positions.size(); ++v) {
    mesh.vertexOf.push_back(v);
    mesh.sourceWedge.push_back(v);
  }
  mesh.primitiveOf.assign(positions.size(), 0);
  mesh.positions = std::move(positions);
  mesh.corners = std::move(indices);
  return mesh;
}

WedgeMesh partOf(const WedgeMesh& mesh, const bake::LooseParts& parts, const bake::LoosePart& part) {
  std::vector<std::uint32_t> numberOf(mesh.positions.size(), ~0U);
  std::vector<glm::vec3> positions;
  std::vector<std::uint32_t> indices;
  for (std::uint32_t f = 0; f < part.faceCount; ++f) {
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t v = mesh.vertexAt(3 * std::size_t{parts.faces[part.firstFace + f]} + k);
      if (numberOf[v] == ~0U) {
        numberOf[v] = static_cast<std::uint32_t>(positions.size());
        positions.push_back(mesh.positions[v]);
      }
      indices.push_back(numberOf[v]);
    }
  }
  return smoothMesh(std::move(positions), std::move(indices));
}

/// The eigenvectors of the covariance, by Jacobi rotations.
glm::dmat3 principalAxes(const std::vector<glm::vec3>& positions) {
  glm::dvec3 mean(0.0);
  for (const glm::vec3& p : positions)
    mean += glm::dvec3(p) / static_cast<double>(positions.size());
  glm::dmat3 a(0.0);
  for (const glm::vec3& p : positions)
    a += glm::outerProduct(glm::dvec3(p) - mean, glm::dvec3(p) - mean);
  glm::dmat3 axes(1.0);
  for (int sweep = 0; sweep < 32; ++sweep) {
    for (const auto& [i, j] : {std::pair(0, 1), std::pair(0, 2), std::pair(1, 2)}) {
      if (a[i][j] == 0.0) continue;
      const double angle = 0.5 * std::atan2(2.0 * a[i][j], a[j][j] - a[i][i]);
      glm::dmat3 turn(1.0);
      turn[i][i] = turn[j][j] = std::cos(angle);
      turn[i][j] = -std::sin(angle);
      turn[j][i] = std::sin(angle);
      a = glm::transpose(turn) * a * turn;
      axes = axes * turn;
    }
  }
  return axes;
}

/// The box around the points along the columns of `axes`.
WedgeMesh boxAround(const std::vector<glm::vec3>& points, const glm::dmat3& axes) {
  glm::dvec3 low(std::numeric_limits<double>::infinity());
  glm::dvec3 high = -low;
  for (const glm::vec3& p : points) {
    const glm::dvec3 q = glm::dvec3(p) * axes;
    low = glm::min(low, q);
    high = glm::max(high, q);
  }
  std::vector<glm::vec3> corners;
  corners.reserve(8);
  for (int c = 0; c < 8; ++c)
    corners.emplace_back(axes * glm::dvec3(c & 1 ? high.x : low.x, c & 2 ? high.y : low.y, c & 4 ? high.z : low.z));
  return smoothMesh(std::move(corners), {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                                         2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5});
}

struct Counts {
  std::uint32_t parts = 0, stuck = 0, better = 0, betterMean = 0;
  std::vector<double> ratios;
};

void comparePart(const WedgeMesh& part, Counts& counts) {
  for (const bake::MeshEdge& edge : bake::findEdges(part).edges)
    if (edge.kind == bake::EdgeKind::kBorder || edge.kind == bake::EdgeKind::kNonManifold) return;
  const bake::ChainOptions options;
  const bake::DeviationMeter meter(part, {2000, 5000});
  bake::LevelMaker maker(part, options);
  bake::LevelMaker::Level level = maker.make(kBoxTriangles, false);
  maker.refit(level);
  const bake::Distances collapsed = meter.measure(level.mesh, level.vertexMap).twoSided;
  const bake::Distances aligned = meter.measure(boxAround(part.positions, glm::dmat3(1.0))).twoSided;
  const bake::Distances turned = meter.measure(boxAround(part.positions, principalAxes(part.positions))).twoSided;
  const double box = std::min(aligned.max, turned.max);
  ++counts.parts;
  counts.stuck += level.mesh.triangles() > kBoxTriangles ? 1U : 0U;
  counts.better += box < collapsed.max ? 1U : 0U;
  counts.betterMean += std::min(aligned.mean, turned.mean) < collapsed.mean ? 1U : 0U;
  if (collapsed.max > 0.0) counts.ratios.push_back(box / collapsed.max);
}

void run(const std::string& file) {
  bake::Notes notes;
  const tinygltf::Model model = bake::importFiles({file}, {}, notes);
  Counts counts;
  for (const tinygltf::Mesh& source : model.meshes) {
    bake::CombinedMesh combined = bake::readCombinedMesh(model, source, {});
    bake::cleanMesh(combined);
    if (combined.indices.empty()) continue;
    const WedgeMesh mesh = bake::makeWedges(combined);
    const bake::LooseParts parts = bake::findLooseParts(mesh);
    for (const bake::LoosePart& part : parts.parts)
      if (part.faceCount > kBoxTriangles) comparePart(partOf(mesh, parts, part), counts);
  }
  std::sort(counts.ratios.begin(), counts.ratios.end());
  const double typical = counts.ratios.empty() ? 0.0 : counts.ratios[counts.ratios.size() / 2];
  const nlohmann::ordered_json json = {{"file", file},
                                       {"parts", counts.parts},
                                       {"stuck", counts.stuck},
                                       {"better", counts.better},
                                       {"better_mean", counts.betterMean},
                                       {"typical", typical}};
  fmt::print("{}\n", json.dump());
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 2) {
    fmt::print(stderr, "usage: bake_hull FILE...\nexample: bake_hull assets/fetched/furniture/*/*.obj\n");
    return 2;
  }
  return cli::runProgram("bake_hull", [&] {
    for (int i = 1; i < argc; ++i)
      run(argv[i]);
    return 0;
  });
}
