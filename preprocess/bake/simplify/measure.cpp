// Samples means and percentiles, and finds maxima by branch and bound.
#include "bake/simplify/measure.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "bake/mesh/bounds.h"
#include "bake/mesh/union_find.h"

namespace jalousie::bake {
namespace {

constexpr double kMargin = 1.05;      // largest result, relative to the largest distance found
constexpr double kNegligible = 1e-7;  // of the diagonal
/// How far vertices of a flat face may lie off its plane and its rim, in kNegligible: the refit moves them by about as
/// much. A piece whose bound over the face is below the second multiple lies in the face.
constexpr double kFlat = 8.0;
constexpr double kInFace = 256.0;

/// For each wedge its chart: the lowest wedge that is connected to it by triangles.
std::vector<std::uint32_t> findCharts(const WedgeMesh& mesh) {
  UnionFind wedges(mesh.vertexOf.size());
  for (std::size_t c = 0; c < mesh.corners.size(); ++c)
    wedges.unite(mesh.corners[c], mesh.corners[c / 3 * 3]);
  return wedges.roots();
}

/// One surface seen from the other, in one direction.
struct Direction {
  const WedgeMesh& from;
  const WedgeMesh& to;
  const TriangleBvh& bvh;                    ///< of `to`
  const FlatPatches& patches;                ///< of `to`
  std::span<const std::uint32_t> seeds;      ///< per vertex of `from` a triangle of `to`, or empty
  std::span<const std::uint32_t> fromChart;  ///< per wedge of `from`
  std::span<const std::uint32_t> toChart;
  const SliceRunner& slices;
  double negligible;  ///< bound that is not split

  std::uint32_t seedOf(std::uint32_t vertex) const { return seeds.empty() ? TriangleBvh::kNoSeed : seeds[vertex]; }
};

/// Per-sample results; uv is negative where charts differ.
struct Measured {
  std::vector<double> distances, degrees, uvs;
  std::vector<std::uint32_t> nearest;  ///< triangles of the other surface
};

glm::dvec2 uvAt(const WedgeMesh& mesh, const AttributeSlot& slot, std::uint32_t triangle, const glm::dvec3& b) {
  glm::dvec2 uv(0.0);
  for (int k = 0; k < 3; ++k) {
    const std::uint32_t w = mesh.corners[3 * std::size_t{triangle} + static_cast<std::size_t>(k)];
    const float* value = &mesh.attributes[std::size_t{w} * mesh.stride + slot.offset];
    uv += b[k] * glm::dvec2(value[0], value[1]);
  }
  return uv;
}

Measured measureSamples(const Direction& direction, const std::vector<SurfaceSample>& samples) {
  const AttributeSlot* fromNormals = direction.from.slot("NORMAL");
  const AttributeSlot* toNormals = direction.to.slot("NORMAL");
  const AttributeSlot* fromUv = direction.from.slot("TEXCOORD_0");
  const AttributeSlot* toUv = direction.to.slot("TEXCOORD_0");
  Measured measured;
  measured.distances.resize(samples.size());
  measured.degrees.resize(samples.size());
  measured.uvs.assign(samples.size(), -1.0);
  measured.nearest.resize(samples.size());
  direction.slices(samples.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const std::uint32_t t = samples[i].triangle;
      const glm::dvec3 b(samples[i].barycentric);
      const std::uint32_t seed = direction.seedOf(direction.from.vertexAt(3 * std::size_t{t}));
      const NearestPoint nearest = direction.bvh.nearest(positionAt(direction.from, t, b), seed);
      measured.distances[i] = std::sqrt(nearest.distance2);
      measured.nearest[i] = nearest.triangle;
      const glm::dvec3 n = shadingNormalAt(direction.from, fromNormals, t, b);
      const glm::dvec3 m = shadingNormalAt(direction.to, toNormals, nearest.triangle, nearest.barycentric);
      measured.degrees[i] = std::atan2(glm::length(glm::cross(n, m)), glm::dot(n, m)) * 180.0 / std::numbers::pi;
      if (fromUv == nullptr || toUv == nullptr) continue;
      if (direction.fromChart[direction.from.corners[3 * std::size_t{t}]] !=
          direction.toChart[direction.to.corners[3 * std::size_t{nearest.triangle}]])
        continue;
      measured.uvs[i] = glm::length(uvAt(direction.from, *fromUv, t, b) -
                                    uvAt(direction.to, *toUv, nearest.triangle, nearest.barycentric));
    }
  });
  return measured;
}

