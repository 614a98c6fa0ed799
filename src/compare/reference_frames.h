// Pictures of the reference: rendered once, cached in the report's folder.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "compare/image_error.h"
#include "compare/plan.h"
#include "core/image.h"

namespace jalousie::asset {
struct Camera;
}
namespace jalousie::render {
class FrameRenderer;
}
namespace jalousie::scene {
struct SceneData;
}

namespace jalousie::compare {

/// Reads a picture from references/, or renders and stores it there. Keeps the last two frames asked for in memory.
class ReferenceFrames {
 public:
  /// Keeps references to scene, path and plan, which must outlive the object.
  /// @param folder  of the report   @param key  referenceFingerprint() of scene, path and plan
  ReferenceFrames(const scene::SceneData& scene, const asset::Camera& path, const Plan& plan,
                  std::filesystem::path folder, std::string key);
  ~ReferenceFrames();
  ReferenceFrames(const ReferenceFrames&) = delete;
  ReferenceFrames& operator=(const ReferenceFrames&) = delete;

  /// The result stays valid until another frame is asked for. @pre the plan has a reference (checked)
  /// Errors: kMalformed for a cached picture of another size, kWriteFailed, as loadImage.
  const ImageRgba8& image(std::uint32_t frame);
  /// The same picture, filtered for FLIP.
  const FlipImage& flip(std::uint32_t frame);
  /// FrameRenderer::readIds() of the same frame, rendered for this call unless it was the last one asked for.
  const std::vector<std::uint32_t>& ids(std::uint32_t frame);
  /// Error of a picture of the same frame. @param seen     the picture, filtered for FLIP
  /// @param covered  FrameObjects::covered of the picture; empty: not known
  ImageError errorOf(const ImageRgba8& image, const FlipImage& seen, std::uint32_t frame,
                     const std::vector<std::uint8_t>& covered = {});
  /// FLIP per pixel between two frames of the reference: change that comes from the camera's motion alone.
  std::vector<float> motion(std::uint32_t from, std::uint32_t to);

 private:
  ImageRgba8 render(std::uint32_t frame);

  const scene::SceneData& scene_;
  const asset::Camera& path_;
  const Plan& plan_;
  std::filesystem::path folder_;
  std::string key_;
  std::unique_ptr<render::FrameRenderer> renderer_;  ///< null until a picture is missing in the cache
  std::map<std::uint32_t, ImageRgba8> images_;
  std::map<std::uint32_t, FlipImage> flips_;
  std::pair<std::uint32_t, std::vector<std::uint32_t>> ids_;  ///< frame and numbers; empty before the first
};

}  // namespace jalousie::compare
