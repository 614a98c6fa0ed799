// Ranges of the lens of perspective and orthographic cameras.
#include "asset/camera_validate.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "core/error.h"

namespace jalousie::asset::detail {
namespace {

/// Refuses one number of a lens unless it is finite as a float and passes.
void require(bool passes, std::size_t index, const char* name, double value) {
  if (!passes || !std::isfinite(static_cast<float>(value)))
    throw Error(ErrorCode::kMalformed, fmt::format("camera {}: {} {:g} is out of range", index, name, value));
}

}  // namespace

void validateLens(const tinygltf::Camera& camera, std::size_t index) {
  const auto rounded = [](double value) { return static_cast<float>(value); };
  if (camera.type == "perspective") {
    const tinygltf::PerspectiveCamera& lens = camera.perspective;
    require(rounded(lens.yfov) > 0.0F && rounded(lens.yfov) < std::numbers::pi_v<float>, index, "yfov", lens.yfov);
    require(rounded(lens.znear) > 0.0F, index, "znear", lens.znear);
    require(lens.zfar == 0.0 || rounded(lens.zfar) > rounded(lens.znear), index, "zfar", lens.zfar);
    require(lens.aspectRatio >= 0.0, index, "aspectRatio", lens.aspectRatio);
  } else if (camera.type == "orthographic") {
    const tinygltf::OrthographicCamera& lens = camera.orthographic;
    require(rounded(lens.xmag) != 0.0F, index, "xmag", lens.xmag);
    require(rounded(lens.ymag) != 0.0F, index, "ymag", lens.ymag);
    require(lens.znear >= 0.0, index, "znear", lens.znear);
    require(rounded(lens.zfar) > rounded(lens.znear), index, "zfar", lens.zfar);
  } else {
    throw Error(ErrorCode::kMalformed, fmt::format("camera {} is neither perspective nor orthographic", index));
  }
}

}  // namespace jalousie::asset::detail
