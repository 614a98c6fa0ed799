// Uses small limits, so that fuzzing spends its time on new paths instead of large meshes.
#include "fuzz/exercise.h"

#include <tiny_gltf.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <optional>
#include <vector>

#include "asset/gltf_file.h"
#include "asset/gltf_quantize.h"
#include "asset/image_io.h"
#include "asset/scene_file.h"
#include "bake/io/bake_document.h"
#include "bake/io/import.h"
#include "bake/io/obj_reader.h"
#include "bake/io/ply_reader.h"
#include "bake/io/stl_reader.h"
#include "bake/io/surface_objects.h"
#include "bake/report/inspect.h"
#include "bake/report/report.h"
#include "core/check.h"
#include "core/error.h"

namespace jalousie::test {
namespace {

using Bytes = std::span<const std::byte>;

constexpr std::size_t kMaxBakedTriangles = 64;

asset::Limits smallLimits() {
  asset::Limits limits;
  limits.maxFileBytes = 1U << 20U;
  limits.maxJsonElements = 20'000;
  limits.maxAccessorElements = 1U << 16U;
  limits.maxEmptyElements = 1U << 12U;
  limits.maxInstances = 1U << 12U;
  limits.images.maxSide = 128;
  return limits;
}

/// A folder that holds nothing, for documents that look for files.
const std::filesystem::path& emptyFolder() {
  static const std::filesystem::path kFolder = [] {
    std::string name = (std::filesystem::temp_directory_path() / "jalousie-fuzz-XXXXXX").string();
    JAL_CHECK(::mkdtemp(name.data()) != nullptr);
    return std::filesystem::path(name);
  }();
  return kFolder;
}

void checkMesh(const bake::TriangleMesh& mesh) {
  for (const std::uint32_t index : mesh.indices)
    JAL_CHECK(index < mesh.positions.size());
  for (const glm::vec3& p : mesh.positions)
    JAL_CHECK((std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z)));
  JAL_CHECK((mesh.normals.empty() || mesh.normals.size() == mesh.positions.size()));
  JAL_CHECK((mesh.uvs.empty() || mesh.uvs.size() == mesh.positions.size()));
}

/// @param cells  of each primitive of the chain
void checkPrimitive(const asset::Primitive& primitive, std::size_t cells) {
  for (const std::uint32_t index : primitive.indices)
    JAL_CHECK(index < primitive.positions.size());
  JAL_CHECK(primitive.cellEnds.size() == cells);
  const std::uint64_t triangles = primitive.indices.size() / 3;
  if (!primitive.faceTree.empty()) JAL_CHECK(asset::faceTriangles(primitive.faceTree).value_or(~0ULL) == triangles);
  if (cells == 0) return;
  JAL_CHECK(std::is_sorted(primitive.cellEnds.begin(), primitive.cellEnds.end()));
  JAL_CHECK(primitive.cellEnds.back() == primitive.indices.size());
  for (const std::uint32_t end : primitive.cellEnds)
    JAL_CHECK(end % 3 == 0U);
}

void checkScene(const asset::SceneFile& scene) {
  for (const asset::Chain& chain : scene.chains) {
    const std::size_t cells = scene.meshes[chain.levels[0].mesh].primitives[0].cellEnds.size();
    for (const asset::LodLevel& level : chain.levels)
      for (const asset::Primitive& primitive : scene.meshes[level.mesh].primitives)
        checkPrimitive(primitive, cells);
  }
  for (const asset::Instance& instance : scene.instances)
    JAL_CHECK(instance.chain < scene.chains.size());
}

void checkBending(const asset::PrimitiveBending& bending, std::size_t vertices, const asset::SceneMotion& motion) {
  JAL_CHECK(bending.positions.size() == vertices);
  JAL_CHECK((bending.normals.empty() || bending.normals.size() == vertices));
  JAL_CHECK(bending.deltas.size() == bending.targets * vertices);
  for (const gpu::Influence& influence : bending.influences)
    JAL_CHECK(influence.joint < motion.joints.size());
  if (!bending.isSkinned) return;
  JAL_CHECK(bending.firstInfluence.size() == vertices + 1);
  JAL_CHECK(std::is_sorted(bending.firstInfluence.begin(), bending.firstInfluence.end()));
  JAL_CHECK(bending.firstInfluence.back() == bending.influences.size());
}

/// Every index that a kernel follows is in range.
void checkMotion(const asset::SceneFile& scene) {
  const asset::SceneMotion& motion = scene.motion;
  const auto isTrack = [&](gpu::uint track) { return track == gpu::kNoMotion || track < motion.tracks.size(); };
  const auto isNode = [&](gpu::uint node, std::size_t end) { return node == gpu::kNoMotion || node < end; };
  for (const gpu::MotionTrack& track : motion.tracks) {
    const std::uint64_t parts = track.interpolation == gpu::kMotionCubic ? 3 : 1;
    JAL_CHECK(track.keyCount > 0U);
    JAL_CHECK(std::uint64_t{track.firstTime} + track.keyCount <= motion.numbers.size());
    JAL_CHECK(track.firstValue + parts * track.keyCount * track.width <= motion.numbers.size());
  }
  for (std::size_t n = 0; n < motion.nodes.size(); ++n) {
    const gpu::MotionNode& node = motion.nodes[n];
    JAL_CHECK(isNode(node.anchor, n));
    JAL_CHECK((isTrack(node.translationTrack) && isTrack(node.rotationTrack) && isTrack(node.scaleTrack)));
  }
  for (const gpu::MotionWeight& weight : motion.weights)
    JAL_CHECK((weight.track == gpu::kNoMotion || weight.component < motion.tracks.at(weight.track).width));
  for (const gpu::MotionTarget& joint : motion.joints)
    JAL_CHECK(isNode(joint.node, motion.nodes.size()));
  for (const asset::Follower& follower : motion.instances)
    JAL_CHECK((follower.index < scene.instances.size() && follower.target.node < motion.nodes.size()));
  for (const asset::Follower& follower : motion.looseInstances)
    JAL_CHECK((follower.index < scene.looseInstances.size() && follower.target.node < motion.nodes.size()));
  for (const asset::MeshBending& mesh : motion.meshes) {
    const std::vector<asset::Primitive>& primitives = scene.meshes.at(mesh.mesh).primitives;
    JAL_CHECK(mesh.primitives.size() == primitives.size());
    for (std::size_t p = 0; p < primitives.size(); ++p) {
      checkBending(mesh.primitives[p], primitives[p].positions.size(), motion);
      JAL_CHECK(mesh.firstWeight + mesh.primitives[p].targets <= motion.weights.size());
    }
  }
}

/// What was accepted can be written, and what was written is accepted.
void checkRoundTrip(tinygltf::Model model, bool compress) {
  std::vector<std::byte> encoded;
  try {
    encoded = asset::encodeGlb(std::move(model), {compress});
  } catch (const Error&) {
    return;
  }
  try {
    asset::parseGltf(encoded, emptyFolder() / "encoded.glb");
  } catch (const Error& error) {
    const std::string reason = error.what();
    JAL_CHECK(reason == "");
  }
}

/// Bytes taken from the front of an input, zeros when it is used up.
class Reader {
 public:
  explicit Reader(Bytes bytes) : bytes_(bytes) {}
  std::uint8_t byte() {
    if (bytes_.empty()) return 0;
    const auto value = static_cast<std::uint8_t>(bytes_.front());
    bytes_ = bytes_.subspan(1);
    return value;
  }
  Bytes rest() const { return bytes_; }