/// A corner of a piece with a triangle near it, mostly the nearest, and the distance to that one.
struct Probe {
  glm::vec3 point{0.0F};
  float distance = 0.0F;
  std::uint32_t nearest = 0;
};

/// A part of a triangle. Its points are at most `bound` away.
struct Piece {
  std::array<Probe, 3> corners;
  float bound = 0.0F;
  std::uint32_t triangle = 0;
};

/// The largest distances found of each group of a level, in one direction.
struct GroupMaxima {
  const LevelGroups& groups;
  bool toOriginal = true;  ///< points of the level; else those of the original
  std::vector<double> most;

  /// @param triangle  of the surface that the point lies on   @param nearest  of the other one
  std::uint32_t groupAt(std::uint32_t triangle, std::uint32_t nearest) const {
    if (toOriginal) return groups.ofTriangle[triangle];
    const std::uint32_t lost = groups.ofOriginalTriangle[triangle];
    return lost != ~0U ? lost : groups.ofTriangle[nearest];
  }
  void note(std::uint32_t triangle, const Probe& probe) {
    double& largest = most[groupAt(triangle, probe.nearest)];
    largest = std::max(largest, double{probe.distance});
  }
};

/// Finds the largest distance in one direction by branch and bound.
class MaximumSearch {
 public:
  /// @param maxima  get the distances that are found, from half of `found` on at every vertex; may be null
  MaximumSearch(const Direction& direction, double found, const MeterOptions& options, GroupMaxima* maxima)
      : direction_(direction),
        maxima_(maxima),
        found_(found),
        half_(0.5 * found),
        searches_(options.searches),
        closeEnough_(options.closeEnough),
        giveUp_(options.giveUp) {}

  double run() {
    probeVertices();
    collectPieces();
    while (!queue_.empty() && searches_ > 0 && found_ <= giveUp_ && queue_.front().bound > open()) {
      std::pop_heap(queue_.begin(), queue_.end(), isLess);
      const Piece piece = queue_.back();
      queue_.pop_back();
      split(piece);
    }
    const double bound = std::max(found_, queue_.empty() ? 0.0 : double{queue_.front().bound});
    if (bound <= direction_.negligible) return bound;
    return std::min(std::max(bound, found_ * closeEnough_), found_ * kMargin);
  }

 private:
  static bool isLess(const Piece& a, const Piece& b) { return a.bound < b.bound; }

  Probe probe(const glm::vec3& point, std::uint32_t seed) const {
    const NearestPoint nearest = direction_.bvh.nearest(point, seed);
    return {point, static_cast<float>(std::sqrt(nearest.distance2)), nearest.triangle};
  }

  /// A vertex whose seed is near enough needs no search: the distance to any triangle bounds its distance.
  Probe probeVertex(const glm::vec3& point, std::uint32_t seed) const {
    if (seed != TriangleBvh::kNoSeed) {
      const TriangleBvh::Corners& t = direction_.bvh.corners(seed);
      const double bound = std::sqrt(squaredDistanceToTriangle(point, t.a, t.b, t.c));
      if (bound <= half_) return {point, static_cast<float>(bound), seed};
    }
    return probe(point, seed);
  }

  void probeVertices() {
    vertices_.resize(direction_.from.positions.size());
    direction_.slices(vertices_.size(), [&](std::size_t begin, std::size_t end) {
      for (std::size_t v = begin; v < end; ++v)
        vertices_[v] = probeVertex(direction_.from.positions[v], direction_.seedOf(static_cast<std::uint32_t>(v)));
    });
    for (const Probe& vertex : vertices_)
      found_ = std::max(found_, double{vertex.distance});
  }

