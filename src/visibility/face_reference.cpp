// One instance after the other.
#include "visibility/face_reference.h"

#include <algorithm>
#include <cmath>

#include "scene/face_tables.h"
#include "shared/limits.h"

namespace jalousie::visibility {
namespace {

using glm::vec3;
using glm::vec4;

vec3 xyz(const vec4& v) {
  return {v};
}

/// max n.x over a box of normals.
float supportOf(const gpu::FaceNode& node, const vec3& x) {
  float sum[3];
  for (int k = 0; k < 3; ++k)
    sum[k] = (x[k] > 0.0F ? node.highest[k] : node.lowest[k]) * x[k];
  return sum[0] + sum[1] + sum[2];
}

float clusterSlack(const gpu::FaceNode& node, const vec4& eye) {
  return node.lowest.w * eye.w - supportOf(node, xyz(eye) - eye.w * xyz(node.origin));
}

float coneSlack(const gpu::FaceNode& node, const vec4& eye) {
  if (!(node.axis.w > 0.0F)) return -1.0F;
  const vec3 v = xyz(node.apex) * eye.w - xyz(eye);
  const float sine = std::sqrt(std::max(1.0F - node.axis.w * node.axis.w, 0.0F));
  return node.axis.w * glm::dot(v, xyz(node.axis)) - sine * glm::length(glm::cross(v, xyz(node.axis))) -
         2.0F * gpu::kRounding * (glm::length(v) + glm::length(xyz(node.apex)));
}

/// Corner of the rectangle of cells on the cube. @param corner  0..3
vec3 cornerOf(gpu::uint normals, unsigned corner) {
  const gpu::uint axis = (normals & 7U) >> 1U;
  const auto line = [&](gpu::uint shift) {
    return 2.0F * static_cast<float>(normals >> shift & 31U) / static_cast<float>(gpu::kNormalCells) - 1.0F;
  };
  vec3 g;
  g[static_cast<int>(axis)] = (normals & 1U) != 0 ? -1.0F : 1.0F;
  g[static_cast<int>((axis + 1) % 3)] = line((corner & 1U) != 0 ? 8U : 3U);
  g[static_cast<int>((axis + 2) % 3)] = line((corner & 2U) != 0 ? 18U : 13U);
  return g;
}

/// Rays from the eye to the corners of the box, up to the depth 1.
using Sector = std::array<vec3, 8>;

Sector sectorOf(const gpu::CullView& view, const FaceFrame& frame, const gpu::FaceLod& lod) {
  Sector rays;
  for (unsigned corner = 0; corner < rays.size(); ++corner) {
    vec3 p;
    for (int k = 0; k < 3; ++k)
      p[k] = (corner >> k & 1U) != 0 ? lod.boundsMaxObject[k] : lod.boundsMinObject[k];
    const float depth = glm::dot(frame.depth, vec4(p, 1.0F));
    if (frame.eye.w == 0.0F) {
      rays[corner] = -xyz(frame.eye);
    } else {
      rays[corner] = depth > view.cameraWorld.w ? (p - xyz(frame.eye)) / depth : vec3(0.0F);
    }
  }
  return rays;
}

float sectorLeast(const gpu::FaceNode& node, const Sector& rays) {
  if (node.normals == gpu::kNoNormals) return -1.0F;
  float least = gpu::kFaceNever;
  for (unsigned corner = 0; corner < 4; ++corner)
    for (const vec3& ray : rays)
      least = std::min(least, glm::dot(cornerOf(node.normals, corner), ray));
  return least;
}

/// The ranges of one instance.
class DrawnRanges {
 public:
  explicit DrawnRanges(gpu::uint most) : most_(most) {}

  void add(gpu::uint first, gpu::uint count) {
    if (count == 0) return;
    if (!ranges_.empty() && (ranges_.size() == most_ || ranges_.back().first + ranges_.back().count == first)) {
      ranges_.back().count = first + count - ranges_.back().first;
      return;
    }
    ranges_.push_back({first, count});
  }

  struct Range {
    gpu::uint first;
    gpu::uint count;
  };
  const std::vector<Range>& all() const { return ranges_; }

  std::uint64_t triangles() const {
    std::uint64_t indices = 0;
    for (const Range& range : ranges_)
      indices += range.count;
    return indices / 3;
  }

