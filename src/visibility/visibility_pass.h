// The kernels that decide per object: classify and analyse, and the count of visible pixels.
#pragma once

#include <optional>

#include "gl/buffer.h"
#include "gl/program.h"
#include "gl/texture.h"
#include "shared/frame_structs.h"
#include "visibility/importance_mask.h"
#include "visibility/object_store.h"
#include "visibility/pass_bindings.h"
#include "visibility/program_table.h"

namespace jalousie::visibility {

/// Decides, for every object and without a read-back, whether it is drawn, when, and how finely.
/// Call order per frame: setView, classify, [draw the objects with kMarkEarly, build map or pyramid, analyse],
/// [countPixels].
class VisibilityPass {
 public:
  /// Keeps a reference to objects, which must outlive the pass. Nothing is allocated later.
  explicit VisibilityPass(ObjectStore& objects, const ImportanceMask* importance = nullptr,
                          const gl::ShaderLibrary& shaders = {});

  /// Uploads camera and policy for the kernels; fills in the importance mask's size.
  /// @pre view.objectCount and cellCount equal the store's (checked)
  void setView(gpu::CullView view);
  /// Verdict, screen box, phase and first detail of every object; phase of every cell. Leaves a STORAGE barrier.
  void classify(const SceneBindings& scene);
  /// Overlap test and LV of the objects that classify left pending; overlap test of the cells of what passes. Leaves a
  /// STORAGE barrier.
  /// @param traits  gpu::CullView::traits, with kTraitUsesMap, kTraitUsesDepth or both
  void analyse(const SceneBindings& scene, gpu::uint traits, const CoverTextures& cover);
  /// Decides about the cells again after levels have changed. Before the first phase: as classify. Before the second:
  /// as analyse, in modes that test occlusion, and before that as classify in modes with one phase. Leaves a STORAGE
  /// barrier.
  /// @param groups  words, with those of the dispatch at kBudgetCellGroups   @param phase  the next one that is drawn
  void repeatCells(const SceneBindings& scene, gpu::uint traits, const gl::Buffer& groups, gpu::uint phase) const;
  /// Counts the visible pixels of each object, for the LV of the next frames (kTraitLvPixels). Call after the frame is
  /// drawn.
  /// @param items  GL_R32UI, object index + 1 per pixel, 0 for none. Leaves a STORAGE barrier.
  void countPixels(const gl::Texture& items);
  ObjectBuffers decided() const;
  /// Whether classify leaves an importance mask bound at kUnitImportance.
  bool hasImportance() const { return importance_.has_value(); }

 private:
  /// A kernel for objects, and the one for their cells where the scene has any.
  struct Programs {
    Programs(ProgramId objectsId, ProgramId cellsId, bool hasCells, const gl::ShaderLibrary& shaders);
    gl::Program objects;
    std::optional<gl::Program> cells;
  };

  void run(const Programs& programs, const SceneBindings& scene) const;
  void dispatch(const gl::Program& program, const SceneBindings& scene) const;
  void dispatchCells(const gl::Program& program, const SceneBindings& scene, const gl::Buffer* groups) const;
  const Programs& analysis(gpu::uint traits) const;

  ObjectStore& objects_;
  Programs classify_;
  Programs analyseMap_;
  Programs analyseMapDepth_;
  Programs analyseDepth_;
  gl::Program countPixelsProgram_;
  gl::Buffer view_;
  gl::Buffer cosines_;
  std::optional<gl::Texture> importance_;
  gpu::uint importanceWidth_ = 0;
  gpu::uint importanceHeight_ = 0;
};

}  // namespace jalousie::visibility
