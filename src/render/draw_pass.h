// Draws the command lists: one multi-draw-indirect call per list.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "gl/buffer.h"
#include "gl/capabilities.h"
#include "gl/program.h"
#include "render/scene_buffers.h"
#include "shared/frame_structs.h"
#include "shared/limits.h"
#include "visibility/depth_pyramid_pass.h"
#include "visibility/draw_list_pass.h"
#include "visibility/occlusion_map_pass.h"

namespace jalousie::render {

/// What a draw pass writes.
enum class DrawKind { kShaded, kOpacity, kId, kDensity };

/// Which surfaces it draws: blended ones come last and never occlude.
enum class DrawPart { kOpaque, kBlended };

/// Commands at fixed places, so that a range of places can be drawn at a time (slice_commands.comp).
struct SliceList {
  const gl::Buffer* instances = nullptr;
  const gl::Buffer* commands = nullptr;  ///< gpu::DrawCommand [lists][capacity]
  std::uint32_t capacity = 0;            ///< commands per list; the second half is for fading levels
  std::uint32_t each = 1;                ///< commands of each place
  bool patches = false;                  ///< the lists of patches exist
  bool fading = false;                   ///< levels may fade out in this frame
};

/// Places of a SliceList.
struct SlicePlaces {
  std::uint32_t first = 0;
  std::uint32_t count = 0;
};

/// What the programs are built for.
struct DrawFeatures {
  /// Draw parameters and count draws are used where they are named; results are the same without.
  const gl::Capabilities& capabilities;
  std::uint32_t textureClasses = 1;  ///< SceneBuffers::textureClasses
  bool fullMaterials = false;        ///< SceneData::usesFullMaterials
  bool loose = false;                ///< the scene has points or lines
};

/// The programs of all lists, and the loop over them.
class DrawPass {
 public:
  explicit DrawPass(const DrawFeatures& features, const gl::ShaderLibrary& shaders = {});

  /// Uploads the drawing camera for all programs, and takes the detail path of the draws that follow from it.
  void setView(const gpu::DrawView& view);
  /// Draws one part of a list's objects into the bound framebuffer.
  void draw(DrawKind kind, DrawPart part, SceneBuffers& scene, const visibility::DrawList& list,
            const visibility::ObjectBuffers& decided) const;
  /// Draws the opaque surfaces of some places, shaded, into the bound framebuffer.
  /// @param each  called as each(i, draw) for every range and program: draw() issues the commands of ranges[i]
  template <class Each>
  void drawSlices(std::span<const SlicePlaces> ranges, SceneBuffers& scene, const SliceList& list,
                  const visibility::ObjectBuffers& decided, const Each& each) const {
    bindForSlices(scene, list, decided);
    const unsigned paths = patches_ && list.patches ? 2 : 1;
    for (unsigned path = 0; path < paths; ++path) {
      for (const unsigned surface : {gpu::kListSolid, gpu::kListSheet}) {
        use(DrawKind::kShaded, path, surface);
        for (std::size_t i = 0; i < ranges.size(); ++i)
          each(i, [&] { submitSlice(path, surface, list, ranges[i]); });
      }
    }
    endSlices();
  }
  /// Draws all points and lines of a scene into the bound framebuffer.
  void drawLoose(const SceneBuffers& scene) const;
  /// Outlines the rectangle of every object. @param decided  of the frame
  void drawBoxes(std::uint32_t objectCount, const visibility::ObjectBuffers& decided) const;
  /// Shows how many surfaces lie on a pixel. @param halvings  2^-surfaces
  void drawOverdraw(const gl::Texture& halvings) const;
  /// Fills the bound framebuffer with one level of the occlusion map.
  void drawMap(const visibility::OcclusionMapPass& map) const;
  /// The same with one level of the depth pyramid. @param depth  its level 0
  void drawPyramid(const visibility::DepthPyramidPass& pyramid, const gl::Texture& depth) const;

 private:
  using Programs = std::array<gl::Program, 4>;  ///< solid, sheet, solid patch, sheet patch
  /// @param path  0: triangles, 1: patches   @param program  0: solid, 1: sheet
  const gl::Program& programOf(DrawKind kind, unsigned path, unsigned program) const;
  void bindForSlices(SceneBuffers& scene, const SliceList& list, const visibility::ObjectBuffers& decided) const;
  void bindObjects(const visibility::ObjectBuffers& decided) const;
  /// State and program of a surface. @param path  0: triangles, 1: patches   @param surface  kListSolid, ...
  void use(DrawKind kind, unsigned path, unsigned surface) const;
  void submitSlice(unsigned path, unsigned surface, const SliceList& list, const SlicePlaces& places) const;
  static void endSlices() { glDisable(GL_CULL_FACE); }
  void submit(GLenum primitive, const visibility::DrawList& list, unsigned index) const;

  bool indirectCount_;
  Programs shaded_;
  Programs opacity_;
  Programs id_;
  std::array<gl::Program, 2> density_;  ///< triangles, patches; for solid surfaces and sheets
  gl::Program loose_;                   ///< points and lines; made only where the scene has any
  gl::Program mapView_;
  gl::Program depthView_;
  gl::Program overdrawView_;
  gl::Program boxes_;
  gl::VertexArray noInput_;
  gl::Buffer view_;
  bool patches_ = false;  ///< gpu::DrawView::patches of the last setView()
};

}  // namespace jalousie::render
