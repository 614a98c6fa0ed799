// Projects points both ways, assembles a sparse least squares problem and solves it with conjugate gradients.
#include "bake/simplify/patch_fit.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "bake/mesh/surface_samples.h"
#include "bake/mesh/triangle_bvh.h"
#include "bake/simplify/refit.h"
#include "core/check.h"

namespace jalousie::bake {
namespace {

constexpr double kPositionDamping = 0.02;  // relative to the weight of the samples of a vertex
constexpr double kNormalDamping = 0.1;
constexpr double kAlong = 0.3;     // weight of a residual along the surface, relative to one across it
constexpr double kShading = 0.03;  // weight of a normal's deviation, relative to the mean edge
constexpr std::uint32_t kSolverSteps = 40;
constexpr double kResidual = 1e-4;  // of the start, at which the solver ends
constexpr double kFacing = 0.3;     // least cosine between the normals of two points that belong together
constexpr double kProgress = 1e-3;  // least relative change of the distance that counts

/// Two points that belong together: one of the original, one of a patch.
struct PatchSample {
  glm::vec3 point{0.0F};
  glm::vec3 normal{0.0F};
  glm::dvec3 barycentric{0.0};
  std::uint32_t patch = 0;
  bool fromSurface = false;  ///< projected onto the original; else the other way
  bool counts = false;
};

/// |sum_k weights_k delta_vertex_k - wanted|^2, one row of the problem.
struct PatchRow {
  std::array<std::uint32_t, 3> vertex;
  std::array<glm::dmat3, 3> weights;
  glm::dvec3 wanted;
};

/// Damped least squares of changes of one vector per vertex.
class PatchProblem {
 public:
  explicit PatchProblem(std::size_t vertices) : diagonal_(vertices, glm::dmat3(0.0)) {}

  void add(const PatchRow& row) {
    rows_.push_back(row);
    for (std::size_t k = 0; k < 3; ++k)
      diagonal_[row.vertex[k]] += glm::transpose(row.weights[k]) * row.weights[k];
  }

  /// Conjugate gradients with the 3x3 blocks of the diagonal as preconditioner.
  std::vector<glm::dvec3> solve(double damping) {
    addDamping(damping);
    const std::size_t n = diagonal_.size();
    std::vector<glm::dvec3> x(n, glm::dvec3(0.0));
    std::vector<glm::dvec3> r(n, glm::dvec3(0.0));
    for (const PatchRow& row : rows_)
      for (std::size_t k = 0; k < 3; ++k)
        r[row.vertex[k]] += glm::transpose(row.weights[k]) * row.wanted;
    std::vector<glm::dvec3> p = precondition(r);
    std::vector<glm::dvec3> q(n);
    double rho = product(r, p);
    const double enough = kResidual * kResidual * rho;
    for (std::uint32_t step = 0; step < kSolverSteps && rho > enough; ++step) {
      multiply(p, q);
      const double along = product(p, q);
      if (!(along > 0.0)) break;
      for (std::size_t i = 0; i < n; ++i) {
        x[i] += rho / along * p[i];
        r[i] -= rho / along * q[i];
      }
      const std::vector<glm::dvec3> z = precondition(r);
      const double next = product(r, z);
      for (std::size_t i = 0; i < n; ++i)
        p[i] = z[i] + next / rho * p[i];
      rho = next;
    }
    return x;
  }

