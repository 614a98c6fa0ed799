// Upload of vertices, indices, scene tables and texture layers.
#include "render/scene_buffers.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <string>
#include <vector>

#include "core/error.h"
#include "visibility/storage.h"

namespace jalousie::render {
namespace {

using visibility::uploadStorage;

template <class T>
gl::Buffer upload(const std::vector<T>& elements, const char* name) {
  return gl::Buffer::fromArray(std::span<const T>(elements), name);
}

gl::Texture makeClass(const scene::TextureClass& size) {
  GLint maxLayers = 0;
  glGetIntegerv(GL_MAX_ARRAY_TEXTURE_LAYERS, &maxLayers);
  if (size.layers > static_cast<std::uint32_t>(maxLayers))
    throw Error(ErrorCode::kLimit, "the scene has " + std::to_string(size.layers) + " textures of one size, this " +
                                       "driver's texture arrays hold " + std::to_string(maxLayers));
  const auto levels = static_cast<std::uint32_t>(std::bit_width(std::max(size.width, size.height)));
  gl::Texture texture(GL_TEXTURE_2D_ARRAY, GL_SRGB8_ALPHA8, {size.width, size.height, size.layers, levels}, "textures");
  texture.setSampling(GL_LINEAR_MIPMAP_LINEAR, GL_LINEAR, GL_REPEAT);
  return texture;
}

/// One array for each class; one white texel where there are none.
std::vector<gl::Texture> makeTextures(const scene::TextureLayers& textures) {
  std::vector<gl::Texture> arrays;
  for (const scene::TextureClass& size : textures.layout.classes)
    arrays.push_back(makeClass(size));
  for (std::size_t i = 0; i < textures.images.size(); ++i) {
    const scene::TextureSlot& slot = textures.layout.slots[i];
    const std::vector<ImageRgba8> levels = scene::makeLayer(textures, i);  // one at a time: layers are large
    for (std::uint32_t level = 0; level < levels.size(); ++level)
      arrays[slot.textureClass].uploadLayer(slot.layer, level, levels[level].pixels);
  }
  if (!arrays.empty()) return arrays;
  arrays.push_back(makeClass({1, 1, 1}));
  arrays.front().uploadLayer(0, 0, std::vector<std::uint8_t>(4, 255));
  return arrays;
}

constexpr GLuint kPerVertex = 0;
constexpr GLuint kPerInstance = 1;
constexpr GLuint kSecondUvs = 2;

/// Binds a buffer of scene::Vertex to the attributes of an array.
void setVertices(gl::VertexArray& array, const gl::Buffer& vertices) {
  using scene::Vertex;
  array.setBuffer(kPerVertex, vertices, sizeof(Vertex), 0);
  const gl::AttributeFormat formats[] = {
      {gpu::kAttributePosition, 3, GL_FLOAT, false, false, offsetof(Vertex, position)},
      {gpu::kAttributeNormal, 4, GL_INT_2_10_10_10_REV, true, false, offsetof(Vertex, normal)},
      {gpu::kAttributeUv, 2, GL_FLOAT, false, false, offsetof(Vertex, uv)},
      {gpu::kAttributeColor, 4, GL_UNSIGNED_BYTE, true, false, offsetof(Vertex, color)},
      {gpu::kAttributeMaterial, 1, GL_UNSIGNED_INT, false, true, offsetof(Vertex, material)},
  };
  for (const gl::AttributeFormat& format : formats)
    array.setAttribute(kPerVertex, format);
}

}  // namespace

SceneBuffers::SceneBuffers(const scene::SceneData& scene)
    : objectCount_(static_cast<std::uint32_t>(scene.objects.size())),
      transformCount_(static_cast<std::uint32_t>(scene.transforms.size())),
      cellCount_(static_cast<std::uint32_t>(scene.cells.objects.size())),
      usesBlending_(scene.usesBlending),
      vertices_(upload(scene.vertices, "vertices")),
      secondUvs_(upload(scene.secondUvs, "second texture coordinates")),
      indices_(upload(scene.indices, "indices")),
      transforms_(uploadStorage(scene.transforms, "transforms")),
      objects_(uploadStorage(scene.objects, "objects")),
      chains_(uploadStorage(scene.chains, "chains")),
      lods_(uploadStorage(scene.lods, "lods")),
      cells_(uploadStorage(scene.cells.objects, "cells")),
      cellChains_(uploadStorage(scene.cells.chains, "chains of cells")),
      cellLods_(uploadStorage(scene.cells.lods, "lods of cells")),
      cellBounds_(uploadStorage(scene.cells.bounds, "bounds of cells")),
      materials_(uploadStorage(scene.materials, "materials")),
      textures_(makeTextures(scene.textures)),
      vertexArray_("scene"),
      looseLineVertices_(scene.loose.lineVertices),
      loosePoints_(scene.loose.points()),
      looseVertices_(upload(scene.loose.vertices, "points and lines")),
      looseArray_("points and lines") {
  setVertices(looseArray_, looseVertices_);
  setVertices(vertexArray_, vertices_);
  if (!scene.secondUvs.empty()) {
    vertexArray_.setBuffer(kSecondUvs, secondUvs_, sizeof(glm::vec2), 0);
    vertexArray_.setAttribute(kSecondUvs, {gpu::kAttributeUv1, 2, GL_FLOAT, false, false, 0});
  }
  vertexArray_.setAttribute(kPerInstance, {gpu::kAttributeObject, 1, GL_UNSIGNED_INT, false, true, 0});
  vertexArray_.setIndexBuffer(indices_);
}

visibility::SceneBindings SceneBuffers::bindings() const {
  if (cellCount_ == 0) return {&transforms_, &objects_, &chains_, &lods_};
  return {&transforms_, &objects_, &chains_, &lods_, &cells_, &cellChains_, &cellLods_, &cellBounds_};
}

void SceneBuffers::bindForDrawing(const gl::Buffer& instances) {
  // An instanced attribute turns baseInstance into the object id (core 4.5).
  vertexArray_.setBuffer(kPerInstance, instances, sizeof(std::uint32_t), 1);
  vertexArray_.bind();
  const visibility::SceneBindings drawn = bindings().drawn();
  drawn.transforms->bindStorage(gpu::kBindingTransforms);
  drawn.objects->bindStorage(gpu::kBindingObjects);
  drawn.chains->bindStorage(gpu::kBindingChains);
  instances.bindStorage(gpu::kBindingDrawInstances);
  bindMaterials();
}

void SceneBuffers::bindForLoose() const {
  looseArray_.bind();
  bindMaterials();
}

void SceneBuffers::bindMaterials() const {
  materials_.bindStorage(gpu::kBindingMaterials);
  for (std::uint32_t i = 0; i < textures_.size(); ++i)
    textures_[i].bind(gpu::kUnitBaseColor + i);
}

}  // namespace jalousie::render
