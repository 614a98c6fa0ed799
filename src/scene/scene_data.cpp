// Builds the flat arrays of a scene: each mesh once, LOD levels as index ranges, objects sorted by chain.
#include "scene/scene_data.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <utility>

#include "core/check.h"
#include "core/error.h"
#include "scene/face_tables.h"
#include "scene/material_table.h"
#include "scene/mesh_cells.h"
#include "scene/motion_data.h"
#include "scene/motion_state.h"
#include "scene/patch_base.h"

namespace jalousie::scene {
namespace {

using asset::Mesh;
using asset::Primitive;

/// Area of all triangles, object space.
double surfaceOf(const Primitive& primitive) {
  double sum = 0.0;
  for (std::size_t i = 0; i + 2 < primitive.indices.size(); i += 3) {
    const glm::dvec3 a(primitive.positions[primitive.indices[i]]);
    const glm::dvec3 b(primitive.positions[primitive.indices[i + 1]]);
    const glm::dvec3 c(primitive.positions[primitive.indices[i + 2]]);
    sum += 0.5 * glm::length(glm::cross(b - a, c - a));
  }
  return sum;
}

/// Mean deviation of a level, at most its largest one, which counts where the file states no mean.
float meanErrorOf(const asset::LodLevel& level) {
  return std::min(level.meanErrorObject.value_or(level.errorObject), level.errorObject);
}

/// Builds one scene.
class SceneBuilder {
 public:
  SceneBuilder(const asset::SceneFile& file, const BuildOptions& options) : file_(file), options_(options) {}

  SceneData build() {
    scene_.textures = makeTextureLayers(file_.images, layerUses());
    for (const asset::Material& material : file_.materials)
      scene_.materials.push_back(makeMaterial(material, scene_.textures.layout));
    scene_.usesFullMaterials = std::any_of(file_.materials.begin(), file_.materials.end(), isFull);
    hasSecondUvs_ = std::any_of(file_.materials.begin(), file_.materials.end(), asset::usesSecondUvs);
    cells_ = divideMeshes(file_, options_.patches ? CellOptions{} : options_.cells);
    reserve();
    bent_ = bentMeshes(file_);
    meshLods_.resize(file_.meshes.size());
    meshBounds_.resize(file_.meshes.size());
    meshCells_.resize(file_.meshes.size());
    meshSurfaces_.resize(file_.meshes.size());
    meshPlaces_.resize(file_.meshes.size());
    if (options_.patches && !file_.motion.meshes.empty()) patchPlaces_.resize(file_.chains.size());
    transformOf_.resize(file_.motion.empty() ? 0 : file_.instances.size(), gpu::kNoMotion);
    for (const asset::MeshBending& bending : file_.motion.meshes)
      bendings_[bending.mesh] = &bending;
    for (std::size_t m = 0; m < file_.meshes.size(); ++m)
      addMesh(m);
    for (const asset::Chain& chain : file_.chains)
      addChain(chain);
    addObjects();
    addLoose();
    scene_.binLayout = layoutBins(scene_.chains, scene_.objects, scene_.lods, options_.patches);
    const auto divided = [](const MeshCells& cells) { return cells.count > 1; };
    if (std::any_of(cells_.begin(), cells_.end(), divided)) addCells();
    if (makesFaces()) addFaces();
    addMotion();
    scene_.cameras = file_.cameras;
    scene_.originWorld = file_.originWorld;
    scene_.rooms = file_.rooms;
    addNames();
    scene_.ignored = file_.ignored;
    return std::move(scene_);
  }

