// glTF models and PLY texts of procedural meshes.
#include "support/scene_writer.h"

#include "asset/accessor.h"

namespace jalousie::test {

tinygltf::Model emptyModel() {
  tinygltf::Model model;
  model.asset.version = "2.0";
  model.scenes.emplace_back();
  model.defaultScene = 0;
  return model;
}

int addMesh(tinygltf::Model& model, const asset::Primitive& mesh) {
  tinygltf::Primitive primitive;
  primitive.mode = TINYGLTF_MODE_TRIANGLES;
  primitive.attributes["POSITION"] = asset::appendVec3(model, mesh.positions, TINYGLTF_TARGET_ARRAY_BUFFER);
  primitive.attributes["NORMAL"] = asset::appendVec3(model, mesh.normals, TINYGLTF_TARGET_ARRAY_BUFFER);
  primitive.indices = asset::appendIndices(model, mesh.indices);
  model.meshes.emplace_back();
  model.meshes.back().primitives.push_back(primitive);
  return static_cast<int>(model.meshes.size()) - 1;
}

int addMeshNode(tinygltf::Model& model, int mesh, const glm::dvec3& translation, double scale) {
  tinygltf::Node node;
  node.mesh = mesh;
  node.translation = {translation.x, translation.y, translation.z};
  if (scale != 1.0) node.scale = {scale, scale, scale};
  model.nodes.push_back(node);
  return static_cast<int>(model.nodes.size()) - 1;
}

std::string plyText(const asset::Primitive& mesh) {
  std::string text = "ply\nformat ascii 1.0\nelement vertex " + std::to_string(mesh.positions.size()) +
                     "\nproperty float x\nproperty float y\nproperty float z\nelement face " +
                     std::to_string(mesh.indices.size() / 3) + "\nproperty list uchar int vertex_indices\nend_header\n";
  for (const glm::vec3& p : mesh.positions)
    text += std::to_string(p.x) + " " + std::to_string(p.y) + " " + std::to_string(p.z) + "\n";
  for (std::size_t t = 0; t < mesh.indices.size(); t += 3)
    text += "3 " + std::to_string(mesh.indices[t]) + " " + std::to_string(mesh.indices[t + 1]) + " " +
            std::to_string(mesh.indices[t + 2]) + "\n";
  return text;
}

}  // namespace jalousie::test
