// Camera paths of a city: a walk and a drive through its streets, and a flight over its roofs.
#pragma once

#include <span>

#include "scatter/camera_path.h"
#include "scatter/city.h"

namespace jalousie::scatter {

/// One of the paths.
struct CityPath {
  const char* name;  ///< of the camera
  CameraPath path;
};

/// "walk": around a block at eye level, looking about. "flight": a circle above the highest roof, looking ahead and
/// down. "drive": around up to sixteen blocks, looking along the street. All end where they begin.
std::vector<CityPath> cityPaths(const City& city);

}  // namespace jalousie::scatter