 private:
  /// Vectors that grew step by step would hold up to twice what they need.
  void reserve() {
    std::size_t vertices = 0;
    std::size_t indices = 0;
    const auto add = [&](const Mesh& mesh) {
      for (const Primitive& primitive : mesh.primitives) {
        vertices += primitive.positions.size();
        indices += primitive.indices.size();
      }
    };
    for (const Mesh& mesh : file_.meshes)
      add(mesh);
    for (const asset::Chain& chain : file_.chains)
      if (options_.patches) add(file_.meshes[chain.levels.back().mesh]);
    scene_.vertices.reserve(vertices);
    if (hasSecondUvs_) scene_.secondUvs.reserve(vertices);
    scene_.indices.reserve(indices);
    scene_.transforms.reserve(file_.instances.size());
    scene_.objects.reserve(file_.instances.size());
  }

  /// Per image what its materials need; the cutoff is that of the first masked one, so that its mip levels keep their
  /// coverage.
  std::vector<LayerUse> layerUses() const {
    std::vector<LayerUse> uses(file_.images.size());
    for (const asset::Material& material : file_.materials) {
      if (material.normalTexture) uses[material.normalTexture->image].isData = true;
      for (const auto& texture : {material.baseTexture, material.emissiveTexture, material.normalTexture})
        if (texture && texture->sampling.magnifyNearest) uses[texture->image].isNearest = true;
      if (!material.baseTexture || material.alphaMode != asset::AlphaMode::kMask) continue;
      std::optional<float>& cutoff = uses[material.baseTexture->image].alphaCutoff;
      if (!cutoff) cutoff = material.alphaCutoff / std::max(material.baseColor.a, 1e-3F);
    }
    return uses;
  }

  gpu::uint listOfPrimitive(const Primitive& primitive) const { return listOf(file_.materials[primitive.material]); }

  /// Appends the vertices of all primitives of a mesh in the order of the draw lists. @param normals  per primitive;
  /// null for the file's own   @return  per primitive what its indices are relative to
  std::vector<std::uint32_t> appendVertices(const Mesh& mesh, const std::vector<std::vector<glm::vec3>>* normals) {
    const std::size_t baseVertex = scene_.vertices.size();
    std::vector<std::uint32_t> offsets(mesh.primitives.size());
    for (gpu::uint list = 0; list < gpu::kListsPerDetail; ++list) {
      for (std::size_t p = 0; p < mesh.primitives.size(); ++p) {
        const Primitive& primitive = mesh.primitives[p];
        if (listOfPrimitive(primitive) != list) continue;
        if (scene_.vertices.size() + primitive.positions.size() > std::numeric_limits<std::int32_t>::max())
          throw Error(ErrorCode::kLimit, "the scene has more vertices than 32-bit offsets reach");
        offsets[p] = static_cast<std::uint32_t>(scene_.vertices.size() - baseVertex);
        const std::vector<glm::vec3>& own = normals != nullptr ? (*normals)[p] : primitive.normals;
        for (std::size_t v = 0; v < primitive.positions.size(); ++v)
          scene_.vertices.push_back({primitive.positions[v], packNormal(own[v]), primitive.uvs[v],
                                     packColor(primitive.colors[v]), primitive.material});
        if (!hasSecondUvs_) continue;
        scene_.secondUvs.insert(scene_.secondUvs.end(), primitive.uvs1.begin(), primitive.uvs1.end());
        scene_.secondUvs.resize(scene_.vertices.size());
      }
    }
    return offsets;
  }

  /// Appends some triangles of each primitive in the order of the draw lists.
  /// @param offsets    per primitive, as of appendVertices
  /// @param indicesOf  of a primitive's number: which of its indices
  /// @return  a level of these triangles
  template <class IndicesOf>
  gpu::Lod appendTriangles(const Mesh& mesh, std::span<const std::uint32_t> offsets, int baseVertex,
                           const IndicesOf& indicesOf) {
    gpu::Lod lod{};
    lod.baseVertex = baseVertex;
    lod.firstIndex = static_cast<std::uint32_t>(scene_.indices.size());
    gpu::uint* const counts[] = {&lod.solidCount, &lod.sheetCount, &lod.blendCount};
    for (gpu::uint list = 0; list < gpu::kListsPerDetail; ++list) {
      for (std::size_t p = 0; p < mesh.primitives.size(); ++p) {
        if (listOfPrimitive(mesh.primitives[p]) != list) continue;
        const std::span<const std::uint32_t> indices = indicesOf(p);
        if (scene_.indices.size() + indices.size() > std::numeric_limits<std::uint32_t>::max())
          throw Error(ErrorCode::kLimit, "the scene has more indices than 32-bit offsets reach");
        for (const std::uint32_t index : indices)
          scene_.indices.push_back(offsets[p] + index);
        *counts[list] += static_cast<std::uint32_t>(indices.size());
      }
    }
    lod.triangleCount = (lod.solidCount + lod.sheetCount + lod.blendCount) / 3;
    scene_.usesBlending |= lod.blendCount > 0;
    return lod;
  }

