// Helpers of the asset tests: private folders, GLB files from JSON text, small models, error codes.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cstddef>
#include <cstring>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "asset/accessor.h"
#include "asset/gltf_file.h"
#include "core/error.h"
#include "core/file.h"
#include "support/error_code.h"

namespace jalousie::test {

/// A new folder that disappears with its owner.
class TempFolder {
 public:
  TempFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "jalousie-test-XXXXXX").string();
    const char* made = ::mkdtemp(pattern.data());
    if (made == nullptr) throw std::runtime_error("no temporary folder");
    path_ = made;
  }
  ~TempFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TempFolder(const TempFolder&) = delete;
  TempFolder& operator=(const TempFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path operator/(std::string_view name) const { return path_ / name; }
  std::filesystem::path write(std::string_view name, std::string_view text) const {
    writeFileAtomic(path_ / name, text);
    return path_ / name;
  }

 private:
  std::filesystem::path path_;
};

inline void appendWord(std::string& out, std::uint32_t value) {
  std::array<char, 4> bytes{};
  std::memcpy(bytes.data(), &value, 4);
  out.append(bytes.data(), 4);
}

/// A GLB 2.0 file with the given JSON and binary chunk (none if empty).
inline std::string glb(std::string json, std::string binary = {}, std::uint32_t version = 2) {
  json.resize((json.size() + 3) / 4 * 4, ' ');
  binary.resize((binary.size() + 3) / 4 * 4, '\0');
  std::string out = "glTF";
  appendWord(out, version);
  appendWord(out, static_cast<std::uint32_t>(20 + json.size() + (binary.empty() ? 0 : 8 + binary.size())));
  appendWord(out, static_cast<std::uint32_t>(json.size()));
  out += "JSON" + json;
  if (!binary.empty()) {
    appendWord(out, static_cast<std::uint32_t>(binary.size()));
    out += std::string("BIN\0", 4) + binary;
  }
  return out;
}

/// Adds a mesh of one primitive: the unit triangle in z = 0, moved by offset.
inline int addTriangle(tinygltf::Model& model, const glm::vec3& offset = glm::vec3(0.0F)) {
  const std::vector<glm::vec3> positions = {offset, offset + glm::vec3(1, 0, 0), offset + glm::vec3(0, 1, 0)};
  const std::vector<glm::vec3> normals(3, glm::vec3(0, 0, 1));
  const std::vector<std::uint32_t> indices = {0, 1, 2};
  tinygltf::Primitive primitive;
  primitive.mode = TINYGLTF_MODE_TRIANGLES;
  primitive.attributes["POSITION"] = asset::appendVec3(model, positions, TINYGLTF_TARGET_ARRAY_BUFFER);
  primitive.attributes["NORMAL"] = asset::appendVec3(model, normals, TINYGLTF_TARGET_ARRAY_BUFFER);
  primitive.indices = asset::appendIndices(model, indices);
  tinygltf::Mesh mesh;
  mesh.name = "triangle";
  mesh.primitives.push_back(primitive);
  model.meshes.push_back(mesh);
  return static_cast<int>(model.meshes.size()) - 1;
}

/// Adds a node; it is in no scene yet.
inline int addNode(tinygltf::Model& model, int mesh, const std::string& name = {}) {
  tinygltf::Node node;
  node.mesh = mesh;
  node.name = name;
  model.nodes.push_back(node);
  return static_cast<int>(model.nodes.size()) - 1;
}

inline void setScene(tinygltf::Model& model, std::vector<int> nodes) {
  tinygltf::Scene scene;
  scene.nodes = std::move(nodes);
  model.scenes = {scene};
  model.defaultScene = 0;
}

}  // namespace jalousie::test
