// bake_judge: measures how far meshes of any tool lie from a reference mesh, with the same measure for all of them.
//
//   bake_judge REFERENCE FILE[@LOD]...      prints one JSON object per FILE
//
// `mean`, `max` and `normal` come from 200,000 random points each way (fixed seed), which are not the points that the
// baker measures with: mean of the two one-sided mean distances, larger one of the two sampled maxima, and mean angle
// between interpolated shading normals in degrees. `stored` is the error that jalousie-bake would store for the mesh
// (DeviationMeter): a conservative two-sided maximum, never below a sampled distance. Distances are in % of the
// reference's diagonal. All meshes of a scene are taken together, at the places of their nodes. LOD chooses a level of
// a file with MSFT_lod; default 0. A mesh with fewer levels has its coarsest one, which may show nothing.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>

#include "asset/lod_chain.h"
#include "bake/io/gltf_mesh.h"
#include "bake/io/import.h"
#include "bake/io/node_scales.h"
#include "bake/mesh/surface_samples.h"
#include "bake/mesh/triangle_bvh.h"
#include "bake/mesh/wedges.h"
#include "bake/pipeline/threads.h"
#include "bake/simplify/measure.h"
#include "cli/program.h"
#include "core/aabb.h"
#include "core/error.h"
#include "core/random.h"

namespace {

using namespace jalousie;
using bake::WedgeMesh;

constexpr std::size_t kSamples = 200'000;

/// Appends one mesh to another; only positions and normals matter here. @param transform  into the scene
void append(WedgeMesh& whole, const WedgeMesh& part, const glm::dmat4& transform) {
  const glm::dmat3 turned = glm::transpose(glm::inverse(glm::dmat3(transform)));
  const auto vertices = static_cast<std::uint32_t>(whole.positions.size());
  const auto wedges = static_cast<std::uint32_t>(whole.vertexOf.size());
  for (const glm::vec3& p : part.positions)
    whole.positions.emplace_back(transform * glm::dvec4(p, 1.0));
  const bake::AttributeSlot* normals = part.slot("NORMAL");
  for (std::uint32_t w = 0; w < part.vertexOf.size(); ++w) {
    whole.vertexOf.push_back(vertices + part.vertexOf[w]);
    whole.sourceWedge.push_back(~0U);  // no wedge of the reference: texture charts are not compared
    glm::vec3 n(0.0F);
    if (normals != nullptr) n = glm::normalize(turned * glm::dvec3(part.vec3At(w, *normals)));
    whole.attributes.insert(whole.attributes.end(), {n.x, n.y, n.z});
  }
  for (const std::uint32_t c : part.corners)
    whole.corners.push_back(wedges + c);
}

WedgeMesh load(const std::string& name) {
  const std::size_t at = name.rfind('@');
  const std::string file = name.substr(0, at);
  const std::size_t lod = at == std::string::npos ? 0 : std::stoul(name.substr(at + 1));
  bake::Notes notes;
  const tinygltf::Model model = bake::importFiles({file}, {}, notes);
  const std::vector<glm::dmat4> transforms = bake::worldTransforms(model);
  std::vector<bool> isLower(model.nodes.size(), false);
  for (std::size_t n = 0; n < model.nodes.size(); ++n)
    for (const int lower : asset::lodNodes(model, static_cast<int>(n)))
      isLower[static_cast<std::size_t>(lower)] = true;
  WedgeMesh whole;
  whole.slots = {{"NORMAL", 3, 0, bake::AttributeKind::kNormal}};
  whole.stride = 3;
  for (std::size_t n = 0; n < model.nodes.size(); ++n) {
    if (isLower[n] || model.nodes[n].mesh < 0) continue;
    int node = static_cast<int>(n);
    if (lod > 0) {
      const std::vector<int> lower = asset::lodNodes(model, node);
      if (lod > lower.size() && asset::emptyLevel(model, node) >= 0) continue;
      if (!lower.empty()) node = lower[std::min(lod, lower.size()) - 1];
    }
    const auto mesh = static_cast<std::size_t>(model.nodes[static_cast<std::size_t>(node)].mesh);
    append(whole, bake::makeWedges(bake::readCombinedMesh(model, model.meshes[mesh], {})), transforms[n]);
  }
  if (whole.corners.empty()) throw Error(ErrorCode::kMalformed, "has no triangles", file);
  return whole;
}

/// kSamples random points, uniformly distributed over the area.
std::vector<bake::SurfaceSample> randomSamples(const WedgeMesh& mesh, std::uint64_t seed) {
  std::vector<double> cumulative(mesh.triangles());
  double area = 0.0;
  for (std::uint32_t t = 0; t < cumulative.size(); ++t) {
    const glm::dvec3 a(mesh.positions[mesh.vertexAt(3 * std::size_t{t})]);
    const glm::dvec3 b(mesh.positions[mesh.vertexAt(3 * std::size_t{t} + 1)]);
    const glm::dvec3 c(mesh.positions[mesh.vertexAt(3 * std::size_t{t} + 2)]);
    cumulative[t] = area += 0.5 * glm::length(glm::cross(b - a, c - a));
  }
  Random random(seed);
  std::vector<bake::SurfaceSample> samples;
  for (std::size_t i = 0; i < kSamples; ++i) {
    const double place = area * random.uniform();
    const auto found = std::upper_bound(cumulative.begin(), cumulative.end(), place);
    const auto t = static_cast<std::uint32_t>(
        std::min<std::ptrdiff_t>(found - cumulative.begin(), static_cast<std::ptrdiff_t>(cumulative.size()) - 1));
    const float root = std::sqrt(random.uniform());
    const float r = random.uniform();
    samples.push_back({t, {1.0F - root, root * (1.0F - r), root * r}});
  }
  return samples;
}

/// One-sided distances from one mesh to another, in object-space length, and the mean angle between normals.
struct Side {
  double max = 0.0;
  double mean = 0.0;
  double degrees = 0.0;
};

Side judge(const WedgeMesh& from, const WedgeMesh& to, const bake::TriangleBvh& bvh, std::uint64_t seed) {
  const std::vector<bake::SurfaceSample> samples = randomSamples(from, seed);
  std::vector<double> distances(samples.size());
  std::vector<double> degrees(samples.size());
  bake::threadedSlices(0)(samples.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const glm::dvec3 b(samples[i].barycentric);
      const bake::NearestPoint nearest = bvh.nearest(bake::positionAt(from, samples[i].triangle, b));
      const glm::dvec3 n = bake::shadingNormalAt(from, from.slots.data(), samples[i].triangle, b);
      const glm::dvec3 m = bake::shadingNormalAt(to, to.slots.data(), nearest.triangle, nearest.barycentric);
      distances[i] = std::sqrt(nearest.distance2);
      degrees[i] = std::acos(std::clamp(glm::dot(n, m), -1.0, 1.0)) * 180.0 / std::numbers::pi;
    }
  });
  Side side;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    side.max = std::max(side.max, distances[i]);
    side.mean += distances[i] / static_cast<double>(samples.size());
    side.degrees += degrees[i] / static_cast<double>(samples.size());
  }
  return side;
}

