// Upload of vertices, indices, scene tables and base colour layers.
#include "render/scene_buffers.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <vector>

#include "core/error.h"

namespace jalousie::render {
namespace {

template <class T>
gl::Buffer upload(const std::vector<T>& elements, const char* name) {
  return gl::Buffer::fromArray(std::span<const T>(elements), name);
}

gl::Texture makeBaseColors(const scene::TextureLayers& textures) {
  const auto layers = static_cast<std::uint32_t>(std::max<std::size_t>(textures.layers.size(), 1));
  GLint maxLayers = 0;
  glGetIntegerv(GL_MAX_ARRAY_TEXTURE_LAYERS, &maxLayers);
  if (layers > static_cast<std::uint32_t>(maxLayers))
    throw Error(ErrorCode::kUnsupported, "the scene has more textures than this driver's texture arrays hold");
  const auto levels = static_cast<std::uint32_t>(std::bit_width(textures.side));
  gl::Texture texture(GL_TEXTURE_2D_ARRAY, GL_SRGB8_ALPHA8, {textures.side, textures.side, layers, levels},
                      "base colours");
  for (std::uint32_t i = 0; i < textures.layers.size(); ++i)
    for (std::uint32_t level = 0; level < levels; ++level)
      texture.uploadLayer(i, level, textures.layers[i][level].pixels);
  if (textures.layers.empty()) texture.uploadLayer(0, 0, std::vector<std::uint8_t>(4, 255));
  texture.setSampling(GL_LINEAR_MIPMAP_LINEAR, GL_LINEAR, GL_REPEAT);
  return texture;
}

constexpr GLuint kPerVertex = 0;
constexpr GLuint kPerInstance = 1;

}  // namespace

SceneBuffers::SceneBuffers(const scene::SceneData& scene)
    : objectCount_(static_cast<std::uint32_t>(scene.objects.size())),
      transformCount_(static_cast<std::uint32_t>(scene.transforms.size())),
      usesBlending_(scene.usesBlending),
      vertices_(upload(scene.vertices, "vertices")),
      indices_(upload(scene.indices, "indices")),
      transforms_(upload(scene.transforms, "transforms")),
      objects_(upload(scene.objects, "objects")),
      chains_(upload(scene.chains, "chains")),
      lods_(upload(scene.lods, "lods")),
      materials_(upload(scene.materials, "materials")),
      baseColors_(makeBaseColors(scene.textures)),
      vertexArray_("scene") {
  using scene::Vertex;
  vertexArray_.setBuffer(kPerVertex, vertices_, sizeof(Vertex), 0);
  const gl::AttributeFormat perVertex[] = {
      {gpu::kAttributePosition, 3, GL_FLOAT, false, false, offsetof(Vertex, position)},
      {gpu::kAttributeNormal, 4, GL_INT_2_10_10_10_REV, true, false, offsetof(Vertex, normal)},
      {gpu::kAttributeUv, 2, GL_FLOAT, false, false, offsetof(Vertex, uv)},
      {gpu::kAttributeColor, 4, GL_UNSIGNED_BYTE, true, false, offsetof(Vertex, color)},
      {gpu::kAttributeMaterial, 1, GL_UNSIGNED_INT, false, true, offsetof(Vertex, material)},
  };
  for (const gl::AttributeFormat& format : perVertex)
    vertexArray_.setAttribute(kPerVertex, format);
  vertexArray_.setAttribute(kPerInstance, {gpu::kAttributeObject, 1, GL_UNSIGNED_INT, false, true, 0});
  vertexArray_.setIndexBuffer(indices_);
}

void SceneBuffers::bindForDrawing(const gl::Buffer& instances) {
  // An instanced attribute turns baseInstance into the object id (core 4.5).
  vertexArray_.setBuffer(kPerInstance, instances, sizeof(std::uint32_t), 1);
  vertexArray_.bind();
  transforms_.bindStorage(gpu::kBindingTransforms);
  objects_.bindStorage(gpu::kBindingObjects);
  chains_.bindStorage(gpu::kBindingChains);
  instances.bindStorage(gpu::kBindingDrawInstances);
  materials_.bindStorage(gpu::kBindingMaterials);
  baseColors_.bind(gpu::kUnitBaseColor);
}

}  // namespace jalousie::render
