// What a frame decided about each object, and the error of the picture that the object is the cause of.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace jalousie::render {
class FrameRenderer;
}
namespace jalousie::scene {
struct SceneData;
}

namespace jalousie::compare {

/// A level beside the one that is drawn.
struct OtherLevel {
  std::uint64_t triangles = 0;        ///< more than the level that is drawn has
  std::optional<double> errorPixels;  ///< its largest deviation on the screen; absent where the file does not say
};

/// One object of a frame.
struct ObjectFigures {
  std::uint32_t object = 0;           ///< instance in the order of the file: gpu::Object::owner
  std::uint32_t chain = 0;            ///< index into SceneData::chains
  bool drawn = false;                 ///< some pixel of the picture shows it
  std::uint32_t level = 0;            ///< of the chain; of patches that of their base
  std::uint32_t tessellation = 0;     ///< parts of each edge of the patches; 0: no patches
  std::uint64_t triangles = 0;        ///< of this level
  std::uint64_t pixels = 0;           ///< that show it
  std::optional<double> allowed;      ///< largest deviation that the rule allows, pixels; absent: no limit
  std::optional<double> errorPixels;  ///< largest deviation of the level, pixels; absent where the file does not say
  double flip = 0.0;                  ///< FLIP against the reference, summed over the pixels that are put down to it
  std::optional<OtherLevel> finer;    ///< the next finer level; absent at the finest, and where it is not drawn
};

/// The objects of one configuration in one frame.
struct ObjectsSample {
  std::uint32_t frame = 0;
  std::size_t configuration = 0;    ///< index
  std::uint64_t listed = 0;         ///< objects with a pixel in the picture or in the reference
  double flip = 0.0;                ///< summed over all pixels
  double flipOfBackground = 0.0;    ///< of this, over pixels that show no object in either picture
  std::vector<ObjectFigures> rows;  ///< the ones with the largest FLIP, largest first
};

/// Looks at the renderer's last frame; draws object numbers and waits for the GPU. The error of a pixel is put down to
/// the object that the picture shows there. It is put down to the object of the reference where the picture shows the
/// background, or an object at its finest level, which is where the reference would show it, and where no pixel of the
/// picture shows the object of the reference.
/// @param scene          of the renderer
/// @param error          FLIP per pixel, row 0 at the top
/// @param referenceIds   FrameRenderer::readIds() of the reference, of a scene from the same file
/// @param most           length of ObjectsSample::rows at most
/// @return  frame and configuration are left to the caller   @pre equal sizes (checked)
ObjectsSample figuresOf(render::FrameRenderer& renderer, const scene::SceneData& scene, const std::vector<float>& error,
                        const std::vector<std::uint32_t>& referenceIds, std::size_t most);

}  // namespace jalousie::compare
