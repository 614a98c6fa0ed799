// A shadow holds exactly what its occluder hides; measures keep their order; the slips of the paper lose pixels.
#include "culling/shadow.h"

#include <gtest/gtest.h>

#include <cmath>

#include "culling/random_solids.h"

namespace jalousie::culling {
namespace {

constexpr int kPoints = 400;
constexpr double kSlack = 1e-9;  ///< object space; points nearer to the border of a shadow belong to either side

struct Scene {
  ConvexSolid solid;
  glm::dmat4 worldFromObject;
  Viewpoint view;
};

Viewpoint randomViewpoint(Random& random) {
  const glm::dvec3 eye(randomVector(random, 8.0F));
  return {eye, glm::normalize(glm::dvec3(randomVector(random, 1.0F)) + glm::dvec3(0.0, 0.0, 1.2)),
          random.below(4) == 0};
}

Scene randomScene(Random& random, bool planar) {
  ConvexSolid solid = planar ? polygon(3 + random.below(5), random.below(2) == 0) : randomSolid(random);
  const glm::dmat4 matrix = randomTransform(random);
  return {std::move(solid), matrix, randomViewpoint(random)};
}

/// By the definition, object space. @param slack  by which the solid is larger
bool isHidden(const Scene& scene, const glm::dvec3& point, double slack) {
  const glm::dmat4 objectFromWorld = glm::inverse(scene.worldFromObject);
  const auto toObject = [&](const glm::dvec3& p) { return glm::dvec3(objectFromWorld * glm::dvec4(p, 1.0)); };
  const glm::dvec3 eye = scene.view.parallel ? point - 1e3 * scene.view.direction : scene.view.point;
  if (scene.solid.isPolygon() && !scene.solid.bothSides && !(toObject(eye).z > slack)) return false;
  if (meets(scene.solid, toObject(eye), toObject(eye), slack)) return false;  // from within
  return meets(scene.solid, toObject(eye), toObject(point), slack);
}

bool isInside(const std::vector<ShadowPlane>& planes, const glm::dvec3& point) {
  return std::all_of(planes.begin(), planes.end(), [&](const ShadowPlane& p) { return p.distanceTo(point) < 0.0; });
}

/// How the points around an occluder lie to its shadow.
struct Agreement {
  std::uint64_t hidden = 0;
  std::uint64_t missed = 0;  ///< hidden, and outside of the shadow
  std::uint64_t wrong = 0;   ///< in the shadow, and not hidden
};

/// @param outward  by which the planes are moved, world units
Agreement compare(std::uint64_t seed, bool planar, Cap cap, double outward = 0.0) {
  Random random(seed);
  Agreement agreement;
  for (int i = 0; i < 500; ++i) {
    const Scene scene = randomScene(random, planar);
    WorldOccluder occluder;
    const OccluderShape shape(scene.solid);
    occluder.place(shape, scene.worldFromObject);
    std::vector<ShadowPlane> planes;
    const bool casts = castShadow(occluder, scene.view, cap, planes);
    for (ShadowPlane& plane : planes)
      plane.offset += outward;
    EXPECT_LE(planes.size(), kMostShadowPlanes);
    for (int k = 0; k < kPoints; ++k) {
      const glm::dvec3 point(randomVector(random, 10.0F));
      const bool hidden = isHidden(scene, point, -kSlack);
      const bool inside = casts && isInside(planes, point);
      agreement.hidden += hidden ? 1 : 0;
      agreement.missed += hidden && !inside ? 1 : 0;
      agreement.wrong += inside && !isHidden(scene, point, kSlack) ? 1 : 0;
    }
  }
  return agreement;
}

TEST(Shadow, OfASolidIsExactlyWhatItHides) {
  const Agreement agreement = compare(1, /*planar=*/false, Cap::kExact);
  EXPECT_GT(agreement.hidden, 5000U);
  EXPECT_EQ(agreement.wrong, 0U);
  EXPECT_EQ(agreement.missed, 0U);
}

TEST(Shadow, OfAPolygonIsExactlyWhatItHides) {
  const Agreement agreement = compare(2, /*planar=*/true, Cap::kExact);
  EXPECT_GT(agreement.hidden, 500U);
  EXPECT_EQ(agreement.wrong, 0U);
  EXPECT_EQ(agreement.missed, 0U);
}

TEST(Shadow, PlanesThatAreOffByALittleAreNoticed) {
  EXPECT_GT(compare(1, /*planar=*/false, Cap::kExact, 1e-3).wrong, 0U);
  EXPECT_GT(compare(2, /*planar=*/true, Cap::kExact, 1e-3).wrong, 0U);
  EXPECT_GT(compare(1, /*planar=*/false, Cap::kExact, -1e-3).missed, 0U);
}

TEST(Shadow, ThePapersCapHidesLessAndNothingWrong) {
  const Agreement agreement = compare(1, /*planar=*/false, Cap::kPaper);
  EXPECT_EQ(agreement.wrong, 0U);
  const double given = static_cast<double>(agreement.missed) / static_cast<double>(agreement.hidden);
  EXPECT_GT(given, 0.03);
  EXPECT_LT(given, 0.4);
}

/// The paper's cap goes through the silhouette point that is "furthest"; taken as a distance from the eye, it stands in
/// front of parts of the silhouette.
TEST(Shadow, ThePapersCapThroughTheMostDistantPointHidesWhatIsInFront) {
  ConvexSolid thin;
  thin.vertices = {{10, 0, -1}, {0, 0.5F, -9.5F}, {0, -0.5F, -9.5F}, {10, 0, -1.01F}};
  thin.faces = {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}};
  ASSERT_EQ(faultOf(thin), std::nullopt);
  const OccluderShape shape(thin);
  WorldOccluder occluder;
  occluder.place(shape, glm::dmat4(1.0));
  const Viewpoint view;
  const glm::dvec3 point(0.1, 0.0, -7.0);
  ASSERT_FALSE(meets(thin, view.point, point, kSlack));
  std::vector<ShadowPlane> planes;
  ASSERT_TRUE(castShadow(occluder, view, Cap::kPaper, planes));
  EXPECT_FALSE(isInside(planes, point));
  planes[0].offset = glm::dot(planes[0].normal, glm::dvec3(10, 0, -1));  // as printed
  EXPECT_TRUE(isInside(planes, point));
}

/// Equation 1 has "at most 0": each edge of a face that is seen edge-on would count as silhouette, its far ones, too.
TEST(Shadow, AFaceSeenEdgeOnAddsNoEdges) {
  const OccluderShape shape(solidOf({glm::vec3(-1.0F), glm::vec3(1.0F)}));
  WorldOccluder occluder;
  occluder.place(shape, glm::dmat4(1.0));
  std::vector<ShadowPlane> planes;
  ASSERT_TRUE(castShadow(occluder, {{1.0, 0.0, 5.0}}, Cap::kExact, planes));
  EXPECT_EQ(planes.size(), 1U + 4U) << "one face and its edges";
  for (const glm::dvec3& eye : {glm::dvec3(3, 4, 5), glm::dvec3(-3, 0, 5), glm::dvec3(0, 0.5, 5)}) {
    ASSERT_TRUE(castShadow(occluder, {eye}, Cap::kExact, planes));
    EXPECT_LE(planes.size(), 3U + 6U);
  }
}

TEST(Shadow, FromWithinASolidThereIsNone) {
  Random random(5);
  const OccluderShape shape(prism(6));
  for (int i = 0; i < 100; ++i) {
    const glm::dmat4 matrix = randomTransform(random);
    WorldOccluder occluder;
    occluder.place(shape, matrix);
    std::vector<ShadowPlane> planes;
    const glm::dvec3 inside(matrix * glm::dvec4(glm::dvec3(randomVector(random, 0.4F)), 1.0));
    EXPECT_FALSE(castShadow(occluder, {inside}, Cap::kExact, planes));
  }
}

TEST(Shadow, ASingularTransformHidesNothing) {
  const OccluderShape shape(prism(5));
  WorldOccluder occluder;
  occluder.place(shape, glm::scale(glm::dmat4(1.0), glm::dvec3(1.0, 0.0, 1.0)));
  std::vector<ShadowPlane> planes;
  EXPECT_FALSE(castShadow(occluder, {{0, 3, 0}}, Cap::kExact, planes));
  EXPECT_EQ(solidAngle(occluder, {{0, 3, 0}}), 0.0);
}

TEST(Shadow, ABoxIsHiddenIfItsCornersAre) {
  Random random(8);
  int fully = 0;
  for (int i = 0; i < 400; ++i) {
    const Scene scene = randomScene(random, /*planar=*/false);
    const OccluderShape shape(scene.solid);
    WorldOccluder occluder;
    occluder.place(shape, scene.worldFromObject);
    std::vector<ShadowPlane> planes;
    if (!castShadow(occluder, scene.view, Cap::kExact, planes)) continue;
    for (int k = 0; k < 50; ++k) {
      const glm::vec3 low = randomVector(random, 8.0F);
      const Aabb box{low, low + glm::vec3(random.uniform(0.01F, 0.5F))};
      std::uint64_t tests = 0;
      const Shaded shaded = shadedBy(planes, box, tests);
      EXPECT_LE(tests, planes.size());
      int inside = 0;
      for (int corner = 0; corner < 8; ++corner)
        inside += isInside(planes, glm::mix(glm::dvec3(box.min), glm::dvec3(box.max),
                                            glm::dvec3(corner & 1, corner >> 1 & 1, corner >> 2)))
                      ? 1
                      : 0;
      EXPECT_EQ(shaded == Shaded::kFully, inside == 8);
      EXPECT_FALSE(shaded == Shaded::kNot && inside > 0);
      fully += shaded == Shaded::kFully ? 1 : 0;
    }
  }
  EXPECT_GT(fully, 100);
}

/// The measure of each face as a polygon of its own.
std::vector<double> measuresOfFaces(const Scene& scene, bool bothSides,
                                    double (*measure)(const WorldOccluder&, const Viewpoint&)) {
  std::vector<double> measures;
  for (const std::vector<std::uint32_t>& corners : scene.solid.faces) {
    ConvexSolid face;
    face.bothSides = bothSides;
    face.faces.emplace_back();
    for (const std::uint32_t corner : corners) {
      face.faces[0].push_back(static_cast<std::uint32_t>(face.vertices.size()));
      face.vertices.push_back(scene.solid.vertices[corner]);
    }
    const OccluderShape shape(face);
    WorldOccluder occluder;
    occluder.place(shape, scene.worldFromObject);
    measures.push_back(measure(occluder, scene.view));
  }
  return measures;
}

TEST(Rank, NoFaceOutranksItsSolidAndBackFacesCoverTheSame) {
  Random random(9);
  for (int i = 0; i < 400; ++i) {
    Scene scene = randomScene(random, /*planar=*/false);
    const OccluderShape shape(scene.solid);
    WorldOccluder occluder;
    occluder.place(shape, scene.worldFromObject);
    const double whole = solidAngle(occluder, scene.view);
    double front = 0.0;
    double all = 0.0;
    for (const double measure : measuresOfFaces(scene, false, solidAngle)) {
      EXPECT_LE(measure, whole * (1.0 + 1e-9));
      front += measure;
    }
    for (const double measure : measuresOfFaces(scene, true, solidAngle))
      all += measure;
    std::vector<ShadowPlane> planes;
    if (!castShadow(occluder, scene.view, Cap::kExact, planes)) continue;  // from within
    EXPECT_NEAR(front, whole, 1e-9 * (1.0 + whole));
    EXPECT_NEAR(all, 2.0 * whole, 1e-6 * (1.0 + whole));
  }
}

TEST(Rank, TheBoundOfASphereHolds) {
  Random random(10);
  for (int i = 0; i < 1000; ++i) {
    const Scene scene = randomScene(random, random.below(2) == 0);
    const OccluderShape shape(scene.solid);
    WorldOccluder occluder;
    occluder.place(shape, scene.worldFromObject);
    const Aabb& box = occluder.boundsWorld();
    const glm::dvec3 center(box.center());
    const double radius = 0.5 * double{box.diagonal()} + 1e-6;
    EXPECT_LE(solidAngle(occluder, scene.view), solidAngleBound(center, radius, scene.view) * (1.0 + 1e-9));
  }
}

/// A cube of edge 1, its near face five edges away, and that face.
struct CubeAndFace {
  double cube;
  double face;
};
CubeAndFace rankCubeAndFace(double scale, double (*measure)(const WorldOccluder&, const Viewpoint&)) {
  const Scene scene{
      solidOf({{-0.5F, -0.5F, -6.0F}, {0.5F, 0.5F, -5.0F}}), glm::scale(glm::dmat4(1.0), glm::dvec3(scale)), {}};
  const OccluderShape shape(scene.solid);
  WorldOccluder cube;
  cube.place(shape, scene.worldFromObject);
  const std::vector<double> faces = measuresOfFaces(scene, false, measure);
  return {measure(cube, scene.view), *std::max_element(faces.begin(), faces.end())};
}

TEST(Rank, ThePapersMeasuresChangeTheirOrderWithTheScale) {
  const CubeAndFace one = rankCubeAndFace(1.0, paperRank);
  const CubeAndFace ten = rankCubeAndFace(10.0, paperRank);
  EXPECT_NEAR(one.cube, 0.006, 1e-4);
  EXPECT_NEAR(ten.cube, one.cube, 1e-9);
  EXPECT_NEAR(one.face, 0.2, 1e-9);
  EXPECT_NEAR(ten.face, 2.0, 1e-9);
  EXPECT_GT(one.face, one.cube) << "though the cube hides more";
  EXPECT_NEAR(rankCubeAndFace(0.01, paperRank).face, 0.002, 1e-9) << "and less than the cube in a small scene";
  const CubeAndFace angle = rankCubeAndFace(1.0, solidAngle);
  EXPECT_NEAR(rankCubeAndFace(10.0, solidAngle).cube, angle.cube, 1e-9);
  EXPECT_NEAR(angle.face, angle.cube, 1e-9) << "from the front the cube covers what its face does";
}

TEST(ConvexSolid, BoxesPrismsAndPolygonsHaveNoFault) {
  Random random(4);
  EXPECT_EQ(faultOf(solidOf({{1, 2, 3}, {4, 5, 9}})), std::nullopt);
  for (std::uint32_t corners = 3; corners < 12; ++corners) {
    EXPECT_EQ(faultOf(prism(corners)), std::nullopt) << corners;
    EXPECT_EQ(faultOf(polygon(corners, false)), std::nullopt) << corners;
  }
}

TEST(ConvexSolid, FaultsAreFound) {
  const ConvexSolid good = prism(6);
  const auto broken = [&](const auto& breakIt) {
    ConvexSolid solid = good;
    breakIt(solid);
    return faultOf(solid).value_or("");
  };
  const auto has = [](const std::string& fault, const char* part) { return fault.find(part) != std::string::npos; };
  EXPECT_TRUE(has(broken([](ConvexSolid& s) { s.vertices[3].x = NAN; }), "not finite"));
  EXPECT_TRUE(has(broken([](ConvexSolid& s) { s.faces[0][1] = 99; }), "does not exist"));
  EXPECT_TRUE(has(broken([](ConvexSolid& s) { s.faces[0][1] = s.faces[0][0]; }), "different corners"));
  EXPECT_TRUE(has(broken([](ConvexSolid& s) { s.faces.pop_back(); }), "not closed"));
  EXPECT_TRUE(has(broken([](ConvexSolid& s) { s.faces.push_back(s.faces[0]); }), "twice"));
  EXPECT_TRUE(has(broken([](ConvexSolid& s) { s.vertices.emplace_back(0.0F); }), "without a face"));
  EXPECT_TRUE(has(broken([](ConvexSolid& s) { s.vertices[0] *= 0.2F; }), "flat"));
  EXPECT_TRUE(has(broken([](ConvexSolid& s) {
                    for (std::vector<std::uint32_t>& face : s.faces)
                      std::reverse(face.begin(), face.end());
                  }),
                  "not convex"));
  ConvexSolid star = polygon(8, true);
  star.vertices[2] *= 0.1F;
  EXPECT_TRUE(has(faultOf(star).value_or(""), "not convex"));
  ConvexSolid twice = polygon(5, true);  // a pentagram turns left everywhere
  twice.faces[0] = {0, 2, 4, 1, 3};
  EXPECT_NE(faultOf(twice), std::nullopt);
  EXPECT_NE(faultOf(ConvexSolid{}), std::nullopt);
}

}  // namespace
}  // namespace jalousie::culling
