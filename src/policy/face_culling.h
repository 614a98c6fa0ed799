// How the back faces inside objects are culled, in one table.
#pragma once

#include <span>

#include "shared/types.h"

namespace jalousie {

/// Values are kFaces... of shared/face_structs.h, and index faceCullingTable().
enum class FaceCulling : gpu::uint { kOff, kMask, kCluster, kTree, kCone };

/// One row of the table.
struct FaceCullingRow {
  const char* name;  ///< value of --backface
  FaceCulling id;
  const char* help;  ///< phrase for --help, panel and docs
};

/// All rows, in the order of FaceCulling.
std::span<const FaceCullingRow> faceCullingTable();
const FaceCullingRow& rowOf(FaceCulling culling);

}  // namespace jalousie