 private:
  Bytes bytes_;
};

/// Triangles on a small grid: many shared, degenerate, non-manifold and flat ones.
std::string gridMesh(Reader& reader) {
  std::string vertices;
  const unsigned count = 3 + reader.byte() % 30U;
  for (unsigned v = 0; v < count; ++v) {
    const unsigned place = reader.byte();
    vertices += "v " + std::to_string(place & 7U) + " " + std::to_string((place >> 3U) & 7U) + " " +
                std::to_string(place >> 6U) + "\n";
  }
  std::string faces;
  for (std::size_t t = 0; t < kMaxBakedTriangles && !reader.rest().empty(); ++t) {
    faces += "f";
    for (int k = 0; k < 3; ++k)
      faces += " " + std::to_string(1 + reader.byte() % count);
    faces += "\n";
  }
  return vertices + faces;
}

std::string assembledGlb(Bytes bytes) {
  const auto* text = reinterpret_cast<const char*>(bytes.data());
  const std::size_t split = std::min(std::string_view(text, bytes.size()).find('\0'), bytes.size());
  std::string json(text, split);
  std::string binary(text + std::min(split + 1, bytes.size()), text + bytes.size());
  json.resize((json.size() + 3) / 4 * 4, ' ');
  binary.resize((binary.size() + 3) / 4 * 4, '\0');
  std::string out;
  const auto word = [&](std::uint32_t value) { out.append(reinterpret_cast<const char*>(&value), 4); };
  word(0x46546C67);
  word(2);
  word(static_cast<std::uint32_t>(28 + json.size() + binary.size()));
  word(static_cast<std::uint32_t>(json.size()));
  out += "JSON" + json;
  word(static_cast<std::uint32_t>(binary.size()));
  return out + std::string("BIN\0", 4) + binary;
}

Bytes bytesOf(const std::string& text) {
  return std::as_bytes(std::span(text.data(), text.size()));
}

std::uint64_t trianglesOf(const tinygltf::Model& model) {
  std::uint64_t corners = 0;
  for (const tinygltf::Mesh& mesh : model.meshes) {
    for (const tinygltf::Primitive& primitive : mesh.primitives) {
      if (primitive.indices >= 0) corners += model.accessors[static_cast<std::size_t>(primitive.indices)].count;
      for (const auto& [name, accessor] : primitive.attributes)
        corners += model.accessors[static_cast<std::size_t>(accessor)].count;
    }
  }
  return corners / 3;
}

bake::BakeOptions quickOptions() {
  bake::BakeOptions options;
  options.limits = smallLimits();
  options.chain.levels = 3;
  options.chain.samples = 100;
  options.chain.preset = bake::Preset::kDraft;
  options.cells = {8, false};  // small, so that small meshes have several
  options.faces = asset::FaceGrouping::kClusters;
  return options;
}

void bakeAndCheck(tinygltf::Model model, const bake::BakeOptions& options, bool quantize, bool compress) {
  if (trianglesOf(model) > kMaxBakedTriangles || model.nodes.size() > 200) return;
  const std::vector<bake::MeshReport> reports = bake::bakeDocument(model, options, [](auto, auto, const auto&) {});
  for (const bake::MeshReport& report : reports) {
    for (std::size_t k = 1; k < report.levels.size(); ++k) {
      JAL_CHECK(report.levels[k].triangles < report.levels[k - 1].triangles);
      JAL_CHECK(report.levels[k].errorObject >= report.levels[k - 1].errorObject);
    }
  }
  JAL_CHECK(bake::reportJson(reports).size() > bake::reportText(reports).size() / 100);
  if (quantize) asset::quantizeModel(model);
  bake::inspectText(bake::inspectModel(model));
  checkRoundTrip(std::move(model), compress);
}

}  // namespace

