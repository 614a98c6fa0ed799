// Bytes per object, level, texel and pixel of the renderer's buffers and textures.
#include "render/memory_needs.h"

#include <algorithm>
#include <bit>
#include <string>

#include "scene/scene_data.h"
#include "scene/texture_layers.h"
#include "shared/face_structs.h"
#include "shared/frame_structs.h"
#include "visibility/face_pass.h"

namespace jalousie::render {
namespace {

using scene::counted;

/// Draw lists of a frame: early and late.
constexpr std::uint64_t kLists = 2;

std::string sizeText(std::uint64_t width, std::uint64_t height) {
  return std::to_string(width) + 'x' + std::to_string(height) + " pixels";
}

/// ObjectStore, slots and instance lists; draw commands where there is one for each entry.
std::uint64_t objectBytes(const RendererOptions& options, bool patches) {
  const bool perObject = options.submission == visibility::Submission::kPerObject;
  const std::uint64_t lists = patches ? gpu::kListCount : gpu::kListsPerDetail;
  const std::uint64_t entry = sizeof(gpu::uint) + (perObject ? lists * sizeof(gpu::DrawCommand) : 0);
  return sizeof(gpu::Transform) + sizeof(gpu::Object) + sizeof(gpu::Tile) + sizeof(gpu::ObjectState) +
         sizeof(gpu::ScreenBox) + 4 * sizeof(gpu::uint) +  // marks, pixel counts, drawn triangles and cells
         kLists * 2 * sizeof(gpu::uint) +                  // slots
         2 * kLists * entry;                               // a cross-faded object is on a list twice
}

/// Groups of triangles, and for each entry of a list the ranges and commands that FacePass makes.
void addFaces(MemoryEstimate& needs, const scene::SceneSize& size) {
  needs.add(size.faceNodes, sizeof(gpu::FaceNode) + sizeof(gpu::FaceLod),
            counted(size.faceNodes, "groups of triangles"));
  const std::uint64_t entries = 2 * std::max({size.instances, size.cells, std::uint64_t{1}});
  const std::uint64_t ranges = visibility::faceRanges(size.faceNodes, entries);
  needs.add(kLists * entries,
            gpu::kListsPerDetail * (ranges + 1) * sizeof(gpu::DrawCommand) +
                (2 + gpu::kFaceHead + 2 * ranges) * sizeof(gpu::uint),
            "commands without back faces");
}

}  // namespace

MemoryEstimate bufferNeeds(const scene::SceneSize& size, bool patches, const RendererOptions& options) {
  const std::uint64_t vertices = size.vertices + (patches ? size.coarsestVertices : 0);
  const std::uint64_t indices = size.indices + (patches ? size.coarsestIndices : 0);
  MemoryEstimate needs;
  needs.add(size.instances, objectBytes(options, patches), counted(size.instances, "instances"));
  needs.add(vertices, sizeof(scene::Vertex), counted(vertices, "vertices"));
  needs.add(size.secondUvs > 0 ? vertices : 0, sizeof(glm::vec2), counted(vertices, "second texture coordinates"));
  needs.add(indices, sizeof(std::uint32_t), counted(indices, "indices"));
  needs.add(size.looseVertices, sizeof(scene::Vertex), counted(size.looseVertices, "points and ends of lines"));
  needs.add(size.chains, sizeof(gpu::Chain), counted(size.chains, "LOD chains"));
  // Two bins per level: a command in every list and a count per tile, of which a chain has one for 64 objects.
  const std::uint64_t commands = kLists * (patches ? gpu::kListCount : gpu::kListsPerDetail);
  needs.add(size.levels,
            sizeof(gpu::Lod) + 2 * (sizeof(gpu::Bin) + commands * sizeof(gpu::DrawCommand) + sizeof(gpu::uint)),
            counted(size.levels, "levels"));
  needs.add(size.cells,
            sizeof(gpu::Object) + sizeof(gpu::Chain) + sizeof(gpu::Tile) + sizeof(gpu::ObjectState) +
                sizeof(gpu::uint) + kLists * 4 * sizeof(gpu::uint),
            counted(size.cells, "cells"));
  needs.add(size.cellLevels,
            sizeof(gpu::Lod) + sizeof(gpu::CellBounds) +
                2 * (sizeof(gpu::Bin) + commands * sizeof(gpu::DrawCommand) + sizeof(gpu::uint)),
            counted(size.cellLevels, "levels of cells"));
  if (size.faceNodes > 0) addFaces(needs, size);
  needs.add(size.motionBytes, 1, "animations");
  std::uint64_t texels = 0;
  for (const scene::TextureClass& size_ : scene::layoutTextures(size.images).classes)
    texels += size_.texels();
  needs.add(texels / 3 * 4 + 1, 4, counted(size.images.size(), "textures"));  // with mip levels
  return needs;
}

MemoryEstimate targetNeeds(std::uint32_t width, std::uint32_t height) {
  constexpr std::uint64_t kTargetBytes = 4 + 4 + 4;  // colour, depth, object numbers
  const std::uint64_t pixels = std::uint64_t{width} * height;
  const std::uint64_t padded = std::uint64_t{std::bit_ceil(width)} * std::bit_ceil(height);
  MemoryEstimate needs;
  // The occlusion map has all levels, the depth pyramid all but the first, both four bytes a texel.
  needs.add(1, pixels * kTargetBytes + padded / 3 * 5 * 4, sizeText(width, height));
  return needs;
}

MemoryEstimate pictureNeeds(std::uint32_t width, std::uint32_t height) {
  constexpr std::uint64_t kEncodeBytes = 4 + 4 + 4 + 4;  // picture, the encoder's copy, filtered rows, compressed data
  MemoryEstimate needs;
  needs.add(std::uint64_t{width} * height, kEncodeBytes, sizeText(width, height));
  return needs;
}

}  // namespace jalousie::render
