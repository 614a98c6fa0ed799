// Reports the figures of a scattered scene as JSON and as one line.
#pragma once

#include <string>

#include "scatter/options.h"
#include "scatter/scatter.h"

namespace jalousie::scatter {

/// Keys: objects, meshes_per_object, side, rotate, scale, moving, seed, levels, triangles_per_object, triangles_full,
/// occluder (kind, cover, triangles; null without), city (built, blocks, buildings, boxes, triangles; only of a city),
/// bounds (min, max), camera_frames, ignored (counts by name).
std::string reportJson(const Options& options, const Summary& summary);

/// "5001 objects in a cube of side 13.4, 294058800 triangles at LOD 0"; "20 objects of 3 meshes in ...".
std::string reportLine(const Options& options, const Summary& summary);

}  // namespace jalousie::scatter
