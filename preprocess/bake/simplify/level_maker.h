// Makes the levels of one chain, one after the other: collapse and refit, without measuring.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "bake/mesh/wedge_mesh.h"
#include "bake/simplify/chain_options.h"
#include "bake/simplify/collapse.h"
#include "bake/simplify/refit.h"

namespace jalousie::bake {

/// The options of the collapse of a chain. @param flat  primitives with flat shading; empty: none
CollapseOptions collapseOptions(const ChainOptions& options, const std::vector<bool>& flat);

/// The options of the refit of a chain. Refers to both parameters.
RefitOptions refitOptions(const ChainOptions& options, const PartClasses& classes);

class LevelMaker {
 public:
  struct Level {
    WedgeMesh mesh;
    std::vector<std::uint32_t> vertexMap;  ///< for each vertex of the finest mesh the level's, ~0 if it went
    std::uint32_t removedParts = 0;        ///< loose parts that were removed as a whole
  };

  /// Keeps references.
  LevelMaker(const WedgeMesh& mesh, const ChainOptions& options);
  /// A copy continues where the other one is.
  LevelMaker(const LevelMaker& other);
  LevelMaker& operator=(const LevelMaker&) = delete;
  ~LevelMaker() = default;

  /// Collapses to a level of at most `target` triangles if the collapse allows it. @param exactly  tries to have that
  /// number where collapses take several triangles at once
  Level make(std::uint32_t target, bool exactly);
  /// The collapse; null for drafts.
  EdgeCollapser* collapser() { return collapser_.get(); }
  const EdgeCollapser* collapser() const { return collapser_.get(); }
  /// Fits a level to the finest mesh and lets crowds of parts keep their area, unless it is a draft. Flat primitives
  /// stay flat. @param level  what make returned last   @pre it has at least kMinLevelTriangles
  void refit(Level& level) const;

 private:
  void growUnlocked(Level& level) const;
  std::vector<std::uint32_t> draftExactly(std::uint32_t target) const;

  const WedgeMesh& finest_;
  const ChainOptions& options_;
  std::vector<bool> flat_;  ///< primitives
  std::unique_ptr<EdgeCollapser> collapser_;
  std::vector<std::uint32_t> corners_;  ///< drafts only
};

}  // namespace jalousie::bake