 private:
  std::size_t most_;
  std::vector<Range> ranges_;
};

/// What a level is tested with.
struct Tested {
  const gpu::CullView& view;
  gpu::uint test;
  const gpu::Transform& transform;
  const gpu::FaceLod& lod;
};

/// The tests of one level of one instance.
class GroupTest {
 public:
  explicit GroupTest(const Tested& tested)
      : tested_(tested),
        frame_(faceFrame(tested.view, tested.transform, tested.lod)),
        rays_(sectorOf(tested.view, frame_, tested.lod)) {}

  bool isBack(const gpu::FaceNode& node) const {
    float slack = tested_.test == gpu::kFacesMask   ? sectorLeast(node, rays_)
                  : tested_.test == gpu::kFacesCone ? coneSlack(node, frame_.eye)
                                                    : clusterSlack(node, frame_.eye);
    if (!(slack > 0.0F)) return false;
    const FaceMargin margin = faceMargin(tested_.view, frame_, tested_.transform, node);
    if (tested_.test == gpu::kFacesMask)
      slack = margin.farthest * (slack / gpu::kCubeDiagonal - frame_.roundObject / margin.nearest);
    return slack > margin.least;
  }

  /// Whether no triangle is a back face, by the culling volume.
  bool isFront(const gpu::FaceNode& node) const {
    return -supportOf(node, frame_.eye.w * xyz(node.origin) - xyz(frame_.eye)) > node.highest.w * frame_.eye.w;
  }

