// Input that the tests of several kernels share: views, screens with structure, and scenes.
#pragma once

#include <cstdint>
#include <vector>

#include "asset/scene_file.h"
#include "policy/frame_policy.h"
#include "scene/camera.h"
#include "scene/scene_data.h"
#include "visibility/depth_pyramid_pass.h"
#include "visibility/depth_pyramid_reference.h"
#include "visibility/occlusion_map_pass.h"
#include "visibility/occlusion_map_reference.h"

namespace jalousie::visibility {

struct ScreenSize {
  std::uint32_t width, height;
};
inline constexpr ScreenSize kSizes[] = {{640, 360}, {1366, 77}, {333, 97}, {64, 64}, {1, 1}, {1, 200}};

/// The mode of the thesis with its level rule, and no measure.
inline constexpr FramePolicy kThesisPolicy{
    .cullMode = CullMode::kHom, .lodRule = LodRule::kLinear, .lvMeasure = LvMeasure::kNone};

gpu::CullView makeView(const scene::SceneData& scene, const scene::Camera& camera, ScreenSize size,
                       float occluderDistance, const FramePolicy& policy = kThesisPolicy);

/// Random cover with structure at several scales: pixels, stripes and blocks. 1 where a pixel is open, else 0.
std::vector<float> structuredPixels(ScreenSize size, std::uint64_t seed);
/// Depth with structure: a far wall, nearer cells, and holes.
std::vector<float> structuredDepth(ScreenSize size, std::uint64_t seed);

/// Spheres, some mirrored; a third of the objects use a second chain with solid, double-sided and blended boxes.
asset::SceneFile mixedFile(std::uint32_t count);

/// A map whose level 0 is given instead of drawn.
struct GivenMap {
  GivenMap(ScreenSize size, const std::vector<float>& openPixels)
      : pass(mapLayout(size.width, size.height), nullptr), reference(pass.layout(), openPixels) {
    pass.beginOccluders(false);
    glTextureSubImage2D(pass.texture().id(), 0, 0, 0, static_cast<GLsizei>(size.width),
                        static_cast<GLsizei>(size.height), GL_RED, GL_FLOAT, openPixels.data());
    pass.reduce();
  }
  OcclusionMapPass pass;
  OcclusionMapReference reference;
};

/// A depth buffer with given content, and its pyramids.
struct GivenDepth {
  GivenDepth(ScreenSize size, const std::vector<float>& values, DepthSource source, bool fastPaths)
      : texture(GL_TEXTURE_2D, GL_DEPTH_COMPONENT32F, {size.width, size.height, 1, 1}, "given depth"),
        pass(mapLayout(size.width, size.height),
             fastPaths ? gl::queryCapabilities() : gl::queryCapabilities().withoutFastPaths()),
        reference(pass.layout(), values, source == DepthSource::kCovered) {
    glTextureSubImage2D(texture.id(), 0, 0, 0, static_cast<GLsizei>(size.width), static_cast<GLsizei>(size.height),
                        GL_DEPTH_COMPONENT, GL_FLOAT, values.data());
    pass.build(texture, source);
  }
  gl::Texture texture;
  DepthPyramidPass pass;
  DepthPyramidReference reference;
};

}  // namespace jalousie::visibility