  /// Bound by the distance of a corner plus the length of the way from there.
  static float lipschitzBound(const Piece& piece) {
    float bound = std::numeric_limits<float>::infinity();
    for (std::size_t k = 0; k < 3; ++k) {
      const Probe& corner = piece.corners[k];
      const float way = std::max(glm::distance(corner.point, piece.corners[(k + 1) % 3].point),
                                 glm::distance(corner.point, piece.corners[(k + 2) % 3].point));
      bound = std::min(bound, corner.distance + way);
    }
    return bound;
  }

  /// The least, over the corners' nearest triangles, of the largest distance of a corner to that triangle.
  float convexBound(const Piece& piece) const {
    float bound = std::numeric_limits<float>::infinity();
    for (std::size_t k = 0; k < 3; ++k) {
      if (k > 0 && piece.corners[k].nearest == piece.corners[0].nearest) continue;
      const TriangleBvh::Corners& t = direction_.bvh.corners(piece.corners[k].nearest);
      double most = 0.0;
      for (const Probe& corner : piece.corners)
        most = std::max(most, squaredDistanceToTriangle(corner.point, t.a, t.b, t.c));
      bound = std::min(bound, static_cast<float>(std::sqrt(most)));
    }
    return bound;
  }

  /// The least bound by the flat faces that the corners' nearest triangles belong to.
  float patchBound(const Piece& piece) const {
    const auto& [a, b, c] = piece.corners;
    double bound = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k < 3; ++k)
      bound = std::min(bound, direction_.patches.bound(piece.corners[k].nearest, {a.point, b.point, c.point}));
    return static_cast<float>(bound);
  }

  bool matters(Piece& piece) const {
    piece.bound = lipschitzBound(piece);
    if (piece.bound <= found_ * closeEnough_) return false;
    piece.bound = std::min(piece.bound, convexBound(piece));
    if (piece.bound <= open()) return false;
    const float overPatch = patchBound(piece);
    if (overPatch <= kInFace * direction_.negligible) return false;
    piece.bound = std::min(piece.bound, overPatch);
    return piece.bound > found_ * closeEnough_;
  }

  /// Bounds below this are not closed in on.
  double open() const { return std::max(found_ * closeEnough_, direction_.negligible); }

  void collectPieces() {
    const WedgeMesh& mesh = direction_.from;
    for (std::size_t c = 0; c < mesh.corners.size(); c += 3) {
      Piece piece{{vertices_[mesh.vertexAt(c)], vertices_[mesh.vertexAt(c + 1)], vertices_[mesh.vertexAt(c + 2)]}};
      piece.triangle = static_cast<std::uint32_t>(c / 3);
      for (const Probe& corner : piece.corners)
        if (maxima_ != nullptr && corner.distance > half_) maxima_->note(piece.triangle, corner);
      if (matters(piece)) queue_.push_back(piece);
    }
    std::make_heap(queue_.begin(), queue_.end(), isLess);
  }

  void split(const Piece& piece) {
    searches_ -= std::min(searches_, 3U);
    std::array<Probe, 3> middle;
    for (std::size_t k = 0; k < 3; ++k) {
      middle[k] = probe(0.5F * (piece.corners[k].point + piece.corners[(k + 1) % 3].point), piece.corners[k].nearest);
      found_ = std::max(found_, double{middle[k].distance});
      if (maxima_ != nullptr) maxima_->note(piece.triangle, middle[k]);
    }
    for (std::size_t k = 0; k < 3; ++k)
      keep({{piece.corners[k], middle[k], middle[(k + 2) % 3]}, 0.0F, piece.triangle});
    keep({{middle[0], middle[1], middle[2]}, 0.0F, piece.triangle});
  }

  void keep(Piece piece) {
    if (!matters(piece)) return;
    queue_.push_back(piece);
    std::push_heap(queue_.begin(), queue_.end(), isLess);
  }

  const Direction& direction_;
  GroupMaxima* maxima_;
  double found_;
  double half_;  ///< of what was found at first
  std::uint32_t searches_;
  double closeEnough_;
  double giveUp_;
  std::vector<Probe> vertices_;
  std::vector<Piece> queue_;
};