  bool makesFaces() const { return options_.faces && !options_.patches; }

  /// Groups of the solid triangles of each cell. None where animations bend the mesh: its normals change.
  std::vector<asset::FaceTree> facesOf(std::size_t m) const {
    const Mesh& mesh = file_.meshes[m];
    const MeshCells& cells = cells_[m];
    std::vector<asset::FaceTree> faces(cells.count);
    if (!makesFaces() || bent_[m]) return faces;
    for (std::size_t p = 0; p < mesh.primitives.size(); ++p) {
      const Primitive& primitive = mesh.primitives[p];
      if (listOfPrimitive(primitive) != gpu::kListSolid) continue;
      const std::vector<std::uint32_t> whole{static_cast<std::uint32_t>(primitive.indices.size())};
      const bool fileOrder = cells.count == 1 || cells.indices[p].empty();
      const std::vector<asset::FaceTree> own =
          faceTreesOf(primitive, cells.count == 1 ? whole : cells.ends[p], fileOrder);
      for (std::uint32_t c = 0; c < cells.count; ++c)
        faces[c].insert(faces[c].end(), own[c].begin(), own[c].end());
    }
    return faces;
  }

  /// Appends a mesh cell after cell. The level of the whole mesh spans the ranges of all cells.
  void addMesh(std::size_t m) {
    const Mesh& mesh = file_.meshes[m];
    const MeshCells& cells = cells_[m];
    const auto baseVertex = static_cast<std::int32_t>(scene_.vertices.size());
    const std::vector<std::uint32_t> offsets = appendVertices(mesh, nullptr);
    meshPlaces_[m] = {static_cast<std::uint32_t>(baseVertex), offsets};
    gpu::Lod& whole = meshLods_[m];
    whole.baseVertex = baseVertex;
    whole.firstIndex = static_cast<std::uint32_t>(scene_.indices.size());
    std::vector<asset::FaceTree> faces = facesOf(m);
    for (std::uint32_t c = 0; c < cells.count; ++c) {
      Aabb bounds;
      const gpu::Lod lod = appendTriangles(mesh, offsets, baseVertex, [&](std::size_t p) {
        const std::span<const std::uint32_t> indices = cellIndices(mesh.primitives[p], cells, p, c);
        for (const std::uint32_t index : indices)
          bounds.add(mesh.primitives[p].positions[index]);
        return indices;
      });
      meshCells_[m].push_back({lod, bounds, std::move(faces[c])});
      meshBounds_[m].add(bounds);
      whole.solidCount += lod.solidCount;
      whole.sheetCount += lod.sheetCount;
      whole.blendCount += lod.blendCount;
      whole.triangleCount += lod.triangleCount;
    }
    for (const Primitive& primitive : mesh.primitives)
      meshSurfaces_[m] += surfaceOf(primitive);
  }

  static std::span<const std::uint32_t> cellIndices(const Primitive& primitive, const MeshCells& cells, std::size_t p,
                                                    std::uint32_t cell) {
    if (cells.count == 1) return primitive.indices;
    const std::vector<std::uint32_t>& indices = cells.indices[p].empty() ? primitive.indices : cells.indices[p];
    const std::uint32_t first = cell > 0 ? cells.ends[p][cell - 1] : 0;
    return std::span(indices).subspan(first, cells.ends[p][cell] - first);
  }

