// Which class implements which culling mode.
#pragma once

#include <memory>
#include <vector>

#include "policy/cull_mode.h"
#include "render/methods/cull_method.h"
#include "render/methods/method_inputs.h"

namespace jalousie::render {

/// The methods of one renderer, one per row of cullModeTable().
class MethodTable {
 public:
  /// Builds the programs of every method. Errors: kShader.
  explicit MethodTable(const MethodInputs& inputs);

  CullMethod& operator[](CullMode mode) const { return *methods_[static_cast<std::size_t>(mode)]; }
  /// Tells every method about the size of the screen, pixels.
  void resize(std::uint32_t width, std::uint32_t height) const;
  /// Lets every method forget past frames.
  void forget() const;

 private:
  std::vector<std::unique_ptr<CullMethod>> methods_;  ///< [cullModeTable().size()]
};

}  // namespace jalousie::render
