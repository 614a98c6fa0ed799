// Plain CPU twin of the kernels that cull groups of back faces: face_ranges and face_commands.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "shared/face_structs.h"
#include "shared/frame_structs.h"
#include "shared/scene_structs.h"

namespace jalousie::scene {
struct FaceTables;
}

namespace jalousie::visibility {

/// One instance as the tests see it. Twin of lib/faces.glsl.
struct FaceFrame {
  glm::vec4 eye{0.0F};    ///< object space: the eye (w = 1), or against the direction of view (w = 0)
  glm::vec4 depth{0.0F};  ///< distance of a point along the direction of view: dot(depth, (p, 1)), world units
  float scale = 0.0F;     ///< bound of the lengthening by the transform
  float volume = 0.0F;    ///< |determinant|
  float roundWorld = 0.0F;
  float roundObject = 0.0F;
};

FaceFrame faceFrame(const gpu::CullView& view, const gpu::Transform& transform, const gpu::FaceLod& lod);
/// Where a group lies, and what n.(p - eye) has to exceed, so that no rasteriser makes a front face of a triangle.
struct FaceMargin {
  float nearest = 0.0F;  ///< least and largest w of its points
  float farthest = 0.0F;
  float least = 0.0F;  ///< kFaceNever, infinite or no number if the group must be drawn
};

FaceMargin faceMargin(const gpu::CullView& view, const FaceFrame& frame, const gpu::Transform& transform,
                      const gpu::FaceNode& node);

/// An entry of an instance list.
struct FaceInstance {
  gpu::uint unit = 0;  ///< object, or cell where the scene has cells
  gpu::uint bin = 0;   ///< 2 * level + sheet
};

/// What replaces the commands of a list.
struct FaceCommands {
  std::array<std::vector<gpu::DrawCommand>, 2> commands;  ///< kListSolid and kListSheet
  std::uint64_t tested = 0;                               ///< triangles of groups
  std::uint64_t culled = 0;                               ///< of these, triangles that are not drawn
  std::uint64_t whole = 0;                                ///< triangles without groups
};

/// Commands at fixed places. Twin of slice_faces.comp.
/// @param places  [2 * places] what is drawn there, the second half for levels that fade out; absent: nothing
/// @return  [kListSolid, kListSheet][2 * places][mostRanges + 1]; what is not needed is empty
std::vector<gpu::DrawCommand> sliceFaces(const scene::FaceTables& faces, std::span<const gpu::Transform> transforms,
                                         const gpu::CullView& view, const gpu::FaceView& faceView,
                                         std::span<const std::optional<FaceInstance>> places);

/// @param instances  in the order of the list
FaceCommands cullFaces(const scene::FaceTables& faces, std::span<const gpu::Transform> transforms,
                       const gpu::CullView& view, const gpu::FaceView& faceView,
                       std::span<const FaceInstance> instances);

}  // namespace jalousie::visibility
