// Options of jalousie-scatter.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

#include "core/memory_limit.h"
#include "core/output_files.h"

namespace jalousie::scatter {

enum class Rotation {
  kNone,  ///< all objects as in the file
  kX,     ///< random angle about the global x axis (thesis 4.2.1)
  kAny,   ///< uniform over all rotations
};

enum class OccluderKind {
  kFoliage,  ///< many small leaf cards
  kGrid,     ///< thin bars with many small square holes
  kFence,    ///< vertical slats with wide slots
  kPlane,    ///< a wall with one large hole in the middle
};

enum class Shape {
  kCube,    ///< centres uniform in a cube
  kGround,  ///< standing on a square of ground, uniform
  kCity,    ///< standing in the streets and courtyards of a city
};

/// Range of the uniform scale factor, 0 < min <= max.
struct ScaleRange {
  float min = 1.0F;
  float max = 1.0F;
};

/// "cube", "ground", "city".
const char* shapeName(Shape shape);

/// How the objects are placed. Presets and defaults are already merged in.
struct Layout {
  std::uint32_t count = 1;  ///< objects, the one in the middle included
  Shape shape = Shape::kCube;
  std::optional<float> side;   ///< of the cube or square that holds the objects' centres, world units
  float sideDiagonals = 0.0F;  ///< the same in diagonals of the object's box, where `side` is absent
  Rotation rotation = Rotation::kNone;
  ScaleRange scale;
  float moving = 0.0F;  ///< share of the objects that bounce in the cube or on the ground, 0 to 1
  float built = 1.0F;   ///< share of a city's lots that have a building, 0 to 1
  std::uint64_t seed = 1;

  /// Whether the objects stand on a plane.
  bool isOnGround() const { return shape != Shape::kCube; }
};

struct Occluder {
  OccluderKind kind = OccluderKind::kFoliage;
  float cover = 0.75F;  ///< covered share of its area, 0 to 1
};

struct Options {
  std::filesystem::path input;
  std::filesystem::path output;
  std::filesystem::path report;  ///< JSON; none if empty; "-": standard output
  Layout layout;
  std::optional<Occluder> occluder;
  MemoryLimit memory{kDefaultMaxMemory, "--max-memory"};
  Replace replace = Replace::kSameKind;
  bool quiet = false;
};

}  // namespace jalousie::scatter
