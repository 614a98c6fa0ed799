// Projects samples, assembles normal equations triangle by triangle and solves them with conjugate gradients.
#include "bake/simplify/refit.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "bake/mesh/mesh_edges.h"
#include "bake/mesh/normals.h"
#include "bake/mesh/surface_samples.h"
#include "bake/mesh/triangle_bvh.h"

namespace jalousie::bake {
namespace {

constexpr double kDamping = 0.02;     // relative to the weight of the samples of a vertex
constexpr std::uint32_t kSteps = 24;  // of conjugate gradients
constexpr double kTolerance = 1e-3;   // of the residual
constexpr double kSameSide = 0.3;     // least cosine between the normals of a sample and of the triangle it lands on
constexpr std::size_t kLeastSamples = 20000;  // or kLeastPerTriangle, if fewer
constexpr std::size_t kLeastPerTriangle = 8;  // of the original: samples see every triangle

/// A sample of the original and where it lands on the level.
struct Landing {
  glm::vec3 point;
  glm::vec3 normal;
  glm::vec3 barycentric;
  std::uint32_t triangle;
  std::uint32_t part;
  bool counts = true;
};

/// The normal equations of sum |sum_k b_k x_k - s|^2: one symmetric 3x3 block of weights per triangle.
class Equations {
 public:
  Equations(std::size_t unknowns, std::span<const std::uint32_t> indices)
      : indices_(indices), blocks_(indices.size() / 3), diagonal_(unknowns, 0.0), rhs_(unknowns, glm::dvec3(0.0)) {}

  void add(std::uint32_t triangle, const glm::dvec3& b, const glm::dvec3& residual) {
    Block& block = blocks_[triangle];
    block.aa += b.x * b.x;
    block.ab += b.x * b.y;
    block.ac += b.x * b.z;
    block.bb += b.y * b.y;
    block.bc += b.y * b.z;
    block.cc += b.z * b.z;
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t i = indices_[3 * std::size_t{triangle} + static_cast<std::size_t>(k)];
      diagonal_[i] += b[k] * b[k];
      rhs_[i] += b[k] * residual;
    }
  }
  void fix(std::uint32_t unknown) { fixed_.push_back(unknown); }

  /// The change of every unknown, by conjugate gradients.
  std::vector<glm::dvec3> solve() {
    addDamping();
    const std::vector<double> preconditioner = diagonalOfMatrix();
    const std::size_t n = diagonal_.size();
    std::vector<glm::dvec3> x(n, glm::dvec3(0.0));
    std::vector<glm::dvec3> r = rhs_;
    std::vector<glm::dvec3> p(n);
    std::vector<glm::dvec3> q(n);
    glm::dvec3 rho(0.0);
    for (std::size_t i = 0; i < n; ++i) {
      p[i] = r[i] / preconditioner[i];
      rho += r[i] * p[i];
    }
    const glm::dvec3 enough = kTolerance * kTolerance * rho;
    for (std::uint32_t step = 0; step < kSteps; ++step) {
      if (rho.x <= enough.x && rho.y <= enough.y && rho.z <= enough.z) break;
      multiply(p, q);
      glm::dvec3 pq(0.0);
      for (std::size_t i = 0; i < n; ++i)
        pq += p[i] * q[i];
      const glm::dvec3 alpha = quotient(rho, pq);
      glm::dvec3 next(0.0);
      for (std::size_t i = 0; i < n; ++i) {
        x[i] += alpha * p[i];
        r[i] -= alpha * q[i];
        q[i] = r[i] / preconditioner[i];
        next += r[i] * q[i];
      }
      const glm::dvec3 beta = quotient(next, rho);
      for (std::size_t i = 0; i < n; ++i)
        p[i] = q[i] + beta * p[i];
      rho = next;
    }
    return x;
  }

 private:
  /// Replaces the diagonal by the damping and fixes unknowns. From here on the matrix is blocks plus damping.
  void addDamping() {
    double mean = 0.0;
    for (const double d : diagonal_)
      mean += d;
    mean /= static_cast<double>(std::max<std::size_t>(diagonal_.size(), 1));
    for (double& d : diagonal_)
      d = kDamping * d + 0.1 * kDamping * mean + 1e-30;
    for (const std::uint32_t i : fixed_)
      rhs_[i] = glm::dvec3(0.0);
  }
  std::vector<double> diagonalOfMatrix() const {
    std::vector<double> diagonal = diagonal_;
    for (std::size_t t = 0; t < blocks_.size(); ++t) {
      diagonal[indices_[3 * t]] += blocks_[t].aa;
      diagonal[indices_[3 * t + 1]] += blocks_[t].bb;
      diagonal[indices_[3 * t + 2]] += blocks_[t].cc;
    }
    return diagonal;
  }

