// Multiplies the local transforms from the roots down.
#include "bake/io/node_scales.h"

#include <cmath>

#include "asset/node_graph.h"

namespace jalousie::bake {

std::vector<glm::dmat4> worldTransforms(const tinygltf::Model& model) {
  std::vector<glm::dmat4> transforms(model.nodes.size());
  std::vector<bool> isChild(model.nodes.size(), false);
  for (std::size_t n = 0; n < model.nodes.size(); ++n) {
    transforms[n] = asset::localTransform(model.nodes[n]);
    for (const int child : model.nodes[n].children)
      isChild[static_cast<std::size_t>(child)] = true;
  }
  std::vector<std::size_t> open;
  for (std::size_t n = 0; n < isChild.size(); ++n)
    if (!isChild[n]) open.push_back(n);
  while (!open.empty()) {
    const std::size_t n = open.back();
    open.pop_back();
    for (const int child : model.nodes[n].children) {
      transforms[static_cast<std::size_t>(child)] = transforms[n] * transforms[static_cast<std::size_t>(child)];
      open.push_back(static_cast<std::size_t>(child));
    }
  }
  return transforms;
}

std::vector<double> nodeScales(const tinygltf::Model& model) {
  std::vector<double> scales;
  for (const glm::dmat4& transform : worldTransforms(model)) {
    const double scale = std::cbrt(std::abs(glm::determinant(glm::dmat3(transform))));
    scales.push_back(std::isfinite(scale) ? scale : 0.0);
  }
  return scales;
}

}  // namespace jalousie::bake