 private:
  const Tested& tested_;
  FaceFrame frame_;
  Sector rays_;
};

void addGroups(const scene::FaceTables& faces, const Tested& tested, DrawnRanges& ranges) {
  const GroupTest test(tested);
  const bool tree = tested.test == gpu::kFacesTree;
  for (gpu::uint n = tested.lod.firstNode; n < tested.lod.firstNode + tested.lod.nodeCount;) {
    const gpu::FaceNode& node = faces.nodes[n];
    const bool group = node.next == n + 1;
    if ((group || tree) && test.isBack(node)) {
      n = node.next;
    } else if (group || (tree && test.isFront(node))) {
      ranges.add(node.firstIndex, node.indexCount);
      n = node.next;
    } else {
      ++n;
    }
  }
}

}  // namespace

FaceFrame faceFrame(const gpu::CullView& view, const gpu::Transform& t, const gpu::FaceLod& lod) {
  const vec3 r0 = xyz(t.worldFromObject0);
  const vec3 r1 = xyz(t.worldFromObject1);
  const vec3 r2 = xyz(t.worldFromObject2);
  const vec3 c0 = glm::cross(r1, r2);
  const vec3 c1 = glm::cross(r2, r0);
  const vec3 c2 = glm::cross(r0, r1);
  const float determinant = glm::dot(r0, c0);
  const vec3 moved(t.worldFromObject0.w, t.worldFromObject1.w, t.worldFromObject2.w);
  const bool parallel = view.forwardWorld.w != 0.0F;
  const vec3 forward = xyz(view.forwardWorld);
  const vec3 eyeWorld = xyz(view.cameraWorld);
  const vec3 from = parallel ? -forward : eyeWorld - moved;
  FaceFrame frame;
  frame.eye = vec4((c0 * from.x + c1 * from.y + c2 * from.z) / determinant, parallel ? 0.0F : 1.0F);
  frame.depth = vec4(r0 * forward.x + r1 * forward.y + r2 * forward.z, glm::dot(moved - eyeWorld, forward));
  const vec3 mixed = glm::abs(vec3(glm::dot(r0, r1), glm::dot(r1, r2), glm::dot(r2, r0)));
  const vec3 rows(glm::dot(r0, r0) + mixed.x + mixed.z, glm::dot(r1, r1) + mixed.x + mixed.y,
                  glm::dot(r2, r2) + mixed.y + mixed.z);
  frame.scale = std::sqrt(std::max(std::max(rows.x, rows.y), rows.z));
  frame.volume = std::abs(determinant);
  const float inverseScale = std::sqrt(glm::dot(c0, c0) + glm::dot(c1, c1) + glm::dot(c2, c2)) / frame.volume;
  const float extent = glm::length(xyz(lod.boundsMinObject)) + glm::length(xyz(lod.boundsMaxObject));
  const float away = glm::length(eyeWorld) + glm::length(moved);
  frame.roundWorld = 2.0F * gpu::kRounding * (frame.scale * extent + away);
  frame.roundObject = gpu::kRounding * (inverseScale * (parallel ? 1.0F : away) + glm::length(xyz(frame.eye)) + extent);
  return frame;
}

FaceMargin faceMargin(const gpu::CullView& view, const FaceFrame& frame, const gpu::Transform& t,
                      const gpu::FaceNode& node) {
  const bool parallel = view.forwardWorld.w != 0.0F;
  const vec4 middle(xyz(node.sphere), 1.0F);
  const float depth = glm::dot(frame.depth, middle);
  const float reach = glm::length(xyz(frame.depth)) * node.sphere.w + frame.roundWorld;
  FaceMargin margin{parallel ? 1.0F : depth - reach, parallel ? 1.0F : depth + reach, gpu::kFaceNever};
  if (!(depth - reach > view.cameraWorld.w)) return margin;
  float slant = 1.0F;
  if (!parallel) {
    const vec3 world(glm::dot(t.worldFromObject0, middle), glm::dot(t.worldFromObject1, middle),
                     glm::dot(t.worldFromObject2, middle));
    const float away = glm::distance(world, xyz(view.cameraWorld));
    const float cosine = std::min(depth / away, 1.0F);
    const float sine = (frame.scale * node.sphere.w + frame.roundWorld) / away;
    if (!(sine < 1.0F)) return margin;
    slant = cosine * std::sqrt(1.0F - sine * sine) - std::sqrt(1.0F - cosine * cosine) * sine;
    if (!(slant > 0.0F)) return margin;
    slant = 1.0F / slant;
  }
  const float moved = gpu::kSnapPixels + view.focalPixels * slant / margin.nearest * frame.roundWorld;
  const float pixels = view.focalPixels * node.inradius;
  const float share = moved * margin.farthest / pixels;
  margin.least = share * margin.farthest / frame.volume * (frame.scale * slant + 0.25F * share) + frame.roundObject;
  return margin;
}

FaceCommands cullFaces(const scene::FaceTables& faces, std::span<const gpu::Transform> transforms,
                       const gpu::CullView& view, const gpu::FaceView& faceView,
                       std::span<const FaceInstance> instances) {
  FaceCommands result;
  for (gpu::uint i = 0; i < instances.size(); ++i) {
    const gpu::FaceUnit& unit = faces.units[instances[i].unit];
    const gpu::FaceLod& lod = faces.lods[unit.firstLod + instances[i].bin / 2];
    const gpu::uint list = instances[i].bin % 2 != 0 ? gpu::kListSheet : gpu::kListSolid;
    DrawnRanges ranges(faceView.mostRanges);
    if (lod.nodeCount > 0) {
      addGroups(faces, {view, faceView.test, transforms[unit.transform], lod}, ranges);
      result.tested += lod.solidCount / 3;
      result.culled += lod.solidCount / 3 - ranges.triangles();
    } else {
      ranges.add(lod.firstIndex, lod.solidCount);
      result.whole += lod.solidCount / 3;
    }
    result.whole += lod.sheetCount / 3;
    for (const DrawnRanges::Range& range : ranges.all())
      result.commands[list].push_back({range.count, 1, range.first, lod.baseVertex, i});
    if (lod.sheetCount > 0)
      result.commands[gpu::kListSheet].push_back(
          {lod.sheetCount, 1, lod.firstIndex + lod.solidCount, lod.baseVertex, i});
  }
  return result;
}

std::vector<gpu::DrawCommand> sliceFaces(const scene::FaceTables& faces, std::span<const gpu::Transform> transforms,
                                         const gpu::CullView& view, const gpu::FaceView& faceView,
                                         std::span<const std::optional<FaceInstance>> places) {
  const std::size_t each = faceView.mostRanges + 1;
  std::vector<gpu::DrawCommand> result(2 * places.size() * each);
  for (std::size_t place = 0; place < places.size(); ++place) {
    if (!places[place]) continue;
    const FaceCommands own = cullFaces(faces, transforms, view, faceView, {&*places[place], 1});
    for (const gpu::uint list : {gpu::kListSolid, gpu::kListSheet}) {
      std::size_t at = (list * places.size() + place) * each;
      for (gpu::DrawCommand command : own.commands[list]) {
        command.baseInstance = static_cast<gpu::uint>(place);
        result[at++] = command;
      }
    }
  }
  return result;
}

}  // namespace jalousie::visibility