void exerciseGltf(Bytes bytes) {
  try {
    const std::filesystem::path path = emptyFolder() / "fuzz.glb";
    tinygltf::Model model = asset::parseGltf(bytes, path, smallLimits());
    bake::inspectModel(model);
    try {
      checkScene(asset::readScene(model, path, smallLimits()));
      const asset::SceneFile moving =
          asset::readScene(model, path, smallLimits(), {.check = {}, .seconds = {}, .plays = true});
      checkScene(moving);
      checkMotion(moving);
    } catch (const Error&) {
    }
    checkRoundTrip(std::move(model), !bytes.empty() && bytes.back() == std::byte{'c'});
  } catch (const Error&) {
  }
}

void exerciseAssembledGlb(Bytes bytes) {
  exerciseGltf(bytesOf(assembledGlb(bytes)));
}

void exerciseImage(Bytes bytes) {
  const asset::ImageLimits limits{.maxSide = 512, .maxPixels = 1U << 14U};
  bool isWhole = true;
  try {
    asset::checkImage(bytes, limits);
  } catch (const Error&) {
    isWhole = false;
  }
  try {
    const ImageRgba8 image = asset::decodeImage(bytes, limits);
    const asset::ImageSize size = asset::imageSize(bytes, limits);
    JAL_CHECK(isWhole);
    JAL_CHECK((size.width == image.width && size.height == image.height));
    JAL_CHECK((image.pixels == asset::decodeImage(asset::encodePng(image), limits).pixels));
  } catch (const Error&) {
    JAL_CHECK(!isWhole);
  }
}

