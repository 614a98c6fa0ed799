// Multiplies the scales of the local transforms from the roots down.
#include "bake/io/node_scales.h"

#include <cmath>

#include "asset/node_graph.h"

namespace jalousie::bake {

std::vector<double> nodeScales(const tinygltf::Model& model) {
  std::vector<double> scales(model.nodes.size(), 1.0);
  std::vector<bool> isChild(model.nodes.size(), false);
  for (std::size_t n = 0; n < model.nodes.size(); ++n) {
    scales[n] = std::cbrt(std::abs(glm::determinant(glm::dmat3(asset::localTransform(model.nodes[n])))));
    if (!std::isfinite(scales[n])) scales[n] = 0.0;
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
      scales[static_cast<std::size_t>(child)] *= scales[n];
      open.push_back(static_cast<std::size_t>(child));
    }
  }
  return scales;
}

}  // namespace jalousie::bake