  /// Averages normals over all primitives of the mesh, so that seams between materials stay closed too.
  /// @param place  gets where the vertices lie, and their normals
  gpu::Lod addPatchBase(const Mesh& mesh, Aabb& bounds, PatchPlace& place) {
    std::vector<glm::vec3> positions;
    std::vector<std::uint32_t> indices;
    for (const Primitive& primitive : mesh.primitives) {
      const auto offset = static_cast<std::uint32_t>(positions.size());
      positions.insert(positions.end(), primitive.positions.begin(), primitive.positions.end());
      for (const std::uint32_t index : primitive.indices)
        indices.push_back(offset + index);
    }
    const std::vector<glm::vec3> normals = averagedNormals(positions, indices);
    bounds.add(phongBounds(positions, normals, indices, kPhongAlpha));
    std::vector<std::vector<glm::vec3>> split;
    const float error = phongError(positions, normals, indices, kPhongAlpha);
    auto next = normals.begin();
    for (const Primitive& primitive : mesh.primitives) {
      const auto end = next + static_cast<std::ptrdiff_t>(primitive.positions.size());
      split.emplace_back(next, end);
      next = end;
    }
    const auto baseVertex = static_cast<std::int32_t>(scene_.vertices.size());
    const std::vector<std::uint32_t> offsets = appendVertices(mesh, &split);
    gpu::Lod lod = appendTriangles(mesh, offsets, baseVertex,
                                   [&](std::size_t p) { return std::span(mesh.primitives[p].indices); });
    lod.errorObject = lod.meanErrorObject = error;
    place = {{static_cast<std::uint32_t>(baseVertex), offsets}, std::move(split)};
    return lod;
  }

  /// The base mesh of a chain that animations bend is that of its unbent triangles.
  gpu::Lod addPatches(const asset::Chain& chain, Aabb& bounds) {
    const std::uint32_t coarsest = chain.levels.back().mesh;
    const auto bending = bendings_.find(coarsest);
    PatchPlace place;
    if (bending == bendings_.end()) return addPatchBase(file_.meshes[coarsest], bounds, place);
    const gpu::Lod lod = addPatchBase(unbent(file_.meshes[coarsest], *bending->second), bounds, place);
    patchPlaces_[scene_.chains.size()] = std::move(place);
    return lod;
  }

  void addChain(const asset::Chain& chain) {
    JAL_CHECK(!chain.levels.empty());
    if (chain.levels.size() > gpu::kMaxLods)
      throw Error(ErrorCode::kUnsupported, "chain '" + chain.name + "' has more levels than supported (32)");
    gpu::Chain result{};
    result.firstLod = static_cast<std::uint32_t>(scene_.lods.size());
    result.lodCount = static_cast<std::uint32_t>(chain.levels.size());
    Aabb bounds;
    float mean = 0.0F;
    scene_.hasUncoveredChains |= chain.levels.size() > 1 && chain.coverage.empty();
    for (std::size_t k = 0; k < chain.levels.size(); ++k) {
      const asset::LodLevel& level = chain.levels[k];
      gpu::Lod lod = meshLods_[level.mesh];
      lod.leastCoverage = k < chain.coverage.size() ? chain.coverage[k] : 0.0F;
      lod.errorObject = level.errorObject;
      lod.meanErrorObject = meanErrorOf(level);
      if (std::isfinite(lod.meanErrorObject)) lod.meanErrorObject = mean = std::max(mean, lod.meanErrorObject);
      scene_.hasUnmeasuredLevels |= !std::isfinite(level.errorObject);
      scene_.lods.push_back(lod);
      bounds.add(meshBounds_[level.mesh]);
    }
    result.surfaceObject = static_cast<float>(meshSurfaces_[chain.levels.front().mesh]);
    result.patchLod = static_cast<std::uint32_t>(scene_.lods.size()) - 1;
    if (options_.patches) {
      scene_.lods.push_back(addPatches(chain, bounds));
      result.patchLod = static_cast<std::uint32_t>(scene_.lods.size()) - 1;
      scene_.maxPatchTriangles = std::max(scene_.maxPatchTriangles, scene_.lods.back().triangleCount);
    }
    if (bounds.empty()) bounds = Aabb{glm::vec3(0.0F), glm::vec3(0.0F)};
    result.boundsMinObject = glm::vec4(bounds.min, 0.0F);
    result.boundsMaxObject = glm::vec4(bounds.max, 0.0F);
    for (const asset::Occluder& occluder : chain.occluders) {
      if (occluder.levels == 0) continue;
      scene_.occluders.push_back(
          {occluder.solid, static_cast<std::uint32_t>(scene_.chains.size()), occluder.levels >= chain.levels.size()});
    }
    scene_.chains.push_back(result);
  }

