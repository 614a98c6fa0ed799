// Overdraw is counted by halving a float per surface: exact up to 126, and no program of its own is needed.
#include "render/debug_views.h"

#include <array>

namespace jalousie::render {
namespace {

constexpr float kNoSurface = 1.0F;
/// Towards the eye: depth is reversed.
constexpr float kLineOffset = 1.0F;

void drawEverything(DrawKind kind, const DrawnFrame& frame, const DrawPass& pass, SceneBuffers& buffers) {
  const visibility::ObjectBuffers decided = frame.visibility->decided();
  for (const DrawPart part : {DrawPart::kOpaque, DrawPart::kBlended}) {
    if (frame.twoPhases) pass.draw(kind, part, buffers, *frame.early, decided);
    pass.draw(kind, part, buffers, *frame.late, decided);
  }
}

void setPart(DrawPass& pass, const DrawnFrame& frame, gpu::uint view) {
  gpu::DrawView part = frame.view;
  part.view = view;
  pass.setView(part);
}

}  // namespace

DebugViews::Halvings::Halvings(std::uint32_t width, std::uint32_t height)
    : texture(GL_TEXTURE_2D, GL_R32F, {width, height, 1, 1}, "overdraw"), framebuffer(texture, nullptr, "overdraw") {
  texture.setSampling(GL_NEAREST, GL_NEAREST, GL_CLAMP_TO_EDGE);
}

void DebugViews::draw(const DrawnFrame& frame, DrawPass& pass, SceneBuffers& buffers, visibility::DrawListPass& lists) {
  switch (frame.view.view) {
    case gpu::kViewWireframe:
      return drawLines(frame, pass, buffers);
    case gpu::kViewOverdraw:
      return drawOverdraw(frame, pass, buffers);
    case gpu::kViewDensity:
      return drawDensity(frame, pass, buffers);
    case gpu::kViewGhosts:
      return drawGhosts(frame, pass, buffers, lists);
    default:
      return;  // bounding rectangles alone
  }
}

void DebugViews::drawLines(const DrawnFrame& frame, DrawPass& pass, SceneBuffers& buffers) {
  setPart(pass, frame, gpu::kViewLines);
  frame.target->bind(frame.view.viewportWidth, frame.view.viewportHeight);
  glEnable(GL_DEPTH_TEST);
  glDepthFunc(GL_GEQUAL);
  glPolygonMode(GL_FRONT_AND_BACK, GL_LINE);
  glEnable(GL_POLYGON_OFFSET_LINE);
  glPolygonOffset(kLineOffset, kLineOffset);
  drawEverything(DrawKind::kShaded, frame, pass, buffers);
  glDisable(GL_POLYGON_OFFSET_LINE);
  glPolygonMode(GL_FRONT_AND_BACK, GL_FILL);
  glDepthFunc(GL_GREATER);
  glDisable(GL_DEPTH_TEST);
}

void DebugViews::drawOverdraw(const DrawnFrame& frame, DrawPass& pass, SceneBuffers& buffers) {
  if (!halvings_) halvings_.emplace(frame.view.viewportWidth, frame.view.viewportHeight);
  pass.setView(frame.view);
  halvings_->framebuffer.bind(frame.view.viewportWidth, frame.view.viewportHeight);
  glClearNamedFramebufferfv(halvings_->framebuffer.id(), GL_COLOR, 0, &kNoSurface);
  glEnable(GL_BLEND);
  glBlendColor(0.5F, 0.5F, 0.5F, 0.5F);
  glBlendFunc(GL_ZERO, GL_CONSTANT_COLOR);
  drawEverything(DrawKind::kOpacity, frame, pass, buffers);
  glDisable(GL_BLEND);
  frame.colorTarget->bind(frame.view.viewportWidth, frame.view.viewportHeight);
  pass.drawOverdraw(halvings_->texture);
}

void DebugViews::drawDensity(const DrawnFrame& frame, DrawPass& pass, SceneBuffers& buffers) {
  pass.setView(frame.view);
  frame.target->bind(frame.view.viewportWidth, frame.view.viewportHeight);
  const std::array<float, 4> black = {0.0F, 0.0F, 0.0F, 1.0F};
  const float farthest = 0.0F;
  glClearNamedFramebufferfv(frame.target->id(), GL_COLOR, 0, black.data());
  glClearNamedFramebufferfv(frame.target->id(), GL_DEPTH, 0, &farthest);
  glEnable(GL_DEPTH_TEST);
  drawEverything(DrawKind::kDensity, frame, pass, buffers);
  glDisable(GL_DEPTH_TEST);
}

visibility::ObjectBuffers DebugViews::buildGhosts(const DrawnFrame& frame, SceneBuffers& buffers,
                                                  visibility::DrawListPass& lists) {
  if (!ghosts_) ghosts_.emplace(scene_, markGhosts_);
  ghosts_->build(lists, buffers.bindings(), frame.visibility->decided());
  return ghosts_->decided(frame.visibility->decided());
}

void DebugViews::drawLeftOut(const DrawnFrame& frame, DrawPass& pass, SceneBuffers& buffers,
                             visibility::DrawListPass& lists) {
  const visibility::ObjectBuffers decided = buildGhosts(frame, buffers, lists);
  pass.setView(frame.view);
  for (const DrawPart part : {DrawPart::kOpaque, DrawPart::kBlended})
    pass.draw(DrawKind::kId, part, buffers, ghosts_->list(), decided);
}

void DebugViews::drawGhosts(const DrawnFrame& frame, DrawPass& pass, SceneBuffers& buffers,
                            visibility::DrawListPass& lists) {
  const visibility::ObjectBuffers decided = buildGhosts(frame, buffers, lists);
  setPart(pass, frame, gpu::kViewGhost);
  frame.colorTarget->bind(frame.view.viewportWidth, frame.view.viewportHeight);
  glEnable(GL_BLEND);
  glBlendFuncSeparate(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA, GL_ZERO, GL_ONE);
  for (const DrawPart part : {DrawPart::kOpaque, DrawPart::kBlended})
    pass.draw(DrawKind::kShaded, part, buffers, ghosts_->list(), decided);
  glDisable(GL_BLEND);
}

}  // namespace jalousie::render
