// State per list: solid lists cull back faces in the rasteriser, sheet and blend lists decide per fragment.
#include "render/draw_pass.h"

#include "render/program_table.h"

namespace jalousie::render {
namespace {

/// A program that reads materials.
gl::Program makeProgram(unsigned id, const DrawFeatures& features, const gl::ShaderLibrary& shaders) {
  gl::ProgramSource source = programTable()[id];
  if (features.capabilities.drawParameters) source = gl::withDefine(source, kDrawParametersDefine);
  if (features.fullMaterials) source = gl::withDefine(source, kFullMaterialsDefine);
  return gl::Program(gl::withDefine(source, textureClassesDefine(features.textureClasses)), shaders);
}

/// Consecutive programs of the table.
template <std::size_t kCount>
std::array<gl::Program, kCount> makePrograms(ProgramId first, const DrawFeatures& features,
                                             const gl::ShaderLibrary& shaders) {
  std::array<gl::Program, kCount> programs;
  for (unsigned i = 0; i < programs.size(); ++i)
    programs[i] = makeProgram(static_cast<unsigned>(first) + i, features, shaders);
  return programs;
}

}  // namespace

DrawPass::DrawPass(const DrawFeatures& features, const gl::ShaderLibrary& shaders)
    : indirectCount_(features.capabilities.indirectCount),
      shaded_(makePrograms<4>(ProgramId::kShadedSolid, features, shaders)),
      opacity_(makePrograms<4>(ProgramId::kOpacitySolid, features, shaders)),
      id_(makePrograms<4>(ProgramId::kIdSolid, features, shaders)),
      density_(makePrograms<2>(ProgramId::kDensity, features, shaders)),
      loose_(features.loose ? makeProgram(static_cast<unsigned>(ProgramId::kLoose), features, shaders) : gl::Program()),
      mapView_(programSource(ProgramId::kMapView), shaders),
      depthView_(programSource(ProgramId::kDepthView), shaders),
      overdrawView_(programSource(ProgramId::kOverdrawView), shaders),
      boxes_(programSource(ProgramId::kBoxes), shaders),
      noInput_("no vertex input"),
      view_(sizeof(gpu::DrawView), GL_DYNAMIC_STORAGE_BIT, "draw view") {}

void DrawPass::setView(const gpu::DrawView& view) {
  view_.writeValue(view);
  patches_ = view.patches != 0;
}

void DrawPass::draw(DrawKind kind, DrawPart part, SceneBuffers& scene, const visibility::DrawList& list,
                    const visibility::ObjectBuffers& decided) const {
  if (scene.objectCount() == 0) return;
  if (part == DrawPart::kBlended && !scene.usesBlending()) return;
  scene.bindForDrawing(list.instances());
  bindObjects(decided);
  glBindBuffer(GL_DRAW_INDIRECT_BUFFER, list.commands().id());
  const unsigned paths = patches_ && list.options().patches ? 2 : 1;
  for (unsigned path = 0; path < paths; ++path) {
    const GLenum primitive = path == 0 ? GL_TRIANGLES : GL_PATCHES;
    const unsigned firstList = gpu::kListsPerDetail * path;
    const auto drawList = [&](unsigned surface) {
      use(kind, path, surface);
      submit(primitive, list, firstList + surface);
    };
    if (part == DrawPart::kOpaque) {
      drawList(gpu::kListSolid);
      drawList(gpu::kListSheet);
    } else {
      drawList(gpu::kListBlend);
    }
  }
  glDisable(GL_CULL_FACE);
}

void DrawPass::bindObjects(const visibility::ObjectBuffers& decided) const {
  decided.states->bindStorage(gpu::kBindingStates);
  decided.marks->bindStorage(gpu::kBindingMarks);
  decided.boxes->bindStorage(gpu::kBindingDrawBoxes);
  view_.bindUniform(gpu::kBindingDrawView);
  glPatchParameteri(GL_PATCH_VERTICES, 3);
}

void DrawPass::bindForSlices(SceneBuffers& scene, const SliceList& list,
                             const visibility::ObjectBuffers& decided) const {
  scene.bindForDrawing(*list.instances);
  bindObjects(decided);
  glBindBuffer(GL_DRAW_INDIRECT_BUFFER, list.commands->id());
}

void DrawPass::use(DrawKind kind, unsigned path, unsigned surface) const {
  const bool solid = surface == gpu::kListSolid;
  (solid ? glEnable : glDisable)(GL_CULL_FACE);
  programOf(kind, path, solid ? 0 : 1).use();
}

void DrawPass::submitSlice(unsigned path, unsigned surface, const SliceList& list, const SlicePlaces& places) const {
  const GLenum primitive = path == 0 ? GL_TRIANGLES : GL_PATCHES;
  const std::size_t firstOfList = std::size_t{gpu::kListsPerDetail * path + surface} * list.capacity;
  const auto draw = [&](std::size_t first) {
    const std::size_t offset = sizeof(gpu::DrawCommand) * (firstOfList + first);
    glMultiDrawElementsIndirect(primitive, GL_UNSIGNED_INT, reinterpret_cast<const void*>(offset),
                                static_cast<GLsizei>(places.count * list.each), 0);
  };
  const std::size_t first = std::size_t{places.first} * list.each;
  draw(first);
  if (list.fading) draw(list.capacity / 2 + first);
}

const gl::Program& DrawPass::programOf(DrawKind kind, unsigned path, unsigned program) const {
  if (kind == DrawKind::kDensity) return density_[path];
  const Programs& programs = kind == DrawKind::kShaded ? shaded_ : kind == DrawKind::kOpacity ? opacity_ : id_;
  return programs[2 * path + program];
}

void DrawPass::submit(GLenum primitive, const visibility::DrawList& list, unsigned index) const {
  const std::size_t offset = sizeof(gpu::DrawCommand) * index * list.commandCapacity();
  const auto* commands = reinterpret_cast<const void*>(offset);
  const auto count = static_cast<GLsizei>(list.commandCapacity());
  if (!indirectCount_) {
    glMultiDrawElementsIndirect(primitive, GL_UNSIGNED_INT, commands, count, 0);
    return;
  }
  // A count buffer left bound truncates later draws that do not use it (seen in Mesa 22.3), so it never stays.
  glBindBuffer(GL_PARAMETER_BUFFER_ARB, list.drawCounts().id());
  glMultiDrawElementsIndirectCountARB(primitive, GL_UNSIGNED_INT, commands,
                                      static_cast<GLintptr>(sizeof(gpu::uint) * index), count, 0);
  glBindBuffer(GL_PARAMETER_BUFFER_ARB, 0);
}

void DrawPass::drawLoose(const SceneBuffers& scene) const {
  if (scene.looseLineVertices() + scene.loosePoints() == 0) return;
  view_.bindUniform(gpu::kBindingDrawView);
  scene.bindForLoose();
  loose_.use();
  const auto lineVertices = static_cast<GLsizei>(scene.looseLineVertices());
  if (lineVertices > 0) glDrawArrays(GL_LINES, 0, lineVertices);
  if (scene.loosePoints() > 0) glDrawArrays(GL_POINTS, lineVertices, static_cast<GLsizei>(scene.loosePoints()));
}

void DrawPass::drawBoxes(std::uint32_t objectCount, const visibility::ObjectBuffers& decided) const {
  if (objectCount == 0) return;
  view_.bindUniform(gpu::kBindingDrawView);
  decided.states->bindStorage(gpu::kBindingStates);
  decided.boxes->bindStorage(gpu::kBindingDrawBoxes);
  noInput_.bind();
  boxes_.use();
  glDrawArraysInstanced(GL_LINE_LOOP, 0, 4, static_cast<GLsizei>(objectCount));
}

void DrawPass::drawOverdraw(const gl::Texture& halvings) const {
  halvings.bind(gpu::kUnitOcclusionMap);
  noInput_.bind();
  overdrawView_.use();
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

void DrawPass::drawMap(const visibility::OcclusionMapPass& map) const {
  view_.bindUniform(gpu::kBindingDrawView);
  map.texture().bind(gpu::kUnitOcclusionMap);
  noInput_.bind();
  mapView_.use();
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

void DrawPass::drawPyramid(const visibility::DepthPyramidPass& pyramid, const gl::Texture& depth) const {
  view_.bindUniform(gpu::kBindingDrawView);
  pyramid.texture().bind(gpu::kUnitDepthPyramid);
  depth.bind(gpu::kUnitDepth);
  noInput_.bind();
  depthView_.use();
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

}  // namespace jalousie::render