  /// Sorted by chain, stable: instances of one chain keep the file's order.
  void addObjects() {
    std::vector<std::uint32_t> order(file_.instances.size());
    std::iota(order.begin(), order.end(), 0U);
    std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
      return file_.instances[a].chain < file_.instances[b].chain;
    });
    for (const std::uint32_t i : order) {
      const asset::Instance& instance = file_.instances[i];
      const gpu::Chain& chain = scene_.chains[instance.chain];
      scene_.boundsWorld.add(transformed(instance.worldFromObject,
                                         Aabb{glm::vec3(chain.boundsMinObject), glm::vec3(chain.boundsMaxObject)}));
      if (std::binary_search(options_.hidden.begin(), options_.hidden.end(), i)) continue;
      const auto transform = static_cast<gpu::uint>(scene_.transforms.size());
      if (!transformOf_.empty()) transformOf_[i] = transform;
      scene_.transforms.push_back(makeTransform(instance.worldFromObject));
      const auto object = static_cast<gpu::uint>(scene_.objects.size());
      scene_.objects.push_back({instance.chain, transform, i, object});
    }
  }

  void addLoose() {
    LooseScene loose = makeLooseScene(file_, options_.hidden);
    scene_.loose = std::move(loose.table);
    scene_.boundsWorld.add(loose.boundsWorld);
    loosePlaces_ = std::move(loose.places);
  }

  void addMotion() {
    if (file_.motion.empty()) return;
    scene_.motion = buildMotion(file_, {.meshes = meshPlaces_,
                                        .patches = patchPlaces_,
                                        .transforms = transformOf_,
                                        .cellChains = cellChains_,
                                        .chainsOfCells = scene_.cells.chains,
                                        .loose = loosePlaces_});
    scene_.boundsWorld.add(motionBounds(scene_.motion, scene_.objects, scene_.chains, scene_.transforms));
  }

  void addNames() {
    scene_.names.nodes = file_.nodeNames;
    scene_.names.nodeOf.reserve(file_.instances.size());
    for (const asset::Instance& instance : file_.instances)
      scene_.names.nodeOf.push_back(instance.node);
    for (const asset::Chain& chain : file_.chains)
      scene_.names.meshes.push_back(file_.meshes[chain.levels.front().mesh].name);
  }

  /// One chain per cell of each chain, and its objects' cells in the order of the objects.
  void addCells() {
    CellTables& tables = scene_.cells;
    auto first = scene_.objects.begin();
    for (std::size_t c = 0; c < file_.chains.size(); ++c) {
      const auto end = std::find_if(first, scene_.objects.end(), [&](const gpu::Object& o) { return o.chain != c; });
      const std::vector<asset::LodLevel>& levels = file_.chains[c].levels;
      cellChains_.push_back(static_cast<std::uint32_t>(tables.chains.size()));
      for (std::uint32_t cell = 0; cell < meshCells_[levels.front().mesh].size(); ++cell) {
        const auto chain = static_cast<gpu::uint>(tables.chains.size());
        addCellChain(levels, scene_.chains[c].firstLod, cell);
        for (auto object = first; object != end; ++object)
          tables.objects.push_back({chain, object->transform, object->owner, object->object});
      }
      first = end;
    }
    tables.binLayout = layoutBins(tables.chains, tables.objects, tables.lods, /*patches=*/false);
  }

