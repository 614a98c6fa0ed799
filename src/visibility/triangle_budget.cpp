// Sums, forecast and choice of the step, object by object.
#include "visibility/triangle_budget.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "policy/traits.h"
#include "scene/scene_data.h"
#include "visibility/frame_counters.h"
#include "visibility/lod_policy.h"

namespace jalousie::visibility {
namespace {

void addTo(BudgetWords& words, gpu::uint at, std::uint64_t triangles) {
  words[at] += static_cast<gpu::uint>(triangles & 1023U);
  words[at + 1] += static_cast<gpu::uint>(triangles >> 10U);
}

/// Stage in which an object's level can still be changed; kBudgetStages: it is not drawn.
gpu::uint stageOf(gpu::uint marks, gpu::uint traits) {
  if (has(traits, gpu::kTraitTwoPhases) && (marks & gpu::kMarkEarly) != 0) return 0;
  return (marks & gpu::kMarkLate) != 0 ? 1 : gpu::kBudgetStages;
}

float limitOf(const gpu::CullView& view, BudgetStage stage) {
  return static_cast<float>(view.triangleBudget) *
         (stage == BudgetStage::kEarly ? gpu::kBudgetLimitEarly : gpu::kBudgetLimitLate);
}

/// Factor of tau and of the limit of the largest deviation after one more step.
float nextScale(float scale, gpu::uint step) {
  return step + 1 == gpu::kBudgetSteps ? gpu::kBudgetLastScale : scale * gpu::kBudgetStepScale;
}

gpu::uint fadingTriangles(std::span<const gpu::Lod> levels, gpu::uint lod, gpu::uint marks, gpu::uint traits) {
  const bool fades = fadeFrames(marks) > 0 && !has(traits, gpu::kTraitPatches);
  return fades ? levels[fadingLod(lod, marks)].triangleCount : 0;
}

/// One stage of one frame.
class Stage {
 public:
  Stage(BudgetFrame& frame, BudgetStage stage)
      : frame_(frame), stage_(stage), drawn_(frame.states.size()), cells_(frame.states.size()) {}

  void sum() {
    const scene::SceneData& scene = frame_.scene;
    const gpu::uint traits = frame_.view.traits;
    if (scene.cells.objects.empty()) {
      for (gpu::uint id = 0; id < frame_.states.size(); ++id)
        add(id, stageOf(frame_.marks[id], traits),
            {trianglesOf(scene, chainOf(id), traits, frame_.states[id]),
             fadingTriangles(levelsOf(id), frame_.states[id].lod, frame_.marks[id], traits)});
      return;
    }
    for (gpu::uint c = 0; c < scene.cells.objects.size(); ++c) {
      const gpu::Object& cell = scene.cells.objects[c];
      const gpu::Chain& chain = scene.cells.chains[cell.chain];
      const auto levels = std::span(scene.cells.lods).subspan(chain.firstLod, chain.lodCount);
      const gpu::uint lod = frame_.states[cell.object].lod;
      add(cell.object, stageOf(frame_.cellMarks[c], traits),
          {levels[lod].triangleCount, fadingTriangles(levels, lod, frame_.marks[cell.object], traits)});
    }
  }

  /// What came into view may be drawn late, at its coarsest level at least.
  void reserve() {
    if (stage_ == BudgetStage::kLate) return;
    for (gpu::uint id = 0; id < frame_.states.size(); ++id) {
      if ((frame_.marks[id] & gpu::kMarkNew) == 0) continue;
      const gpu::ObjectState coarsest{0, chainOf(id).lodCount - 1, 1, 0.0F};
      addTo(frame_.words, gpu::kBudgetReserve, trianglesOf(frame_.scene, chainOf(id), frame_.view.traits, coarsest));
    }
  }

  bool isOver() const {
    const gpu::uint at = gpu::kBudgetDrawn + 2 * static_cast<gpu::uint>(stage_);
    return fixed() + budgetSum(frame_.words, at) > limitOf(frame_.view, stage_);
  }

  void forecast() {
    for (gpu::uint id = 0; id < frame_.states.size(); ++id) {
      if (!canChange(id)) continue;
      float scale = 1.0F;
      for (gpu::uint step = 0; step < gpu::kBudgetSteps; ++step) {
        scale = nextScale(scale, step);
        const gpu::ObjectState state = coarserState(frame_.view, detailOf(id), frame_.marks[id], scale);
        addTo(frame_.words, gpu::kBudgetForecast + 2 * step, drawnAt(id, state));
      }
    }
  }

  void limit() {
    const float scale = scaleWithinLimit();
    const bool patches = has(frame_.view.traits, gpu::kTraitPatches);
    for (gpu::uint id = 0; id < frame_.states.size(); ++id) {
      if (!canChange(id)) continue;
      gpu::ObjectState& state = frame_.states[id];
      gpu::uint& marks = frame_.marks[id];
      const gpu::ObjectState coarser = coarserState(frame_.view, detailOf(id), marks, scale);
      const bool same = patches ? coarser.tessellation == state.tessellation : coarser.lod == state.lod;
      marks &= ~gpu::kMarkFadeMask;  // a second level would count, too
      if (!same) marks |= gpu::kMarkLimited | ((marks & gpu::kMarkKnown) != 0 ? gpu::kMarkSwitched : 0);
      state = coarser;
    }
  }