/// Far from the origin, positions of single precision are rounded to more than kNegligible.
double negligibleLength(const Aabb& box) {
  const glm::vec3 most = glm::max(glm::abs(box.min), glm::abs(box.max));
  const double rounding = 2.0 * std::numeric_limits<float>::epsilon() * std::max({most.x, most.y, most.z});
  return std::max(kNegligible * box.diagonal(), rounding);
}

/// Points per surface: a level of few triangles needs few.
std::size_t samplesFor(const MeterOptions& options, std::uint32_t triangles) {
  if (options.perTriangle == 0) return options.samples;
  constexpr std::uint64_t kLeast = 64;
  return std::min<std::uint64_t>(options.samples, kLeast + std::uint64_t{options.perTriangle} * triangles);
}

double meanOf(const std::vector<double>& values) {
  double sum = 0.0;
  for (const double value : values)
    sum += value;
  return values.empty() ? 0.0 : sum / static_cast<double>(values.size());
}

Distances distanceOf(const Direction& direction, const Measured& measured, const MeterOptions& options,
                     GroupMaxima* maxima) {
  double found = 0.0;
  for (const double distance : measured.distances)
    found = std::max(found, distance);
  if (found > options.giveUp) return {found, meanOf(measured.distances)};
  return {MaximumSearch(direction, found, options, maxima).run(), meanOf(measured.distances)};
}

/// Mean and 95th percentile of two lists together; negative values are left out.
Spread spreadOf(const std::vector<double>& a, const std::vector<double>& b) {
  std::vector<double> values;
  for (const std::vector<double>* list : {&a, &b})
    std::copy_if(list->begin(), list->end(), std::back_inserter(values), [](double value) { return value >= 0.0; });
  if (values.empty()) return {};
  const double mean = meanOf(values);
  const std::size_t rank = std::min(values.size() - 1, values.size() * 95 / 100);
  std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(rank), values.end());
  return {mean, values[rank]};
}

/// Means of the distances of each group in one direction; 0 where it has no point. @param maxima  get the largest ones
/// @param samples  where the points lie   @param count  gets the points of each group
std::vector<double> meansOfGroups(const std::vector<SurfaceSample>& samples, const Measured& measured,
                                  GroupMaxima& maxima, std::vector<std::uint32_t>& count) {
  std::vector<double> means(maxima.groups.count, 0.0);
  count.assign(maxima.groups.count, 0);
  maxima.most.assign(maxima.groups.count, 0.0);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const std::uint32_t group = maxima.groupAt(samples[i].triangle, measured.nearest[i]);
    maxima.most[group] = std::max(maxima.most[group], measured.distances[i]);
    means[group] += measured.distances[i];
    ++count[group];
  }
  for (std::uint32_t group = 0; group < means.size(); ++group)
    means[group] /= std::max(count[group], 1U);
  return means;
}

/// The measures of groups in both directions.
class GroupMeasures {
 public:
  explicit GroupMeasures(const LevelGroups& groups) : there_{groups, true, {}}, back_{groups, false, {}} {}

  GroupMaxima* there() { return &there_; }
  GroupMaxima* back() { return &back_; }
  void addSamples(const std::vector<SurfaceSample>& toSamples, const Measured& to,
                  const std::vector<SurfaceSample>& fromSamples, const Measured& from) {
    meansThere_ = meansOfGroups(toSamples, to, there_, countThere_);
    meansBack_ = meansOfGroups(fromSamples, from, back_, countBack_);
  }
  /// @param largest  two-sided maximum of the level: the largest of the groups gets it, the others grow in proportion
  std::vector<Distances> distances(double largest) const {
    std::vector<Distances> result;
    double found = 0.0;
    for (std::uint32_t g = 0; g < meansThere_.size(); ++g) {
      const bool both = countThere_[g] > 0 && countBack_[g] > 0;
      const double sum = meansThere_[g] + meansBack_[g];
      result.push_back({std::max(there_.most[g], back_.most[g]), both ? 0.5 * sum : sum});
      found = std::max(found, result.back().max);
    }
    for (Distances& group : result)
      group.max *= found > 0.0 ? std::max(largest / found, 1.0) : 1.0;
    return result;
  }

