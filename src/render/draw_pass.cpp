// State per list: solid lists cull back faces in the rasteriser, sheet lists decide per fragment.
#include "render/draw_pass.h"

#include "render/program_table.h"

namespace jalousie::render {
namespace {

std::array<gl::Program, gpu::kListCount> makePrograms(ProgramId first) {
  std::array<gl::Program, gpu::kListCount> programs;
  for (unsigned list = 0; list < gpu::kListCount; ++list)
    programs[list] = gl::Program(programTable()[static_cast<unsigned>(first) + list]);
  return programs;
}

bool isPatchList(unsigned list) {
  return list >= gpu::kListSolidPatch;
}
bool isSheetList(unsigned list) {
  return list == gpu::kListSheet || list == gpu::kListSheetPatch;
}

}  // namespace

DrawPass::DrawPass()
    : shaded_(makePrograms(ProgramId::kShadedSolid)),
      opacity_(makePrograms(ProgramId::kOpacitySolid)),
      mapView_(programSource(ProgramId::kMapView)),
      noInput_("no vertex input"),
      view_(sizeof(gpu::DrawView), GL_DYNAMIC_STORAGE_BIT, "draw view") {}

void DrawPass::setView(const gpu::DrawView& view) {
  view_.writeValue(view);
}

void DrawPass::draw(DrawKind kind, gpu::uint detail, const SceneBuffers& scene, const gl::Buffer& commands,
                    const gl::Buffer& states) const {
  if (scene.objectCount() == 0) return;
  scene.bindForDrawing();
  states.bindStorage(gpu::kBindingStates);
  view_.bindUniform(gpu::kBindingDrawView);
  glBindBuffer(GL_DRAW_INDIRECT_BUFFER, commands.id());
  glPatchParameteri(GL_PATCH_VERTICES, 3);
  const unsigned lists = detail == gpu::kDetailTessellation ? gpu::kListCount : gpu::kListSolidPatch;
  for (unsigned list = 0; list < lists; ++list) {
    if (isSheetList(list) && !scene.usesSheets()) continue;
    if (isSheetList(list)) {
      glDisable(GL_CULL_FACE);
    } else {
      glEnable(GL_CULL_FACE);
    }
    (kind == DrawKind::kShaded ? shaded_ : opacity_)[list].use();
    const std::size_t offset = sizeof(gpu::DrawCommand) * list * scene.objectCount();
    glMultiDrawElementsIndirect(isPatchList(list) ? GL_PATCHES : GL_TRIANGLES, GL_UNSIGNED_INT,
                                reinterpret_cast<const void*>(offset), static_cast<GLsizei>(scene.objectCount()), 0);
  }
  glDisable(GL_CULL_FACE);
}

void DrawPass::drawMap(const visibility::OcclusionMapPass& map) const {
  view_.bindUniform(gpu::kBindingDrawView);
  map.texture().bind(gpu::kUnitOcclusionMap);
  noInput_.bind();
  mapView_.use();
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

}  // namespace jalousie::render