void run(int argc, char** argv) {
  const WedgeMesh reference = load(argv[1]);
  const bake::TriangleBvh referenceBvh(reference.positions, bake::vertexIndices(reference));
  Aabb box;
  for (const glm::vec3& p : reference.positions)
    box.add(p);
  const double percent = 100.0 / box.diagonal();
  const bake::DeviationMeter meter(reference);
  for (int i = 2; i < argc; ++i) {
    const WedgeMesh mesh = load(argv[i]);
    const Side to = judge(mesh, reference, referenceBvh, 1);
    const Side from = judge(reference, mesh, bake::TriangleBvh(mesh.positions, bake::vertexIndices(mesh)), 2);
    const nlohmann::ordered_json json = {{"file", argv[i]},
                                         {"triangles", mesh.triangles()},
                                         {"mean", 0.5 * (to.mean + from.mean) * percent},
                                         {"max", std::max(to.max, from.max) * percent},
                                         {"stored", meter.measure(mesh).twoSided.max * percent},
                                         {"normal", 0.5 * (to.degrees + from.degrees)},
                                         {"to_max", to.max * percent},
                                         {"from_max", from.max * percent}};
    fmt::print("{}\n", json.dump());
    std::fflush(stdout);
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    fmt::print(stderr,
               "usage: bake_judge REFERENCE FILE[@LOD]...\n"
               "example: bake_judge dragon.ply dragon.glb@1 dragon.glb@2\n");
    return 2;
  }
  return cli::runProgram("bake_judge", [&] {
    run(argc, argv);
    return 0;
  });
}
