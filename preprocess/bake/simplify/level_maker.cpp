// Chooses between the project's collapse with its refit and meshoptimizer's for drafts.
#include "bake/simplify/level_maker.h"

#include <cstdlib>
#include <utility>

#include "bake/mesh/flat_shading.h"
#include "bake/simplify/draft.h"

namespace jalousie::bake {

RefitOptions refitOptions(const ChainOptions& options, const PartClasses& classes) {
  RefitOptions refit;
  refit.lockBorder = options.collapse.lockBorder;
  refit.locked = options.collapse.lockedVertices;
  refit.slices = options.slices;
  refit.partOfVertex = classes.partOfVertex;
  if (options.preset == Preset::kFast) {
    refit.rounds = 1;
    refit.samplesPerTriangle = 3;
    refit.mostSamples = 1.0;
  }
  return refit;
}

CollapseOptions collapseOptions(const ChainOptions& options, const std::vector<bool>& flat) {
  CollapseOptions collapse = options.collapse;
  if (options.preset == Preset::kFast && !collapse.normalWeight) collapse.normalWeight = 0.0;
  if (!flat.empty() && !collapse.normalWeight) collapse.normalWeight = 0.0;  // normals follow the triangles
  return collapse;
}

LevelMaker::LevelMaker(const WedgeMesh& mesh, const ChainOptions& options)
    : finest_(mesh), options_(options), flat_(flatPrimitives(mesh)) {
  if (options.preset == Preset::kDraft) {
    corners_ = mesh.corners;
    return;
  }
  collapser_ = std::make_unique<EdgeCollapser>(mesh, collapseOptions(options, flat_));
}

LevelMaker::LevelMaker(const LevelMaker& other)
    : finest_(other.finest_),
      options_(other.options_),
      flat_(other.flat_),
      collapser_(other.collapser_ ? std::make_unique<EdgeCollapser>(*other.collapser_) : nullptr),
      corners_(other.corners_) {}

LevelMaker::Level LevelMaker::make(std::uint32_t target, bool exactly) {
  if (!collapser_) {
    corners_ = exactly ? draftExactly(target) : draftCorners(finest_, corners_, target, options_.collapse.lockBorder);
    DraftLevel level = draftLevel(finest_, corners_);
    return {std::move(level.mesh), std::move(level.vertexMap), 0};
  }
  collapser_->collapseTo(target);
  return {collapser_->mesh(), collapser_->vertexMap(), collapser_->removedParts()};
}

void LevelMaker::refit(Level& level) const {
  if (collapser_) {
    refitLevel(finest_, level.vertexMap, refitOptions(options_, collapser_->partClasses()), level.mesh);
    if (!options_.collapse.lockBorder) growUnlocked(level);
  }
  restoreFlatShading(flat_, level.mesh);
}

/// Lets crowds grow; locked vertices stay where they are.
void LevelMaker::growUnlocked(Level& level) const {
  const std::vector<std::uint8_t>& locked = options_.collapse.lockedVertices;
  growParts(collapser_->partClasses(), level.vertexMap, level.mesh);
  for (std::size_t v = 0; v < locked.size(); ++v)
    if (locked[v] != 0 && level.vertexMap[v] != EdgeCollapser::kGone)
      level.mesh.positions[level.vertexMap[v]] = finest_.positions[v];
}

/// A collapse can undershoot its target; a slightly larger target often gives the wanted count.
std::vector<std::uint32_t> LevelMaker::draftExactly(std::uint32_t target) const {
  std::vector<std::uint32_t> best = draftCorners(finest_, corners_, target, options_.collapse.lockBorder);
  const auto miss = [&](const std::vector<std::uint32_t>& corners) {
    return std::abs(static_cast<std::int64_t>(corners.size() / 3) - static_cast<std::int64_t>(target));
  };
  for (std::uint32_t extra = 1; extra <= 32 && miss(best) > 0; ++extra) {
    std::vector<std::uint32_t> candidate =
        draftCorners(finest_, corners_, target + extra, options_.collapse.lockBorder);
    if (miss(candidate) < miss(best)) best = std::move(candidate);
  }
  return best;
}

}  // namespace jalousie::bake
