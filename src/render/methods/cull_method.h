// The interface of a culling method. A method is a folder beside this file and a row in policy/cull_mode.cpp.
#pragma once

#include <cstdint>

#include "render/methods/frame_context.h"

namespace jalousie::render {

/// Decides, within a frame, which objects are drawn and in which phase. The objects' flags (kMark...) carry the
/// decision to the draw lists. A constructor that needs more than the FrameContext takes it from MethodInputs, and
/// builds the method's programs there: a shader that does not build must not be found during a frame.
class CullMethod {
 public:
  CullMethod() = default;
  virtual ~CullMethod() = default;
  CullMethod(const CullMethod&) = delete;
  CullMethod& operator=(const CullMethod&) = delete;

  /// Makes what only this mode needs, before its first frame; nothing after the first time. Errors: kLimit.
  virtual void allocate() {}
  /// Another screen size, pixels; for methods with memory of that size. Called once before the first frame.
  virtual void resize(std::uint32_t /*width*/, std::uint32_t /*height*/) {}
  /// Forgets what it keeps of past frames.
  virtual void forget() {}
  /// Before classify.comp: for verdicts that are known before the frame. The views are those of this frame.
  virtual void prepare(const FrameContext& /*frame*/) noexcept {}
  /// After classify.comp: finishes what it left pending. Nothing to do for a method without an occlusion test.
  virtual void decide(const FrameContext& /*frame*/) noexcept {}
  /// Draws again what the last frame's test compared objects with, from the culling camera, for inspection.
  virtual void redrawCover(const FrameContext& /*frame*/) noexcept {}
  /// Draws what the test compared objects with into the bound framebuffer (View::kOcclusion).
  virtual void showCover(const FrameContext& /*frame*/) noexcept {}
};

}  // namespace jalousie::render
