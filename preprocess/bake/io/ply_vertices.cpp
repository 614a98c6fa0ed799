// Names of properties in the files of different programs, and what their values mean.
#include "bake/io/ply_vertices.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "bake/io/color_space.h"

namespace jalousie::bake::ply {

int slotOf(std::string_view name) {
  struct Named {
    std::string_view name;
    int slot;
  };
  static constexpr std::array<Named, 36> kNames = {{{"x", 0},
                                                    {"y", 1},
                                                    {"z", 2},
                                                    {"nx", 3},
                                                    {"ny", 4},
                                                    {"nz", 5},
                                                    {"normal_x", 3},
                                                    {"normal_y", 4},
                                                    {"normal_z", 5},
                                                    {"s", 6},
                                                    {"t", 7},
                                                    {"u", 6},
                                                    {"v", 7},
                                                    {"texture_u", 6},
                                                    {"texture_v", 7},
                                                    {"texture_s", 6},
                                                    {"texture_t", 7},
                                                    {"s0", 6},
                                                    {"t0", 7},
                                                    {"u0", 6},
                                                    {"v0", 7},
                                                    {"red", 8},
                                                    {"green", 9},
                                                    {"blue", 10},
                                                    {"alpha", 11},
                                                    {"r", 8},
                                                    {"g", 9},
                                                    {"b", 10},
                                                    {"a", 11},
                                                    {"diffuse_red", 8},
                                                    {"diffuse_green", 9},
                                                    {"diffuse_blue", 10},
                                                    {"diffuse_alpha", 11},
                                                    {"Red", 8},
                                                    {"Green", 9},
                                                    {"Blue", 10}}};
  for (const Named& named : kNames)
    if (named.name == name) return named.slot;
  return -1;
}

namespace {

constexpr int kFirstColor = 8;      // slot of red
constexpr double kRounding = 1e-3;  // of colours

bool isFloat(Type type) {
  return type == Type::kFloat || type == Type::kDouble;
}

/// The value of full colour: ushort reaches 65535, and all other integers 255, whatever their width. Floats reach 1 or
/// 255, see finishColors.
double colorScale(Type type) {
  return type == Type::kUint16 ? 65535.0 : 255.0;
}

/// A colour component as a share of full colour; floats as they are.
/// Errors: kMalformed unless it lies in the range of its type but for rounding.
double colorShare(const Input& input, double value, Type type) {
  const double share = value / colorScale(type);
  if (!(share >= -kRounding && share <= 1.0 + kRounding))
    input.fail(fmt::format("the colour {:g} of a PLY vertex is outside [0, {:g}]", value, colorScale(type)));
  return isFloat(type) ? value : std::clamp(share, 0.0, 1.0);
}

/// The value of full colour among floats: 255 if all of them are whole and some exceed 1, because some programs write
/// bytes as floats; else 1. Errors: kMalformed (a number beyond 1 beside one that is not whole).
/// @param first, last  components
float fullOfFloats(const Input& input, const std::vector<glm::vec4>& colors, int first, int last) {
  float largest = 0.0F;
  bool isWhole = true;
  for (const glm::vec4& color : colors) {
    for (int k = first; k <= last; ++k) {
      largest = std::max(largest, color[k]);
      isWhole = isWhole && color[k] == std::floor(color[k]);
    }
  }
  if (largest <= 1.0 + kRounding) return 1.0F;
  if (!isWhole) input.fail(fmt::format("the colour {:g} of a PLY vertex is outside [0, 1]", largest));
  return 255.0F;
}

/// Makes linear colours of those that were read.
void finishColors(const Input& input, const Element& element, std::vector<glm::vec4>& colors) {
  glm::bvec4 floats(false);
  for (const Property& property : element.properties) {
    const int slot = property.countType ? -1 : slotOf(property.name);
    if (slot >= kFirstColor) floats[slot - kFirstColor] = isFloat(property.type);
  }
  glm::vec4 full(1.0F);
  if (floats.r && floats.g && floats.b) full = glm::vec4(glm::vec3(fullOfFloats(input, colors, 0, 2)), 1.0F);
  if (floats.a) full.a = fullOfFloats(input, colors, 3, 3);
  for (glm::vec4& color : colors) {
    color = glm::clamp(color / full, 0.0F, 1.0F);
    color = {linearFromSrgb(color.r), linearFromSrgb(color.g), linearFromSrgb(color.b), color.a};
  }
}

/// What the vertices have, by slot. Errors: kMalformed (no position, a property twice).
std::array<bool, 12> slotsOf(const Input& input, const Element& element) {
  std::array<bool, 12> has = {};
  for (const Property& property : element.properties) {
    const int slot = property.countType ? -1 : slotOf(property.name);
    if (slot < 0) continue;
    if (has[static_cast<std::size_t>(slot)]) input.fail("a PLY vertex property stands twice");
    has[static_cast<std::size_t>(slot)] = true;
  }
  if (!has[0] || !has[1] || !has[2]) input.fail("PLY vertices without x, y, z");
  return has;
}

}  // namespace

void readVertices(Input& input, const Element& element, Encoding encoding, PolygonMesh& mesh) {
  const std::array<bool, 12> has = slotsOf(input, element);
  const bool hasNormals = has[3] && has[4] && has[5];
  const bool hasUvs = has[6] && has[7];
  const bool hasColors = has[8] && has[9] && has[10];
  mesh.positions.reserve(element.count);
  for (std::uint64_t v = 0; v < element.count; ++v) {
    std::array<double, 12> values = {0, 0, 0, 0, 0, 0, 0, 0, 1, 1, 1, 1};
    for (const Property& property : element.properties) {
      const int slot = property.countType ? -1 : slotOf(property.name);
      if (slot < 0) {
        skipProperty(input, property, encoding);
        continue;
      }
      const double value = input.value(property.type, encoding);
      if (!std::isfinite(static_cast<float>(value))) input.fail("a PLY vertex holds NaN or an infinite number");
      values[static_cast<std::size_t>(slot)] = slot >= kFirstColor ? colorShare(input, value, property.type) : value;
    }
    mesh.positions.emplace_back(values[0], values[1], values[2]);
    if (hasNormals) mesh.normals.emplace_back(values[3], values[4], values[5]);
    if (hasUvs) mesh.uvs.emplace_back(values[6], 1.0F - static_cast<float>(values[7]));
    if (hasColors) mesh.colors.emplace_back(values[8], values[9], values[10], values[11]);
  }
  if (hasColors) finishColors(input, element, mesh.colors);
}

}  // namespace jalousie::bake::ply
