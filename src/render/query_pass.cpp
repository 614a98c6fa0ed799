// Draws wait until a query needs them: ranges that follow each other become one.
#include "render/query_pass.h"

#include <algorithm>
#include <numeric>

#include "core/check.h"
#include "render/program_table.h"

namespace jalousie::render {
namespace {

constexpr GLsizei kBoxVertices = 36;

}  // namespace

QueryPass::QueryPass(const gl::ShaderLibrary& shaders)
    : program_(programSource(ProgramId::kQueryBox), shaders),
      maskedProgram_(programSource(ProgramId::kQueryBoxMasked), shaders),
      input_("query boxes") {}

QueryPass::~QueryPass() {
  if (!queries_.empty()) glDeleteQueries(static_cast<GLsizei>(queries_.size()), queries_.data());
}

void QueryPass::allocate(std::uint32_t nodes) {
  boxes_ = gl::Buffer(sizeof(Aabb) * std::max(nodes, 1U), GL_DYNAMIC_STORAGE_BIT, "boxes of nodes");
  input_.setBuffer(0, boxes_, sizeof(Aabb), 1);
  input_.setAttribute(0, {0, 3, GL_FLOAT, false, false, 0});
  input_.setAttribute(0, {1, 3, GL_FLOAT, false, false, sizeof(glm::vec3)});
  queries_.resize(kMostQueries);
  glCreateQueries(GL_SAMPLES_PASSED, static_cast<GLsizei>(queries_.size()), queries_.data());
  free_.resize(kMostQueries);
  std::iota(free_.rbegin(), free_.rend(), 0U);
  upload_.reserve(nodes);
  waiting_.reserve(kMostQueries);
  places_.reserve(kMostQueries);
  ranges_.reserve(kMostQueries);
}

void QueryPass::setBoxes(const culling::SpatialHierarchy& tree) {
  if (tree.nodes.empty()) return;
  upload_.clear();
  for (const culling::HierarchyNode& node : tree.nodes)
    upload_.push_back(node.boundsWorld);
  boxes_.write(0, std::as_bytes(std::span<const Aabb>(upload_)));
  drawnBits_.assign((tree.objects.size() + 31) / 32, 0);
}

void QueryPass::begin(const FrameContext& frame, SlicePass& slices, const SliceOrder& order, DeferredDrawing deferred) {
  frame_ = &frame;
  slices_ = &slices;
  order_ = &order;
  deferred_ = deferred;
  masked_ = frame.queryOptions.importance > 0.0F && frame.visibility.hasImportance();
  asking_ = false;
  drawCalls_ = 0;
  figures() = {};
  std::fill(drawnBits_.begin(), drawnBits_.end(), 0U);
  drawMode();
}

void QueryPass::finish() {
  flush();
  drawMode();
}

void QueryPass::drawMode() {
  asking_ = false;
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glDepthMask(GL_TRUE);
  glDepthFunc(GL_GREATER);
}

void QueryPass::askMode() {
  flush();
  if (asking_) return;
  asking_ = true;
  glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  glDepthMask(GL_FALSE);
  glDepthFunc(GL_GEQUAL);
  (masked_ ? maskedProgram_ : program_).use();
  if (masked_) slices_->bindView();
  input_.bind();
  frame_->visibility.decided().view->bindUniform(gpu::kBindingCullView);
}

QueryPass::Query QueryPass::startQuery(std::span<const std::uint32_t> nodes) {
  JAL_CHECK(!free_.empty());
  askMode();
  const Query query = free_.back();
  free_.pop_back();
  glBeginQuery(GL_SAMPLES_PASSED, queries_[query]);
  for (const std::uint32_t node : nodes)
    glDrawArraysInstancedBaseInstance(GL_TRIANGLES, 0, kBoxVertices, 1, node);
  glEndQuery(GL_SAMPLES_PASSED);
  return query;
}

std::uint64_t QueryPass::takeAnswer(Query query) {
  GLuint64 samples = 0;
  glGetQueryObjectui64v(queries_[query], GL_QUERY_RESULT, &samples);
  free_.push_back(query);
  return samples;
}

void QueryPass::markDrawn(std::uint32_t first, std::uint32_t count) {
  for (std::uint32_t place = first; place < first + count; ++place)
    drawnBits_[place / 32] |= 1U << place % 32;
}

void QueryPass::drawObjects(std::uint32_t first, std::uint32_t count) {
  markDrawn(first, count);
  const SlicePlaces units = order_->unitsOf(first, count);
  if (units.count == 0) return;
  if (!waiting_.empty() && waiting_.back().first + waiting_.back().count == units.first) {
    waiting_.back().count += units.count;
    return;
  }
  if (waiting_.size() == waiting_.capacity()) flush();
  waiting_.push_back(units);
}

void QueryPass::flush() {
  if (waiting_.empty()) return;
  drawMode();
  drawPlaces(waiting_);
  waiting_.clear();
}

/// @param conditions  one for each range, or none
void QueryPass::drawPlaces(std::span<const SlicePlaces> places, std::span<const Conditional> conditions) {
  const SliceList list = slices_->list(frame_->cullView.calm != 0);
  frame_->draw.drawSlices(places, frame_->scene, list, frame_->visibility.decided(),
                          [&](std::size_t i, const auto& draw) {
                            if (!conditions.empty())
                              glBeginConditionalRender(queries_[conditions[i].query], GL_QUERY_WAIT);
                            draw();
                            if (!conditions.empty()) glEndConditionalRender();
                            ++drawCalls_;
                          });
}

void QueryPass::drawConditionally(std::span<const Conditional> ranges) {
  flush();
  places_.clear();
  ranges_.clear();
  for (const Conditional& range : ranges) {
    markDrawn(range.first, range.count);
    const SlicePlaces units = order_->unitsOf(range.first, range.count);
    places_.push_back(units);
    const std::uint32_t leaf = order_->leafOf[range.first];
    ranges_.push_back({units.first, units.count, leaf, 0});
    // The marks need the counts after the frame in both cases.
    glGetQueryBufferObjectuiv(queries_[range.query], slices_->samples().id(), GL_QUERY_RESULT,
                              static_cast<GLintptr>(sizeof(gpu::uint) * leaf));
  }
  const bool inBuffer = deferred_ == DeferredDrawing::kBuffer;
  if (inBuffer) slices_->dropHidden(ranges_);
  drawMode();
  drawPlaces(places_, inBuffer ? std::span<const Conditional>() : ranges);
  for (const Conditional& range : ranges)
    free_.push_back(range.query);
}

}  // namespace jalousie::render
