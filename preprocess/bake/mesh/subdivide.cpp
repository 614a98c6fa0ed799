// Uses OpenMesh for the topology and Loop's scheme. Rejected faces are counted; OpenMesh's messages are suppressed.
#include "bake/mesh/subdivide.h"

#include <fmt/format.h>

#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Core/System/omstream.hh>
#include <OpenMesh/Tools/Subdivider/Uniform/LoopT.hh>
#include <algorithm>
#include <vector>

#include "bake/mesh/normals.h"
#include "bake/mesh/weld.h"
#include "core/error.h"

namespace jalousie::bake {
namespace {

struct Traits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;  // the subdivider sums points as normals
};
using TopologyMesh = OpenMesh::TriMesh_ArrayKernelT<Traits>;

/// Suppresses the messages of OpenMesh during its lifetime.
class Quiet {
 public:
  Quiet() {
    omerr().disable();
    omlog().disable();
  }
  ~Quiet() { omerr().enable(); }
  Quiet(const Quiet&) = delete;
  Quiet& operator=(const Quiet&) = delete;
};

/// Faces in OpenMesh, which takes three different vertices each: cleaned triangles have no other.
TopologyMesh makeTopology(const CombinedMesh& mesh) {
  const std::vector<std::uint32_t> welded = weldByPosition(mesh.positions);
  std::vector<TopologyMesh::VertexHandle> handles(mesh.positions.size());
  TopologyMesh topology;
  std::size_t rejected = 0;
  for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
    std::vector<TopologyMesh::VertexHandle> corners;
    for (std::size_t k = 0; k < 3; ++k) {
      const std::uint32_t id = welded[mesh.indices[t + k]];
      const glm::vec3& p = mesh.positions[id];
      if (!handles[id].is_valid()) handles[id] = topology.add_vertex(OpenMesh::Vec3d(p.x, p.y, p.z));
      corners.push_back(handles[id]);
    }
    rejected += topology.add_face(corners).is_valid() ? 0 : 1;
  }
  if (rejected > 0) {
    throw Error(
        ErrorCode::kUnsupported,
        fmt::format(
            "--subdivide needs a manifold mesh; {} of {} faces are not manifold: repair the mesh or omit the option",
            rejected, mesh.indices.size() / 3));
  }
  return topology;
}

/// Largest number of edges at a vertex; subdivision makes none with more, but six.
std::size_t mostEdges(const TopologyMesh& topology) {
  std::size_t most = 6;
  for (const auto vertex : topology.vertices())
    most = std::max(most, static_cast<std::size_t>(topology.valence(vertex)));
  return most;
}

}  // namespace

void subdivideMesh(CombinedMesh& mesh, std::uint32_t steps) {
  if (steps == 0) return;
  if (mesh.primitives.size() != 1) throw Error(ErrorCode::kUnsupported, "--subdivide needs a mesh of one primitive");
  for (const Attribute& attribute : mesh.primitives[0].attributes)
    if (attribute.name != "POSITION" && attribute.name != "NORMAL")
      throw Error(ErrorCode::kUnsupported, "--subdivide cannot interpolate " + attribute.name + "; omit the option");
  if (!mesh.sourceVertex.empty())
    throw Error(ErrorCode::kUnsupported, "--subdivide cannot interpolate attributes of integers; omit the option");
  if (mesh.indices.size() / 3 > (1ULL << 26U) >> (2 * steps))
    throw Error(ErrorCode::kLimit, "--subdivide would make more than 67 million triangles");

  const Quiet quiet;
  TopologyMesh topology = makeTopology(mesh);
  OpenMesh::Subdivider::Uniform::LoopT<TopologyMesh, double> loop;
  loop.init_weights(mostEdges(topology) + 1);  // it reads beyond its table of 50 without a word
  loop.attach(topology);
  loop(steps);
  loop.detach();

  mesh.positions.clear();
  for (const auto vertex : topology.vertices()) {
    const OpenMesh::Vec3d& p = topology.point(vertex);
    mesh.positions.emplace_back(p[0], p[1], p[2]);
  }
  mesh.indices.clear();
  for (const auto face : topology.faces())
    for (const auto vertex : face.vertices())
      mesh.indices.push_back(static_cast<std::uint32_t>(vertex.idx()));
  mesh.primitiveOf.assign(mesh.positions.size(), 0);
  const std::vector<glm::vec3> normals = smoothNormals(mesh.positions, mesh.indices);
  PrimitiveData& data = mesh.primitives[0];
  data.vertexCount = static_cast<std::uint32_t>(mesh.positions.size());
  data.attributes = {{"POSITION", 3, {}}, {"NORMAL", 3, {}}};
  for (std::size_t v = 0; v < mesh.positions.size(); ++v) {
    for (int k = 0; k < 3; ++k) {
      data.attributes[0].values.push_back(mesh.positions[v][k]);
      data.attributes[1].values.push_back(normals[v][k]);
    }
  }
}

}  // namespace jalousie::bake
