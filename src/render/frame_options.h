// What a renderer is made for, and what one frame draws and how it decides it: plain values.
#pragma once

#include <cstdint>
#include <optional>

#include "core/memory_limit.h"
#include "culling/occluder_options.h"
#include "culling/query_options.h"
#include "policy/face_culling.h"
#include "policy/frame_policy.h"
#include "shared/limits.h"
#include "visibility/submission.h"

namespace jalousie::gl {
class ShaderLibrary;
}
namespace jalousie::visibility {
class ImportanceMask;
}

namespace jalousie::render {

/// Pixels are counted in one frame of so many; a count is used until the next (docs/level_of_visibility.md).
inline constexpr std::uint32_t kCountInterval = 4;

/// What to draw and how to decide it, frame by frame.
struct FrameOptions : FramePolicy {
  float tau = 1.0F;     ///< screen-space error allowed, pixels; LodRule::kLvError allows partly occluded objects more
  float relax = 64.0F;  ///< LodRule::kLvError: tau grows to at most tau * (1 + relax)
  /// LodRule::kPrice: no level is drawn whose largest deviation is more pixels, unless no pixel shows the object; 0:
  /// all levels are allowed.
  float maxError = gpu::kDefaultMaxError;
  /// LodRule::kPrice: the price is moved from frame to frame so that a frame has this many triangles; 0: the price
  /// follows from tau alone. tau still says how the error of important regions is weighed.
  gpu::uint triangleBudget = 0;
  float hysteresis = gpu::kDefaultHysteresis;      ///< calm: keep a level while tau * hysteresis and tau / hysteresis
                                                   ///< allow it; >= 1
  gpu::uint fadeFrames = gpu::kDefaultFadeFrames;  ///< calm: frames of a cross-fade, <= kMaxFadeFrames; 0: none
  /// Objects whose bounding rectangle covers fewer pixels are not drawn; 0: all are.
  float minPixels = 0.0F;
  /// Objects whose bounding sphere covers fewer pixels are not drawn (detail culling); 0: all are.
  float minSpherePixels = 0.0F;
  /// Finest level of the patch path; lowered to tessellationLimit() where the driver would lose triangles.
  gpu::uint maxTessellation = gpu::kMaxTessellationLevel;
  gpu::uint mapLevel = 0;  ///< level shown by View::kOcclusion
  bool boxes = false;      ///< outline every object's bounding rectangle; nothing where the culling camera is frozen
  /// World units; objects nearer than this are occluders. Absent: automaticOccluderDistance().
  std::optional<float> occluderDistance;
  /// Screen-space error of the levels drawn into the occlusion map, pixels. Absent: CullModeRow::occluderTau.
  std::optional<float> occluderTau;
  float cullThreshold = 1.0F;  ///< opacity from which a texel occludes; below 1 is not conservative
  bool cullCells = true;       ///< in scenes with cells: cull them one by one; false: as their objects
  /// Time of the scene's animations (SceneData::motion), seconds.
  float seconds = 0.0F;
  /// Groups of back faces are left out, in scenes with SceneData::faces and in modes without queries.
  FaceCulling faceCulling = FaceCulling::kOff;
  culling::QueryOptions queries;       ///< of the modes that ask queries
  culling::OccluderOptions occluders;  ///< of the modes that cast shadows
  bool skipDraw = false;               ///< leave out what only the picture needs: statistics without a picture
};

/// What a renderer allocates and which paths it takes.
struct RendererOptions {
  visibility::Submission submission = visibility::Submission::kInstanced;
  bool fastPaths = true;  ///< use extensions where the driver has them; the results are the same
  /// Most instances one draw list holds; absent: all objects. Further instances are not drawn; they are counted and
  /// reported.
  std::optional<std::uint32_t> capacity = {};
  /// Limit on what the renderer's buffers, textures and targets need by memory_needs.h; checked before they are
  /// allocated.
  MemoryLimit memory = {};
  /// Scales tau and minPixels by region; only read by the constructor. May be null.
  const visibility::ImportanceMask* importance = nullptr;
  /// Where shader texts come from; null: the embedded ones. Only read by the constructor.
  const gl::ShaderLibrary* shaders = nullptr;
};

}  // namespace jalousie::render
