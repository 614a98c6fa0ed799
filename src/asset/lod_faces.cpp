// Trees of groups as JSON numbers.
#include "asset/lod_faces.h"

#include <fmt/format.h>

#include <string>

#include "asset/extras.h"
#include "asset/lod_chain.h"
#include "asset/triangle_count.h"
#include "core/check.h"
#include "core/error.h"

namespace jalousie::asset {
namespace {

constexpr const char* kFaces = "faces";
constexpr const char* kKind = "kind";
constexpr const char* kTrees = "trees";
constexpr const char* kOwn = "jalousie";

[[noreturn]] void wrongFaces(const std::string& what) {
  throw Error(ErrorCode::kMalformed, "extras.jalousie.faces" + what);
}

FaceGrouping groupingOf(const tinygltf::Value& kind) {
  if (kind.IsString())
    for (const FaceGrouping grouping : kFaceGroupings)
      if (grouping != FaceGrouping::kOff && kind.Get<std::string>() == nameOf(grouping)) return grouping;
  wrongFaces(".kind is not masks, clusters or meshlets");
}

FaceTree readTree(const tinygltf::Value& list, std::size_t primitive) {
  if (list.IsNumber() && list.GetNumberAsDouble() == 0.0) return {};
  if (!list.IsArray()) wrongFaces(fmt::format(": primitive {} has no list", primitive));
  FaceTree tree;
  tree.reserve(list.ArrayLen());
  for (const tinygltf::Value& value : list.Get<tinygltf::Value::Array>()) {
    const std::optional<std::uint32_t> number = countIn(value);
    if (!number) wrongFaces(fmt::format(": primitive {} has no count of triangles at {}", primitive, tree.size()));
    tree.push_back(*number);
  }
  return tree;
}

/// @param cells  of the primitive; empty: it is not divided
void checkTree(const FaceTree& tree, std::size_t primitive, std::uint64_t triangles,
               const std::vector<std::uint32_t>& cells) {
  if (tree.empty()) return;
  const std::optional<std::uint64_t> own = faceTriangles(tree);
  if (!own) wrongFaces(fmt::format(": primitive {} has a tree that is not complete", primitive));
  if (*own != triangles)
    wrongFaces(fmt::format(": primitive {} has {} triangles, its groups have {}", primitive, triangles, *own));
  std::vector<std::uint32_t> ends;
  ends.reserve(cells.size());
  std::uint32_t end = 0;  // at most the primitive's number of triangles
  for (const std::uint32_t count : cells)
    ends.push_back(end += count);
  if (!ends.empty() && !splitFaceTrees(tree, ends))
    wrongFaces(fmt::format(": primitive {} has a tree that crosses the border of a cell", primitive));
}

}  // namespace

const char* nameOf(FaceGrouping grouping) {
  constexpr const char* kNames[] = {"off", "masks", "clusters", "meshlets"};
  static_assert(std::size(kNames) == std::size(kFaceGroupings));
  return kNames[static_cast<std::size_t>(grouping)];
}

void setLodFaces(tinygltf::Mesh& mesh, const LodFaces& faces) {
  if (faces.grouping == FaceGrouping::kOff) return;
  JAL_CHECK((mesh.extras.IsObject() && mesh.extras.Has(kOwn) && mesh.extras.Get(kOwn).Has("diagonal")));
  JAL_CHECK(faces.trees.size() == mesh.primitives.size());
  tinygltf::Value::Array lists;
  for (const FaceTree& tree : faces.trees) {
    if (tree.empty()) {
      lists.emplace_back(0);
      continue;
    }
    tinygltf::Value::Array numbers;
    numbers.reserve(tree.size());
    for (const std::uint32_t number : tree)
      numbers.push_back(countValue(number));
    lists.emplace_back(std::move(numbers));
  }
  tinygltf::Value own = mesh.extras.Get(kOwn);
  setMember(own, kFaces,
            tinygltf::Value(tinygltf::Value::Object{{kKind, tinygltf::Value(std::string(nameOf(faces.grouping)))},
                                                    {kTrees, tinygltf::Value(std::move(lists))}}));
  setMember(mesh.extras, kOwn, std::move(own));
}

LodFaces lodFaces(const tinygltf::Model& model, const tinygltf::Mesh& mesh) {
  const std::optional<LodInfo> info = lodInfo(mesh);  // checks the number of the format
  if (!info || !info->measures) return {};
  const tinygltf::Value& own = mesh.extras.Get(kOwn);
  if (!own.Has(kFaces) || own.Get("format").GetNumberAsDouble() < 5.0) return {};
  const tinygltf::Value& object = own.Get(kFaces);
  if (!object.IsObject()) wrongFaces(" is not an object");
  LodFaces faces;
  faces.grouping = groupingOf(object.Get(kKind));
  const tinygltf::Value& lists = object.Get(kTrees);
  if (!lists.IsArray()) wrongFaces(".trees is not a list");
  if (lists.ArrayLen() != mesh.primitives.size())
    wrongFaces(fmt::format(" has {} lists for {} primitives", lists.ArrayLen(), mesh.primitives.size()));
  const CellTriangles cells = lodCells(model, mesh);
  for (std::size_t p = 0; p < mesh.primitives.size(); ++p) {
    faces.trees.push_back(readTree(lists.Get(static_cast<int>(p)), p));
    checkTree(faces.trees.back(), p, triangleCount(model, mesh.primitives[p]),
              cells.empty() ? std::vector<std::uint32_t>() : cells[p]);
  }
  return faces;
}

}  // namespace jalousie::asset
