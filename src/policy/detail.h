// The two detail paths, in one table.
#pragma once

#include <span>

#include "shared/traits.h"

namespace jalousie {

/// Values index detailTable().
enum class Detail : gpu::uint { kDiscrete, kTessellation };

/// One row of the table.
struct DetailRow {
  const char* name;  ///< value of --detail
  Detail id;
  bool patches = false;  ///< draws Phong-tessellated patches; the scene is built with patch bases
  const char* help;      ///< phrase for --help, panel and docs
};

/// Both paths, in the order of Detail.
std::span<const DetailRow> detailTable();
const DetailRow& rowOf(Detail detail);
/// kTrait... of shared/traits.h.
gpu::uint traitsOf(Detail detail);

}  // namespace jalousie