void checkSurface(const bake::PolygonMesh& mesh, bake::NormalRule rule) {
  for (const bake::SurfaceObject& object : bake::buildObjects(mesh, rule))
    for (const bake::SurfacePart& part : object.parts)
      checkMesh(part.mesh);
}

void exercisePly(Bytes bytes) {
  bake::Notes notes;
  try {
    checkSurface(bake::readPly(bytes, "fuzz.ply", notes), bake::NormalRule::kNone);
  } catch (const Error&) {
  }
}

void exerciseStl(Bytes bytes) {
  bake::Notes notes;
  try {
    checkSurface(bake::readStl(bytes, "fuzz.stl", notes), bake::NormalRule::kCreases);
  } catch (const Error&) {
  }
}

void exerciseObj(Bytes bytes) {
  const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  const std::size_t split = text.find("\n%%\n");
  const Bytes materials = split == std::string_view::npos ? Bytes() : bytes.subspan(split + 4);
  const auto source = [&](const std::string&) {
    return std::optional(std::vector<std::byte>(materials.begin(), materials.end()));
  };
  bake::Notes notes;
  try {
    checkSurface(bake::parseObj(bytes.first(std::min(split, bytes.size())), "fuzz.obj", source, notes),
                 bake::NormalRule::kCreases);
  } catch (const Error&) {
  }
}

void exerciseBake(Bytes bytes) {
  Reader reader(bytes);
  const unsigned kind = reader.byte() % 4U;
  const unsigned bits = reader.byte();
  const unsigned more = reader.byte();
  bake::BakeOptions options = quickOptions();
  options.chain.preset = static_cast<bake::Preset>(bits % 3U);
  options.subdivide = (bits >> 2U) % 4U == 1U ? 1 : 0;
  if (((bits >> 4U) & 1U) != 0U) options.hardAngle = 40.0;
  options.chain.collapse.lockBorder = ((bits >> 5U) & 1U) != 0U;
  options.chain.ratio = 0.2 + 0.1 * (more % 8U);
  const bool quantize = ((bits >> 6U) & 1U) != 0U;
  const bool compress = ((bits >> 7U) & 1U) != 0U;
  try {
    const std::string made = kind == 3 ? gridMesh(reader) : kind == 2 ? assembledGlb(reader.rest()) : std::string();
    const Bytes content = made.empty() ? reader.rest() : bytesOf(made);
    constexpr const char* kNames[] = {"fuzz.ply", "fuzz.obj", "fuzz.glb", "fuzz.obj"};
    bakeAndCheck(bake::importBytes(content, emptyFolder() / kNames[kind], options.limits), options, quantize, compress);
  } catch (const Error&) {
  }
}

void exerciseWholeBake(Bytes bytes, const std::string& name) {
  try {
    bakeAndCheck(bake::importBytes(bytes, emptyFolder() / name, smallLimits()), quickOptions(), false, false);
  } catch (const Error&) {
  }
}

}  // namespace jalousie::test
