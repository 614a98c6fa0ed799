// A cache in memory before a cache on disk before a renderer.
#include "compare/reference_frames.h"

#include <iterator>
#include <system_error>
#include <utility>

#include "asset/image_io.h"
#include "asset/scene_file.h"
#include "compare/butteraugli.h"
#include "compare/configuration.h"
#include "compare/report_folder.h"
#include "core/error.h"
#include "render/frame_renderer.h"
#include "scene/camera.h"
#include "scene/scene_data.h"

namespace jalousie::compare {
namespace {

constexpr std::size_t kFramesInMemory = 2;

/// Erases the lowest frames but for `kept` until few enough are left.
void forgetOldest(auto& entries, std::uint32_t kept) {
  while (entries.size() > kFramesInMemory)
    entries.erase(entries.begin()->first != kept ? entries.begin() : std::prev(entries.end()));
}

}  // namespace

ReferenceFrames::ReferenceFrames(const scene::SceneData& scene, const asset::Camera& path, const Plan& plan,
                                 std::filesystem::path folder, std::string key)
    : scene_(scene), path_(path), plan_(plan), folder_(std::move(folder)), key_(std::move(key)) {}

ReferenceFrames::~ReferenceFrames() = default;

ImageRgba8 ReferenceFrames::render(std::uint32_t frame) {
  if (renderer_ == nullptr) renderer_ = std::make_unique<render::FrameRenderer>(scene_, plan_.width, plan_.height);
  const scene::Camera camera = scene::cameraAtFrame(path_, static_cast<float>(frame));
  renderer_->resetHistory();
  render::FrameOptions options = referenceOptions(plan_.reference);
  options.seconds = scene::secondsAt(static_cast<float>(frame));
  renderer_->render(options, camera, camera);
  return renderer_->readImage();
}

const ImageRgba8& ReferenceFrames::image(std::uint32_t frame) {
  if (const auto there = images_.find(frame); there != images_.end()) return there->second;
  const std::filesystem::path file = referenceFile(folder_, key_, frame);
  ImageRgba8 image;
  std::error_code ignored;
  if (std::filesystem::is_regular_file(file, ignored)) {
    image = asset::loadImage(file);
  } else {
    image = render(frame);
    asset::savePng(image, file);
  }
  if (image.width != plan_.width || image.height != plan_.height)
    throw Error(ErrorCode::kMalformed, "the cached reference has another size; delete the file", file);
  const ImageRgba8& result = images_.insert_or_assign(frame, std::move(image)).first->second;
  forgetOldest(images_, frame);
  return result;
}

const FlipImage& ReferenceFrames::flip(std::uint32_t frame) {
  if (const auto there = flips_.find(frame); there != flips_.end()) return there->second;
  const FlipImage& result = flips_.emplace(frame, FlipImage(image(frame), plan_.pixelsPerDegree)).first->second;
  forgetOldest(flips_, frame);
  return result;
}

const std::vector<std::uint32_t>& ReferenceFrames::ids(std::uint32_t frame) {
  if (ids_.second.empty() || ids_.first != frame) {
    render(frame);
    renderer_->renderIds();
    ids_ = {frame, renderer_->readIds()};
  }
  return ids_.second;
}

ImageError ReferenceFrames::errorOf(const ImageRgba8& picture, const FlipImage& seen, std::uint32_t frame,
                                    const std::vector<std::uint8_t>& covered) {
  const ImageRgba8& reference = image(frame);
  const std::vector<float> map = flipMap(flip(frame), seen);
  ImageError error{psnr(reference, picture), ssim(reference, picture), mean(map), meanOver(map, covered), {}};
  if (plan_.butteraugli) error.butteraugli = butteraugli(image(frame), picture).mean;
  return error;
}

std::vector<float> ReferenceFrames::motion(std::uint32_t from, std::uint32_t to) {
  const FlipImage before = flip(from);  // a copy: flip(to) may evict it
  return flipMap(before, flip(to));
}

}  // namespace jalousie::compare
