// Digests that tell whether two experiments measure the same.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "compare/plan.h"

namespace jalousie::asset {
struct Camera;
}
namespace jalousie::scene {
struct SceneData;
}

namespace jalousie::compare {

struct Configuration;

// A digest is FNV-1a with 64 bits, as 16 hexadecimal digits. It detects changes; it is no protection against forgery.

std::string digestOf(std::span<const std::byte> bytes);

/// Digest of everything that the reference pictures depend on: content of the scene, camera path, picture size, kind of
/// reference, driver and build.
std::string referenceFingerprint(const scene::SceneData& scene, const asset::Camera& path, const Plan& plan);

/// Digest of everything that an experiment's steps and figures depend on.
std::string experimentFingerprint(const scene::SceneData& scene, const asset::Camera& path,
                                  const std::vector<Configuration>& configurations, const Plan& plan);

}  // namespace jalousie::compare