 private:
  const gpu::Chain& chainOf(gpu::uint id) const { return frame_.scene.chains[frame_.scene.objects[id].chain]; }
  std::span<const gpu::Lod> levelsOf(gpu::uint id) const {
    return std::span(frame_.scene.lods).subspan(chainOf(id).firstLod, chainOf(id).lodCount);
  }
  bool canChange(gpu::uint id) const {
    return stageOf(frame_.marks[id], frame_.view.traits) == static_cast<gpu::uint>(stage_);
  }

  /// Triangles of one object or cell.
  struct Triangles {
    std::uint64_t settled;
    std::uint64_t fading;  ///< of the level that fades out
  };

  /// @param phase  stage of the phase of an object or cell, which is later than that of the object for some cells of an
  /// object that the first phase draws
  void add(gpu::uint id, gpu::uint phase, const Triangles& triangles) {
    const gpu::uint stage = stageOf(frame_.marks[id], frame_.view.traits);
    if (stage == gpu::kBudgetStages || phase == gpu::kBudgetStages) return;
    const std::uint64_t sum = triangles.settled + triangles.fading;
    drawn_[id] += static_cast<gpu::uint>(sum);
    cells_[id] += sum > 0 ? 1 : 0;
    addTo(frame_.words, gpu::kBudgetDrawn + 2 * stage, sum);
    // What the first phase wants was added before its levels became coarser.
    if (phase == static_cast<gpu::uint>(stage_)) addTo(frame_.words, gpu::kBudgetWanted + 2 * phase, triangles.settled);
  }

  /// What the cells of an object draw: the same share of the triangles at all levels. Coarser levels have fewer cells,
  /// which are larger: one more of them may be visible.
  struct DrawnPart {
    float share;
    float extra;  ///< triangles
  };

  DrawnPart drawnPart(gpu::uint id) const {
    if (frame_.scene.cells.objects.empty()) return {1.0F, 0.0F};
    const gpu::ObjectState& state = frame_.states[id];
    const std::uint64_t whole = trianglesOf(frame_.scene, chainOf(id), frame_.view.traits, state) +
                                fadingTriangles(levelsOf(id), state.lod, frame_.marks[id], frame_.view.traits);
    const auto triangles = static_cast<float>(drawn_[id]);
    return {triangles / static_cast<float>(std::max<std::uint64_t>(whole, 1)),
            triangles / static_cast<float>(std::max(cells_[id], 1U))};
  }

  gpu::uint drawnAt(gpu::uint id, const gpu::ObjectState& state) const {
    const auto triangles = static_cast<float>(trianglesOf(frame_.scene, chainOf(id), frame_.view.traits, state));
    const DrawnPart part = drawnPart(id);
    if (state.lod == frame_.states[id].lod) return static_cast<gpu::uint>(std::ceil(part.share * triangles));
    return static_cast<gpu::uint>(std::ceil(std::min(part.share * triangles + part.extra, triangles)));
  }

  DetailInput detailOf(gpu::uint id) const {
    const gpu::uint marks = frame_.marks[id];
    const bool seen = (marks & gpu::kMarkKnown) != 0 && (marks & gpu::kMarkUnseen) == 0;
    const gpu::ScreenBox& box = frame_.boxes[id];
    DetailInput input = detailInput(frame_.scene, chainOf(id), box, seen, frame_.states[id]);
    if (!(box.maxX > box.minX && box.maxY > box.minY))
      input.area = static_cast<float>(frame_.view.viewportWidth) * static_cast<float>(frame_.view.viewportHeight);
    input.price = frame_.price;
    return input;
  }

  /// Triangles that this stage cannot change: in the late stage those of the early one, in the early stage what is
  /// reserved for the late one.
  float fixed() const {
    if (stage_ == BudgetStage::kLate) return budgetSum(frame_.words, gpu::kBudgetDrawn);
    return std::min(budgetSum(frame_.words, gpu::kBudgetReserve),
                    gpu::kMostReserved * static_cast<float>(frame_.view.triangleBudget));
  }

  float scaleWithinLimit() const {
    float scale = 1.0F;
    for (gpu::uint step = 0; step < gpu::kBudgetSteps; ++step) {
      scale = nextScale(scale, step);
      if (fixed() + budgetSum(frame_.words, gpu::kBudgetForecast + 2 * step) <= limitOf(frame_.view, stage_)) break;
    }
    return scale;
  }

  BudgetFrame& frame_;
  BudgetStage stage_;
  std::vector<gpu::uint> drawn_;  ///< triangles of each object
  std::vector<gpu::uint> cells_;  ///< and how many cells have any
};

}  // namespace

float budgetSum(const BudgetWords& words, gpu::uint at) {
  return static_cast<float>(words[at + 1]) * 1024.0F + static_cast<float>(words[at]);
}

void limitTriangles(BudgetFrame& frame, BudgetStage stage) {
  // The late stage of two phases keeps what the early one wanted.
  const bool second = stage == BudgetStage::kLate && has(frame.view.traits, gpu::kTraitTwoPhases);
  std::fill(frame.words.begin() + (second ? gpu::kBudgetDrawn : 0), frame.words.end(), 0U);
  Stage work(frame, stage);
  work.sum();
  work.reserve();
  if (!work.isOver()) return;
  work.forecast();
  work.limit();
}

}  // namespace jalousie::visibility
