// Bakes meshes in batches and writes them in their order.
#include "bake/io/bake_document.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <span>
#include <utility>

#include "asset/accessor.h"
#include "asset/lod_cell_levels.h"
#include "asset/lod_chain.h"
#include "asset/lod_faces.h"
#include "bake/io/baked_mesh.h"
#include "bake/io/equal_meshes.h"
#include "bake/io/gltf_mesh.h"
#include "bake/io/link_levels.h"
#include "bake/io/share_scene.h"
#include "bake/simplify/chain.h"
#include "core/error.h"

namespace jalousie::bake {
namespace {

/// Refuses a mesh that is passed on as it is but holds numbers that are NaN or infinite. @param reason  why it is
/// @param known  accessors that are finite; meshes may share them
void requireFinite(const tinygltf::Model& model, const tinygltf::Mesh& mesh, const std::string& reason,
                   std::set<int>& known) {
  const auto check = [&](const std::map<std::string, int>& attributes) {
    for (const auto& [name, accessor] : attributes) {
      if (!known.insert(accessor).second) continue;
      if (!asset::holdsFiniteNumbers(model, accessor))
        throw Error(ErrorCode::kMalformed,
                    fmt::format("{} holds NaN or an infinite number and cannot be repaired, because {}", name, reason));
    }
  };
  for (const tinygltf::Primitive& primitive : mesh.primitives) {
    check(primitive.attributes);
    for (const auto& target : primitive.targets)
      check(target);
  }
}

/// Meshes that are baked side by side and then written in order, so that the file does not depend on the threads. Few
/// are held in memory at a time. A large mesh is a batch of its own: it uses all threads.
constexpr std::uint64_t kLargeMesh = 100'000;
constexpr std::size_t kMostTogether = 512;

/// Elements that a mesh reads, about.
std::uint64_t sizeOf(const tinygltf::Model& model, const tinygltf::Mesh& mesh) {
  std::uint64_t elements = 0;
  for (const tinygltf::Primitive& primitive : mesh.primitives) {
    const auto position = primitive.attributes.find("POSITION");
    const int accessor = primitive.indices >= 0                   ? primitive.indices
                         : position != primitive.attributes.end() ? position->second
                                                                  : -1;
    if (accessor >= 0) elements += model.accessors[static_cast<std::size_t>(accessor)].count;
  }
  return elements;
}

/// The end of the batch that begins with the mesh used[first].
std::size_t batchEnd(const tinygltf::Model& model, const std::vector<std::size_t>& used, std::size_t first) {
  std::uint64_t elements = 0;
  std::size_t end = first;
  while (end < used.size() && end - first < kMostTogether) {
    elements += sizeOf(model, model.meshes[used[end]]);
    if (end > first && elements > kLargeMesh) break;
    ++end;
  }
  return end;
}

/// Primitives may share accessors, but each primitive reads them again: a small file could demand any amount of work.
constexpr std::uint64_t kFreeElements = 1ULL << 20U;
constexpr std::uint64_t kMaxElementsPerByte = 64;

void checkDemand(const tinygltf::Model& model) {
  const auto count = [&](int accessor) {
    return accessor < 0 ? 0 : std::uint64_t{model.accessors[static_cast<std::size_t>(accessor)].count};
  };
  std::uint64_t bytes = 0;
  for (const tinygltf::Buffer& buffer : model.buffers)
    bytes += buffer.data.size();
  std::uint64_t elements = 0;
  for (const tinygltf::Mesh& mesh : model.meshes) {
    for (const tinygltf::Primitive& primitive : mesh.primitives) {
      const std::uint64_t indices = count(primitive.indices);
      elements += indices;
      for (const auto& [name, accessor] : primitive.attributes) {
        // Of a large shared buffer only the vertices in use are read.
        const bool inPart = primitive.indices >= 0 && accessor >= 0 &&
                            !model.accessors[static_cast<std::size_t>(accessor)].sparse.isSparse;
        elements += inPart ? std::min(count(accessor), 2 * indices) : count(accessor);
      }
    }
  }
  if (elements > kFreeElements + kMaxElementsPerByte * bytes)
    throw Error(ErrorCode::kLimit, fmt::format("the meshes read {} elements out of {} bytes", elements, bytes));
}

std::vector<BakedMesh> bakeBatch(const tinygltf::Model& model, std::span<const std::size_t> batch, const MeshUse& use,
                                 const std::function<BakeOptions(std::size_t)>& optionsOf,
                                 const std::function<void(const std::string&)>& progress) {
  const BakeOptions options = optionsOf(batch.front());
  std::vector<BakedMesh> baked(batch.size());
  const auto bake = [&](std::size_t i, const BakeOptions& used, const LevelProgress& levels) {
    baked[i] = named(model, batch[i], [&] { return bakeMesh(model, batch[i], use, used, levels); });
  };
  if (batch.size() == 1) {
    bake(0, options, [&](const LevelDone& done) {
      progress(fmt::format("level {} of {}, {} triangles: {}", done.level + 1, done.wanted, done.triangles,
                           model.meshes[batch[0]].name));
    });
    return baked;
  }
  options.tasks(batch.size(), [&](std::size_t i) {
    BakeOptions onOneThread = optionsOf(batch[i]);
    onOneThread.chain.slices = runInOneSlice;
    bake(i, onOneThread, {});
  });
  return baked;
}

/// The document before the bake, and what was found in it so far.
struct Document {
  MeshUse use;
  ChannelIndex channels;
  std::set<int> finite;  ///< accessors without NaN and infinite numbers
};

/// A mesh as it was written; meshes of equal content share its levels.
struct Written {
  MeshReport report;
  std::vector<int> levelMeshes;  ///< LOD 0 first; empty if the mesh is passed through
  std::vector<float> coverage;
};

/// Writes a mesh and links its levels, or checks one that is passed through.
Written writeMesh(tinygltf::Model& model, std::size_t index, BakedMesh& baked, Document& document) {
  MeshReport& report = baked.prepared.report;
  if (!report.passedThrough.empty()) {
    requireFinite(model, model.meshes[index], report.passedThrough, document.finite);
    return {std::move(report), {}, {}};
  }
  tinygltf::Mesh kept = model.meshes[index];
  std::erase_if(kept.primitives, hasTriangles);
  requireFinite(model, kept, "it has no triangles", document.finite);
  const std::vector<int> levelMeshes = writeLevels(model, index, baked);
  linkNodes(model, document.channels, document.use.users[index], levelMeshes, baked.coverage);
  return {std::move(report), levelMeshes, std::move(baked.coverage)};
}

/// Writes a mesh whose content equals that of one which is written: only LOD 0 stays a mesh of its own.
Written writeEqual(tinygltf::Model& model, std::size_t index, const Document& document, const Written& first) {
  Written written = first;
  tinygltf::Mesh& mesh = model.meshes[index];
  written.report.name = nameOf(model, index);
  written.report.nodes = document.use.users[index].size();
  if (written.levelMeshes.empty()) return written;
  const tinygltf::Mesh& finest = model.meshes[static_cast<std::size_t>(first.levelMeshes[0])];
  mesh.primitives = finest.primitives;
  asset::setLodInfo(mesh, first.report.levels[0]);
  const asset::CellTriangles cells = asset::lodCells(model, finest);
  if (!cells.empty()) asset::setLodCells(mesh, cells);
  asset::setLodCellLevels(mesh, asset::lodCellLevels(model, finest));
  asset::setLodFaces(mesh, asset::lodFaces(model, finest));
  written.levelMeshes[0] = static_cast<int>(index);
  linkNodes(model, document.channels, document.use.users[index], written.levelMeshes, written.coverage);
  return written;
}

/// For each mesh the place of the first one that has the same levels.
std::vector<std::size_t> shareLevels(const tinygltf::Model& model, const std::vector<std::size_t>& used,
                                     const MeshUse& use, const std::optional<SceneShare>& share) {
  std::vector<std::size_t> first = findEqualMeshes(model, used);
  const auto passes = [&](std::size_t mesh) { return !reasonToPass(model, mesh, use).empty(); };
  for (std::size_t i = 0; i < used.size(); ++i) {
    const std::size_t other = used[first[i]];
    const bool sameShare = !share || (share->targets[used[i]] == share->targets[other] &&
                                      share->reference[used[i]] == share->reference[other] &&
                                      share->touching[used[i]] == share->touching[other]);
    if (first[i] != i && (!sameShare || passes(used[i]) || passes(other))) first[i] = i;
  }
  return first;
}

}  // namespace

std::vector<MeshReport> bakeDocument(
    tinygltf::Model& model, const BakeOptions& options,
    const std::function<void(std::size_t, std::size_t, const std::string&)>& progress) {
  checkDemand(model);
  const std::size_t meshes = model.meshes.size();
  Document document{meshUse(model), indexChannels(model), {}};
  std::vector<std::size_t> used;
  for (std::size_t m = 0; m < meshes; ++m)
    if (!document.use.users[m].empty()) used.push_back(m);
  std::optional<SceneShare> share;
  if (sharesBudget(options, used)) {
    progress(0, meshes, "sharing the budget");
    share = shareScene(model, used, document.use, options);
  }
  const auto optionsOf = [&](std::size_t mesh) { return share ? optionsInScene(options, *share, mesh) : options; };
  const std::vector<std::size_t> first = shareLevels(model, used, document.use, share);
  std::vector<Written> written;
  for (std::size_t begin = 0; begin < used.size();) {
    const std::size_t end = batchEnd(model, used, begin);
    progress(used[begin], meshes, model.meshes[used[begin]].name);
    std::vector<std::size_t> different;
    for (std::size_t i = begin; i < end; ++i)
      if (first[i] == i) different.push_back(used[i]);
    std::vector<BakedMesh> baked;
    if (!different.empty())
      baked = bakeBatch(model, different, document.use, optionsOf,
                        [&](const std::string& what) { progress(used[begin], meshes, what); });
    for (std::size_t next = 0; begin < end; ++begin) {
      written.push_back(named(model, used[begin], [&] {
        return first[begin] == begin ? writeMesh(model, used[begin], baked[next++], document)
                                     : writeEqual(model, used[begin], document, written[first[begin]]);
      }));
    }
  }
  std::vector<MeshReport> reports;
  reports.reserve(written.size());
  for (Written& mesh : written)
    reports.push_back(std::move(mesh.report));
  model.asset.generator = "jalousie-bake";
  return reports;
}

}  // namespace jalousie::bake