 private:
  void addDamping(double damping) {
    double mean = 0.0;
    for (const glm::dmat3& block : diagonal_)
      mean += traceOf(block) / (3.0 * static_cast<double>(diagonal_.size()));
    damping_.resize(diagonal_.size());
    inverse_.resize(diagonal_.size());
    for (std::size_t v = 0; v < diagonal_.size(); ++v) {
      damping_[v] = damping * (traceOf(diagonal_[v]) / 3.0 + 0.1 * mean) + 1e-30;
      inverse_[v] = glm::inverse(diagonal_[v] + damping_[v] * glm::dmat3(1.0));
    }
  }
  static double traceOf(const glm::dmat3& m) { return m[0][0] + m[1][1] + m[2][2]; }
  static double product(const std::vector<glm::dvec3>& a, const std::vector<glm::dvec3>& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i)
      sum += glm::dot(a[i], b[i]);
    return sum;
  }
  std::vector<glm::dvec3> precondition(const std::vector<glm::dvec3>& r) const {
    std::vector<glm::dvec3> z(r.size());
    for (std::size_t i = 0; i < r.size(); ++i)
      z[i] = inverse_[i] * r[i];
    return z;
  }
  void multiply(const std::vector<glm::dvec3>& p, std::vector<glm::dvec3>& q) const {
    for (std::size_t i = 0; i < p.size(); ++i)
      q[i] = damping_[i] * p[i];
    for (const PatchRow& row : rows_) {
      glm::dvec3 sum(0.0);
      for (std::size_t k = 0; k < 3; ++k)
        sum += row.weights[k] * p[row.vertex[k]];
      for (std::size_t k = 0; k < 3; ++k)
        q[row.vertex[k]] += glm::transpose(row.weights[k]) * sum;
    }
  }

  std::vector<PatchRow> rows_;
  std::vector<glm::dmat3> diagonal_;
  std::vector<double> damping_;
  std::vector<glm::dmat3> inverse_;
};

/// One fit: the original, the mesh so far and the points that belong together.
class PatchFitter {
 public:
  PatchFitter(const WedgeMesh& original, const PatchMesh& start, const PatchFitOptions& options)
      : original_(original),
        options_(options),
        bvh_(original.positions, vertexIndices(original)),
        samples_(sampleSurface(original, options.samples)),
        pattern_(patchPattern(options.level)),
        state_(land(start)) {}

  PatchFit run() {
    PatchFit fit{.mesh = {}, .before = state_.distance, .after = 0.0, .rounds = 0};
    bool better = !samples_.empty();
    while (better && fit.rounds < options_.rounds) {
      ++fit.rounds;
      const std::vector<glm::dvec3> moves = solvePositions();
      better = tryChange([&](double share) { return movePositions(moves, share); });
      const std::vector<glm::dvec3> turns = solveNormals();
      better |= tryChange([&](double share) { return turnNormals(turns, share); });
      const double bend = solveBend();
      better |= tryChange([&](double share) { return bendMore(bend, share); });
    }
    fit.mesh = std::move(state_.mesh);
    fit.after = state_.distance;
    return fit;
  }

 private:
  struct State {
    PatchMesh mesh;
    std::vector<PatchSample> samples;
    double distance = 0.0;
  };

