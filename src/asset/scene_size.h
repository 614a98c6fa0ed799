// How much a document holds, counted from its JSON and the headers of its images.
#pragma once

#include <cstdint>
#include <vector>

#include "asset/image_io.h"
#include "asset/read_limits.h"

namespace tinygltf {
class Model;
}

namespace jalousie::asset {

/// Numbers of elements of a SceneFile.
struct SceneSize {
  std::uint64_t documentBytes = 0;  ///< of the loaded document's buffers and encoded images
  std::uint64_t instances = 0;
  std::uint64_t vertices = 0;   ///< of all meshes, each once; an own one per corner where a primitive has no normals
  std::uint64_t secondUvs = 0;  ///< vertices, if some texture is read by TEXCOORD_1
  std::uint64_t indices = 0;
  std::uint64_t looseVertices = 0;   ///< points and ends of lines, of all nodes
  std::uint64_t looseInstances = 0;  ///< of nodes with points or lines
  std::uint64_t cellEnds = 0;        ///< of all primitives
  std::uint64_t faceNumbers = 0;     ///< of all primitives: numbers of their trees of groups
  std::uint64_t chains = 0;
  std::uint64_t levels = 0;            ///< of all chains
  std::uint64_t coarsestVertices = 0;  ///< of the last level of each chain
  std::uint64_t coarsestIndices = 0;
  std::uint64_t largestTriangles = 0;  ///< LOD 0 of the largest chain
  std::uint64_t finestTriangles = 0;   ///< LOD 0 of every instance
  std::uint64_t levelTriangles = 0;    ///< LOD 0 of every chain, times the chain's levels
  std::uint64_t cells = 0;             ///< that objects are drawn in; 0: objects are drawn whole
  std::uint64_t cellLevels = 0;        ///< of all chains of cells
  std::uint64_t faceNodes = 0;         ///< groups of back faces and nodes above them; 0: they are not culled
  std::uint64_t motionBytes = 0;       ///< of SceneMotion, at most; 0 without SceneReading::plays
  std::uint64_t cameras = 0;
  std::uint64_t cameraKeys = 0;   ///< keys that cameras share count once
  std::vector<ImageSize> images;  ///< textures, in the order of SceneFile::images
};

/// Counts what readScene would read, without reading it, and no cells: time and memory follow the size of the JSON.
/// Errors: as readScene for what is looked at.
SceneSize measureScene(const tinygltf::Model& model, const Limits& limits = {});

}  // namespace jalousie::asset