  struct Block {
    double aa = 0, ab = 0, ac = 0, bb = 0, bc = 0, cc = 0;
  };
  static glm::dvec3 quotient(const glm::dvec3& a, const glm::dvec3& b) {
    return {b.x > 0.0 ? a.x / b.x : 0.0, b.y > 0.0 ? a.y / b.y : 0.0, b.z > 0.0 ? a.z / b.z : 0.0};
  }
  void multiply(const std::vector<glm::dvec3>& p, std::vector<glm::dvec3>& q) const {
    for (std::size_t i = 0; i < p.size(); ++i)
      q[i] = diagonal_[i] * p[i];
    for (std::size_t t = 0; t < blocks_.size(); ++t) {
      const Block& m = blocks_[t];
      const std::uint32_t a = indices_[3 * t];
      const std::uint32_t b = indices_[3 * t + 1];
      const std::uint32_t c = indices_[3 * t + 2];
      q[a] += m.aa * p[a] + m.ab * p[b] + m.ac * p[c];
      q[b] += m.ab * p[a] + m.bb * p[b] + m.bc * p[c];
      q[c] += m.ac * p[a] + m.bc * p[b] + m.cc * p[c];
    }
    for (const std::uint32_t i : fixed_)
      q[i] = diagonal_[i] * p[i];
  }

  std::span<const std::uint32_t> indices_;
  std::vector<Block> blocks_;
  std::vector<double> diagonal_;
  std::vector<glm::dvec3> rhs_;
  std::vector<std::uint32_t> fixed_;
};

/// Projects the samples onto the level.
void land(const WedgeMesh& level, std::span<const std::uint32_t> indices, const SliceRunner& slices,
          std::vector<Landing>& landings) {
  const TriangleBvh bvh(level.positions, indices);
  slices(landings.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const NearestPoint nearest = bvh.nearest(landings[i].point, landings[i].triangle);
      landings[i].triangle = nearest.triangle;
      landings[i].barycentric = nearest.barycentric;
    }
  });
}

std::vector<Landing> sampleOriginal(const WedgeMesh& original, std::span<const std::uint32_t> vertexMap,
                                    const WedgeMesh& level, std::size_t count, const RefitOptions& options) {
  const std::span<const std::uint32_t> partOfVertex = options.partOfVertex;
  const std::vector<std::uint32_t> triangleAt = triangleOfVertex(level);
  const AttributeSlot* normals = original.slot("NORMAL");
  const std::vector<SurfaceSample> samples = sampleSurface(original, count);
  std::vector<Landing> landings(samples.size());
  options.slices(samples.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const std::uint32_t t = samples[i].triangle;
      const std::uint32_t first = original.vertexAt(3 * std::size_t{t});
      std::uint32_t seed = TriangleBvh::kNoSeed;
      for (std::size_t k = 0; k < 3 && seed == TriangleBvh::kNoSeed; ++k) {
        const std::uint32_t v = vertexMap[original.vertexAt(3 * std::size_t{t} + k)];
        if (v != ~0U) seed = triangleAt[v];
      }
      landings[i] = {positionAt(original, t, samples[i].barycentric),
                     shadingNormalAt(original, normals, t, samples[i].barycentric), glm::vec3(0.0F), seed,
                     partOfVertex.empty() ? 0 : partOfVertex[first]};
    }
  });
  return landings;
}

/// Leaves out the samples that the level cannot fit. @param partOfLevel  of each vertex of the level; empty: one part
void choose(const WedgeMesh& level, std::span<const std::uint32_t> indices, std::span<const std::uint32_t> partOfLevel,
            std::vector<Landing>& landings) {
  constexpr double kFar = 20.0;  // times the root of the mean squared distance
  std::vector<double> distances2(landings.size(), 0.0);
  double sum = 0.0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < landings.size(); ++i) {
    Landing& landing = landings[i];
    landing.counts = partOfLevel.empty() || partOfLevel[indices[3 * std::size_t{landing.triangle}]] == landing.part;
    if (!landing.counts) continue;
    const glm::dvec3 off =
        glm::dvec3(landing.point) - glm::dvec3(positionAt(level, landing.triangle, landing.barycentric));
    sum += distances2[i] = glm::dot(off, off);
    ++count;
  }
  const double most = kFar * kFar * sum / static_cast<double>(std::max<std::size_t>(count, 1));
  for (std::size_t i = 0; i < landings.size(); ++i)
    landings[i].counts = landings[i].counts && distances2[i] <= most;
}

glm::dvec3 normalOfTriangle(const std::vector<glm::vec3>& positions, std::span<const std::uint32_t> indices,
                            std::size_t t) {
  return faceNormal(positions[indices[3 * t]], positions[indices[3 * t + 1]], positions[indices[3 * t + 2]]);
}

void fitPositions(std::span<const std::uint32_t> indices, const std::vector<Landing>& landings,
                  std::span<const std::uint8_t> fixed, WedgeMesh& level) {
  Equations equations(level.positions.size(), indices);
  for (const Landing& landing : landings) {
    if (!landing.counts) continue;
    const glm::dvec3 normal = normalOfTriangle(level.positions, indices, landing.triangle);
    if (glm::dot(normal, glm::dvec3(landing.normal)) < kSameSide) continue;
    const glm::dvec3 here(positionAt(level, landing.triangle, landing.barycentric));
    equations.add(landing.triangle, landing.barycentric, glm::dvec3(landing.point) - here);
  }
  for (std::uint32_t v = 0; v < fixed.size(); ++v)
    if (fixed[v] != 0) equations.fix(v);
  const std::vector<glm::dvec3> moves = equations.solve();
  const std::vector<glm::vec3> before = level.positions;
  for (std::size_t v = 0; v < moves.size(); ++v)
    if (fixed[v] == 0) level.positions[v] = glm::dvec3(before[v]) + moves[v];
  keepFacing(before, indices, level.positions);
}

