// Culls groups of back faces of the instances of a draw list (docs/back_faces.md).
#pragma once

#include <cstdint>

#include "gl/buffer.h"
#include "gl/program.h"
#include "shared/face_structs.h"
#include "shared/query_structs.h"
#include "visibility/draw_list_pass.h"
#include "visibility/pass_bindings.h"

namespace jalousie::scene {
struct FaceTables;
}

namespace jalousie::visibility {

/// Commands of a list: only those in front that are used are drawn.
inline constexpr std::uint32_t kMostFaceCommands = 1U << 19U;
/// Commands of a frame drawn in slices: empty ones between those that are used are drawn, too.
inline constexpr std::uint32_t kMostSliceCommands = 1U << 15U;
/// However many instances a list has, each may have so many ranges.
inline constexpr std::uint32_t kLeastFaceRanges = 4;

/// Ranges that an instance may have, so that the commands stay within a limit where they can.
/// @param mostGroups  of one level   @param capacity  instances   @return  0 without groups
std::uint32_t faceRanges(std::uint64_t mostGroups, std::uint64_t capacity, std::uint32_t most = kMostFaceCommands);

/// What the kernels need for one list. Everything is allocated once.
class FaceWork {
 public:
  /// @param list  with DrawListOptions::faceRanges   Errors: kLimit
  explicit FaceWork(const DrawList& list);
  /// Ranges of an instance that there is room for.
  std::uint32_t ranges() const { return ranges_; }

 private:
  friend class FacePass;
  gpu::ListView view_;
  std::uint32_t ranges_;
  gl::Buffer viewBuffer_;
  gl::Buffer words_;
  gl::Buffer blockSums_;
};

/// What a frame drawn in slices has in place of the commands of one place (slice_faces.comp).
struct FaceSlices {
  const gl::Buffer& commands;    ///< gpu::DrawCommand [kListSolid, kListSheet][2 * places][faceCommands]
  const gl::Buffer& view;        ///< gpu::SliceView
  const gl::Buffer& order;       ///< unit of each place
  const gpu::SliceView& values;  ///< of the view; faceCommands is one more than the ranges of a place
};

/// The kernels, and the groups of a scene. CPU twins: cullFaces, sliceFaces.
class FacePass {
 public:
  /// Errors: kLimit, kShader.
  explicit FacePass(const scene::FaceTables& faces, const gl::ShaderLibrary& shaders = {});

  /// Bytes of the tables of groups.
  std::uint64_t bytes() const { return bytes_; }
  /// Replaces the commands of the solid and sheet lists. Leaves COMMAND and BUFFER_UPDATE barriers.
  /// @param list  built for the present view   @param view  gpu::CullView   @param values  test, not kFacesOff; at most
  /// as many ranges as work has room for
  void cull(const DrawList& list, const FaceWork& work, gpu::FaceView values, const gl::Buffer& transforms,
            const gl::Buffer& view);
  /// Writes the commands of a frame drawn in slices. Leaves COMMAND and SHADER_STORAGE barriers.
  /// @param decided  of what has a place
  void cullSlices(const FaceSlices& slices, gpu::uint test, const gl::Buffer& transforms, const ObjectBuffers& decided);

 private:
  gl::Program rangesProgram_;
  gl::Program scanEntriesProgram_;
  gl::Program scanSumsProgram_;
  gl::Program commandsProgram_;
  gl::Program slicesProgram_;
  std::uint64_t bytes_;
  gl::Buffer view_;
  gl::Buffer nodes_;
  gl::Buffer lods_;
  gl::Buffer units_;
};

}  // namespace jalousie::visibility