  /// Groups of everything that is drawn: the levels of the chains, or those of the chains of cells.
  void addFaces() {
    const bool divided = !scene_.cells.objects.empty();
    const DrawTables& drawn = scene_.drawn();
    std::size_t lod = 0;
    for (const asset::Chain& chain : file_.chains) {
      const std::size_t parts = divided ? meshCells_[chain.levels.front().mesh].size() : 1;
      for (std::size_t cell = 0; cell < parts; ++cell)
        for (const asset::LodLevel& level : chain.levels)
          addFaceLod(scene_.faces, {scene_.vertices, scene_.indices}, drawn.lods[lod++],
                     meshCells_[level.mesh][cell].faces);
    }
    JAL_CHECK(lod == drawn.lods.size());
    for (const gpu::Object& unit : drawn.objects)
      scene_.faces.units.push_back({drawn.chains[unit.chain].firstLod, unit.transform});
  }

  /// @param firstLod  of the chain that the cell belongs to: errors are those of its levels
  void addCellChain(const std::vector<asset::LodLevel>& levels, gpu::uint firstLod, std::uint32_t cell) {
    CellTables& tables = scene_.cells;
    gpu::Chain chain{};
    chain.firstLod = static_cast<gpu::uint>(tables.lods.size());
    chain.lodCount = static_cast<gpu::uint>(levels.size());
    chain.patchLod = chain.firstLod + chain.lodCount - 1;
    Aabb whole;
    for (std::size_t k = 0; k < levels.size(); ++k) {
      const Cell& part = meshCells_[levels[k].mesh][cell];
      gpu::Lod lod = part.lod;
      lod.errorObject = scene_.lods[firstLod + k].errorObject;
      lod.meanErrorObject = scene_.lods[firstLod + k].meanErrorObject;
      lod.leastCoverage = scene_.lods[firstLod + k].leastCoverage;
      tables.lods.push_back(lod);
      tables.bounds.push_back({glm::vec4(part.bounds.min, 0.0F), glm::vec4(part.bounds.max, 0.0F)});
      whole.add(part.bounds);
    }
    chain.boundsMinObject = glm::vec4(whole.min, 0.0F);
    chain.boundsMaxObject = glm::vec4(whole.max, 0.0F);
    tables.chains.push_back(chain);
  }

  const asset::SceneFile& file_;
  BuildOptions options_;
  SceneData scene_;
  bool hasSecondUvs_ = false;
  /// The triangles of one cell at one level.
  struct Cell {
    gpu::Lod lod;
    Aabb bounds;
    asset::FaceTree faces;  ///< of its solid triangles
  };

  std::vector<bool> bent_;        ///< per mesh: whether animations bend it
  std::vector<MeshCells> cells_;  ///< per mesh of the file
  std::vector<std::vector<Cell>> meshCells_;
  std::vector<gpu::Lod> meshLods_;
  std::vector<Aabb> meshBounds_;
  std::vector<double> meshSurfaces_;  ///< object space
  std::vector<MeshPlace> meshPlaces_;
  std::vector<LoosePlace> loosePlaces_;
  std::vector<std::optional<PatchPlace>> patchPlaces_;           ///< per chain; empty where no chain is bent
  std::vector<std::uint32_t> transformOf_;                       ///< per instance; empty where nothing moves
  std::vector<std::uint32_t> cellChains_;                        ///< per chain the first one of its cells
  std::map<std::uint32_t, const asset::MeshBending*> bendings_;  ///< by mesh
};

}  // namespace

SceneData buildScene(const asset::SceneFile& file, const BuildOptions& options) {
  return SceneBuilder(file, options).build();
}

}  // namespace jalousie::scene