void fitNormals(std::span<const std::uint32_t> indices, const std::vector<Landing>& landings, const AttributeSlot& slot,
                std::span<const std::uint8_t> fixed, WedgeMesh& level) {
  const auto normalAt = [&](std::uint32_t wedge) {
    const glm::dvec3 n(level.vec3At(wedge, slot));
    const double length = glm::length(n);
    return length > 1e-12 ? n / length : n;
  };
  Equations equations(level.vertexOf.size(), level.corners);
  for (const Landing& landing : landings) {
    if (!landing.counts) continue;
    const glm::dvec3 face = normalOfTriangle(level.positions, indices, landing.triangle);
    if (glm::dot(face, glm::dvec3(landing.normal)) < kSameSide) continue;
    glm::dvec3 here(0.0);
    for (int k = 0; k < 3; ++k)
      here += double{landing.barycentric[k]} *
              normalAt(level.corners[3 * std::size_t{landing.triangle} + static_cast<std::size_t>(k)]);
    equations.add(landing.triangle, landing.barycentric, glm::dvec3(landing.normal) - here);
  }
  for (std::uint32_t w = 0; w < level.vertexOf.size(); ++w)
    if (fixed[level.vertexOf[w]] != 0) equations.fix(w);
  const std::vector<glm::dvec3> changes = equations.solve();
  for (std::uint32_t w = 0; w < changes.size(); ++w) {
    if (fixed[level.vertexOf[w]] != 0) continue;
    const glm::dvec3 fitted = normalAt(w) + changes[w];
    const double length = glm::length(fitted);
    if (!(length > 1e-6)) continue;
    for (int k = 0; k < 3; ++k)
      level.attributes[std::size_t{w} * level.stride + slot.offset + static_cast<std::uint32_t>(k)] =
          static_cast<float>(fitted[k] / length);
  }
}

}  // namespace

void keepFacing(const std::vector<glm::vec3>& before, std::span<const std::uint32_t> indices,
                std::vector<glm::vec3>& after) {
  for (int pass = 0; pass < 8; ++pass) {
    bool again = false;
    for (std::size_t t = 0; t < indices.size() / 3; ++t) {
      const glm::dvec3 old = normalOfTriangle(before, indices, t);
      if (old == glm::dvec3(0.0)) continue;  // a triangle without area faces nowhere
      if (glm::dot(old, normalOfTriangle(after, indices, t)) >= kSameSide) continue;
      for (std::size_t k = 0; k < 3; ++k) {
        const std::uint32_t v = indices[3 * t + k];
        again = again || after[v] != before[v];
        after[v] = before[v];
      }
    }
    if (!again) return;
  }
  after = before;
}

void refitLevel(const WedgeMesh& original, std::span<const std::uint32_t> vertexMap, const RefitOptions& options,
                WedgeMesh& level) {
  const std::vector<std::uint32_t> indices = vertexIndices(level);
  std::vector<std::uint8_t> fixed(level.positions.size(), 0);
  if (options.lockBorder) {
    for (const MeshEdge& edge : findEdges(level).edges)
      if (edge.kind == EdgeKind::kBorder) fixed[edge.a] = fixed[edge.b] = 1;
  }
  for (std::size_t v = 0; v < options.locked.size(); ++v)
    if (options.locked[v] != 0 && vertexMap[v] != ~0U) fixed[vertexMap[v]] = 1;
  const std::size_t wanted = std::size_t{options.samplesPerTriangle} * level.triangles();
  const auto most = static_cast<std::size_t>(options.mostSamples * original.triangles());
  const std::size_t least = std::min(kLeastSamples, kLeastPerTriangle * original.triangles());
  std::vector<Landing> landings =
      sampleOriginal(original, vertexMap, level, std::max(std::min(wanted, most), least), options);
  if (landings.empty()) return;
  std::vector<std::uint32_t> partOfLevel(options.partOfVertex.empty() ? 0 : level.positions.size(), 0);
  for (std::size_t v = 0; v < options.partOfVertex.size(); ++v)
    if (vertexMap[v] != ~0U) partOfLevel[vertexMap[v]] = options.partOfVertex[v];
  for (std::uint32_t round = 0; round < options.rounds; ++round) {
    land(level, indices, options.slices, landings);
    choose(level, indices, partOfLevel, landings);
    fitPositions(indices, landings, fixed, level);
  }
  const AttributeSlot* normals = level.slot("NORMAL");
  if (!options.normals || normals == nullptr || normals->components != 3) return;
  if (options.rounds != 1) {
    land(level, indices, options.slices, landings);
    choose(level, indices, partOfLevel, landings);
  }
  fitNormals(indices, landings, *normals, fixed, level);
}

}  // namespace jalousie::bake