 private:
  GroupMaxima there_, back_;
  std::vector<double> meansThere_, meansBack_;
  std::vector<std::uint32_t> countThere_, countBack_;
};

}  // namespace

DeviationMeter::DeviationMeter(const WedgeMesh& original, const MeterOptions& options)
    : original_(original),
      options_(options),
      bvh_(original.positions, vertexIndices(original)),
      negligible_(negligibleLength(boundsOf(original.positions))),
      patches_(original.positions, vertexIndices(original), kFlat * negligible_),
      chartOf_(findCharts(original)) {}

Deviation DeviationMeter::measure(const WedgeMesh& level, std::span<const std::uint32_t> vertexMap) const {
  return measure(level, vertexMap, nullptr, nullptr);
}

Deviation DeviationMeter::measure(const WedgeMesh& level, std::span<const std::uint32_t> vertexMap,
                                  const LevelGroups& groups, std::vector<Distances>& distances) const {
  return measure(level, vertexMap, &groups, &distances);
}

Deviation DeviationMeter::measure(const WedgeMesh& level, std::span<const std::uint32_t> vertexMap,
                                  const LevelGroups* groups, std::vector<Distances>* distances) const {
  const TriangleBvh levelBvh(level.positions, vertexIndices(level));
  const FlatPatches levelPatches(level.positions, vertexIndices(level), kFlat * negligible_);
  std::vector<std::uint32_t> levelSeeds;
  std::vector<std::uint32_t> originalSeeds;
  if (!vertexMap.empty()) {
    const std::vector<std::uint32_t> levelTriangle = triangleOfVertex(level);
    const std::vector<std::uint32_t> originalTriangle = triangleOfVertex(original_);
    originalSeeds.assign(original_.positions.size(), TriangleBvh::kNoSeed);
    levelSeeds.assign(level.positions.size(), TriangleBvh::kNoSeed);
    for (std::size_t v = 0; v < vertexMap.size(); ++v) {
      if (vertexMap[v] == ~0U) continue;
      originalSeeds[v] = levelTriangle[vertexMap[v]];
      levelSeeds[vertexMap[v]] = originalTriangle[v];
    }
  }
  std::vector<std::uint32_t> levelChart(level.vertexOf.size());
  for (std::size_t w = 0; w < levelChart.size(); ++w)
    levelChart[w] = level.sourceWedge[w] < chartOf_.size() ? chartOf_[level.sourceWedge[w]] : ~0U;

  const Direction there{level,    original_,       bvh_,       patches_, levelSeeds, levelChart,
                        chartOf_, options_.slices, negligible_};
  const Direction back{original_, level,      levelBvh,        levelPatches, originalSeeds,
                       chartOf_,  levelChart, options_.slices, negligible_};
  const std::size_t samples = samplesFor(options_, level.triangles());
  const std::vector<SurfaceSample> toSamples = sampleSurface(level, samples);
  const std::vector<SurfaceSample> fromSamples = sampleSurface(original_, samples);
  const Measured to = measureSamples(there, toSamples);
  const Measured from = measureSamples(back, fromSamples);
  std::optional<GroupMeasures> ofGroups;
  if (groups != nullptr) ofGroups.emplace(*groups).addSamples(toSamples, to, fromSamples, from);
  Deviation deviation;
  deviation.toOriginal = distanceOf(there, to, options_, ofGroups ? ofGroups->there() : nullptr);
  deviation.fromOriginal = distanceOf(back, from, options_, ofGroups ? ofGroups->back() : nullptr);
  deviation.twoSided = {std::max(deviation.toOriginal.max, deviation.fromOriginal.max),
                        0.5 * (deviation.toOriginal.mean + deviation.fromOriginal.mean)};
  if (ofGroups) *distances = ofGroups->distances(deviation.twoSided.max);
  deviation.normalDegrees = spreadOf(to.degrees, from.degrees);
  deviation.uv = spreadOf(to.uvs, from.uvs);
  return deviation;
}

}  // namespace jalousie::bake
