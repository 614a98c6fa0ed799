// Writes a self-contained page with pictures of every level.
#pragma once

#include <tiny_gltf.h>

#include <cstdint>
#include <string>

#include "asset/gltf_file.h"
#include "bake/simplify/slices.h"

namespace jalousie::bake {

struct SheetOptions {
  std::string title;           ///< headline, e.g. the file's name; escaped
  std::uint32_t side = 340;    ///< pixels of a picture
  std::size_t maxChains = 12;  ///< the chains with most triangles; the page says how many were left out
  asset::Limits limits;
  SliceRunner slices = runInOneSlice;  ///< runs the loops over samples
};

/// HTML with pictures as data URIs, no script, no external resource: for each chain of two levels and more a plot of
/// error over triangles, and per level the original, the level and its distance to the original as a heat map, in
/// object space. Levels of other tools are measured here. Errors: those of readCombinedMesh.
std::string sheetHtml(const tinygltf::Model& model, const SheetOptions& options);

}  // namespace jalousie::bake