  /// Projects all points anew.
  State land(const PatchMesh& mesh) const {
    State state{.mesh = mesh, .samples = {}, .distance = 0.0};
    const WedgeMesh surface = tessellate(mesh, pattern_);
    const std::size_t points = pattern_.points.size();
    state.samples.resize(samples_.size() + surface.positions.size());
    std::vector<double> distances2(state.samples.size());
    const TriangleBvh bvh(surface.positions, surface.corners);
    options_.slices(samples_.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i)
        distances2[i] = landOriginal(surface, bvh, samples_[i], state.samples[i]);
    });
    options_.slices(surface.positions.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        PatchSample& sample = state.samples[samples_.size() + i];
        sample.fromSurface = true;
        sample.patch = static_cast<std::uint32_t>(i / points);
        sample.barycentric = pattern_.points[i % points];
        distances2[samples_.size() + i] = landSurface(surface, i, sample);
      }
    });
    state.distance = meanOf(distances2);
    return state;
  }

  /// Half the weight for each direction.
  double meanOf(const std::vector<double>& distances2) const {
    double from = 0.0;
    double to = 0.0;
    for (std::size_t i = 0; i < distances2.size(); ++i)
      (i < samples_.size() ? from : to) += distances2[i];
    const auto count = static_cast<double>(std::max<std::size_t>(samples_.size(), 1));
    return std::sqrt(0.5 * (from / count + to / static_cast<double>(distances2.size() - samples_.size())));
  }

  /// From a point of the original to the surface. @return squared distance
  double landOriginal(const WedgeMesh& surface, const TriangleBvh& bvh, const SurfaceSample& from,
                      PatchSample& sample) const {
    const AttributeSlot* normals = original_.slot("NORMAL");
    sample.point = positionAt(original_, from.triangle, from.barycentric);
    sample.normal = shadingNormalAt(original_, normals, from.triangle, from.barycentric);
    const NearestPoint nearest = bvh.nearest(sample.point);
    const std::size_t perPatch = pattern_.indices.size() / 3;
    sample.patch = static_cast<std::uint32_t>(nearest.triangle / perPatch);
    for (std::size_t k = 0; k < 3; ++k)
      sample.barycentric += nearest.barycentric[static_cast<int>(k)] *
                            pattern_.points[pattern_.indices[3 * (nearest.triangle % perPatch) + k]];
    const glm::dvec3 facing = shadingNormalAt(surface, nullptr, nearest.triangle, nearest.barycentric);
    sample.counts = glm::dot(facing, glm::dvec3(sample.normal)) >= kFacing;
    return nearest.distance2;
  }

  /// From a point of the surface to the original. @return squared distance
  double landSurface(const WedgeMesh& surface, std::size_t i, PatchSample& sample) const {
    const NearestPoint nearest = bvh_.nearest(surface.positions[i]);
    sample.point = positionAt(original_, nearest.triangle, nearest.barycentric);
    sample.normal = shadingNormalAt(original_, original_.slot("NORMAL"), nearest.triangle, nearest.barycentric);
    const glm::vec3 own = surface.vec3At(static_cast<std::uint32_t>(i), surface.slots.front());
    sample.counts = glm::dot(own, sample.normal) >= static_cast<float>(kFacing);
    return nearest.distance2;
  }

  /// Takes a change, or a half or a quarter of it, if it makes the distance smaller.
  template <class Change>
  bool tryChange(const Change& change) {
    for (const double share : {1.0, 0.5, 0.25}) {
      State next = land(change(share));
      if (!(next.distance < state_.distance * (1.0 - kProgress))) continue;
      state_ = std::move(next);
      return true;
    }
    return false;
  }

  std::array<std::uint32_t, 3> verticesOf(std::uint32_t patch) const {
    const std::uint32_t* at = &state_.mesh.indices[3 * std::size_t{patch}];
    return {at[0], at[1], at[2]};
  }

  /// The row of a sample: across the surface it counts in full, along it less.
  PatchRow rowOf(const PatchSample& sample, const PatchPoint& at, const std::array<glm::dmat3, 3>& derivatives) const {
    const glm::dvec3 n(sample.normal);
    const glm::dmat3 scale = weightOf(sample) * (kAlong * glm::dmat3(1.0) + (1.0 - kAlong) * glm::outerProduct(n, n));
    PatchRow row{verticesOf(sample.patch), {}, scale * (glm::dvec3(sample.point) - at.point)};
    for (std::size_t k = 0; k < 3; ++k)
      row.weights[k] = scale * derivatives[k];
    return row;
  }

  /// Both directions count alike, however many points they have.
  double weightOf(const PatchSample& sample) const {
    const std::size_t surface = state_.samples.size() - samples_.size();
    return sample.fromSurface ? std::sqrt(static_cast<double>(samples_.size()) / static_cast<double>(surface)) : 1.0;
  }

  std::vector<glm::dvec3> solvePositions() const {
    PatchProblem problem(state_.mesh.positions.size());
    for (const PatchSample& sample : state_.samples) {
      if (!sample.counts) continue;
      const PatchPoint at = patchPoint(state_.mesh, sample.patch, sample.barycentric);
      problem.add(rowOf(sample, at, at.byPosition));
    }
    return problem.solve(kPositionDamping);
  }

  PatchMesh movePositions(const std::vector<glm::dvec3>& moves, double share) const {
    PatchMesh mesh = state_.mesh;
    for (std::size_t v = 0; v < moves.size(); ++v)
      mesh.positions[v] = glm::dvec3(mesh.positions[v]) + share * moves[v];
    keepFacing(state_.mesh.positions, mesh.indices, mesh.positions);
    return mesh;
  }

  double meanEdge() const {
    double sum = 0.0;
    const std::vector<std::uint32_t>& indices = state_.mesh.indices;
    for (std::size_t c = 0; c < indices.size(); ++c) {
      const std::uint32_t next = indices[c % 3 == 2 ? c - 2 : c + 1];
      sum += glm::distance(state_.mesh.positions[indices[c]], state_.mesh.positions[next]);
    }
    return sum / static_cast<double>(indices.size());
  }

  /// Besides the distance, the interpolated normals count a little: they are shaded.
  std::vector<glm::dvec3> solveNormals() const {
    PatchProblem problem(state_.mesh.positions.size());
    const double weight = kShading * meanEdge();
    for (const PatchSample& sample : state_.samples) {
      if (!sample.counts) continue;
      const std::array<std::uint32_t, 3> vertices = verticesOf(sample.patch);
      const PatchPoint at = patchPoint(state_.mesh, sample.patch, sample.barycentric);
      problem.add(rowOf(sample, at, at.byNormal));
      const double full = weight * weightOf(sample);
      PatchRow shading{vertices, {}, full * glm::dvec3(sample.normal)};
      for (std::size_t k = 0; k < 3; ++k) {
        const glm::dvec3 n(state_.mesh.normals[vertices[k]]);
        const double b = full * sample.barycentric[static_cast<int>(k)];
        shading.weights[k] = b * (glm::dmat3(1.0) - glm::outerProduct(n, n));
        shading.wanted -= b * n;
      }
      problem.add(shading);
    }
    return problem.solve(kNormalDamping);
  }

  PatchMesh turnNormals(const std::vector<glm::dvec3>& changes, double share) const {
    PatchMesh mesh = state_.mesh;
    for (std::size_t v = 0; v < changes.size(); ++v) {
      const glm::dvec3 n(mesh.normals[v]);
      const glm::dvec3 turned = n + share * (changes[v] - glm::dot(changes[v], n) * n);
      const double length = glm::length(turned);
      if (length > 1e-6) mesh.normals[v] = turned / length;
    }
    return mesh;
  }

  /// The surface is linear in alpha: the change that is best for these points.
  double solveBend() const {
    double above = 0.0;
    double below = 0.0;
    for (const PatchSample& sample : state_.samples) {
      if (!sample.counts) continue;
      const PatchPoint at = patchPoint(state_.mesh, sample.patch, sample.barycentric);
      const double weight = weightOf(sample) * weightOf(sample);
      above -= weight * glm::dot(glm::dvec3(sample.point) - at.point, at.bend);
      below += weight * glm::dot(at.bend, at.bend);
    }
    return below > 0.0 ? above / below : 0.0;
  }

  PatchMesh bendMore(double change, double share) const {
    PatchMesh mesh = state_.mesh;
    mesh.alpha = std::clamp(mesh.alpha + share * change, 0.0, 1.0);
    return mesh;
  }

  const WedgeMesh& original_;
  const PatchFitOptions& options_;
  TriangleBvh bvh_;  ///< of the original
  std::vector<SurfaceSample> samples_;
  PatchPattern pattern_;
  State state_;
};

}  // namespace

PatchFit fitPatches(const WedgeMesh& original, const PatchMesh& start, const PatchFitOptions& options) {
  JAL_CHECK(original.triangles() > 0U);
  JAL_CHECK(start.indices.size() >= 3U);
  return PatchFitter(original, start, options).run();
}

Deviation measurePatches(const DeviationMeter& meter, const PatchMesh& mesh, std::uint32_t level) {
  return meter.measure(tessellate(mesh, patchPattern(level)));
}

}  // namespace jalousie::bake
