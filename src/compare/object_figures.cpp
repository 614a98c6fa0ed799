// Joins object numbers, error map and the states of the objects.
#include "compare/object_figures.h"

#include <algorithm>
#include <cmath>

#include "core/check.h"
#include "policy/traits.h"
#include "render/frame_renderer.h"
#include "scene/patch_base.h"
#include "scene/scene_data.h"
#include "visibility/lod_policy.h"

namespace jalousie::compare {
namespace {

std::optional<double> known(float value) {
  return std::isfinite(value) ? std::optional<double>(value) : std::nullopt;
}

/// Pixels and error of one object.
struct Share {
  std::uint64_t pixels = 0;           ///< of the picture
  std::uint64_t referencePixels = 0;  ///< of the reference
  double flip = 0.0;
};

/// Object numbers of the picture and of the reference, row 0 at the bottom, and the error between both, row 0 at the
/// top.
struct Compared {
  const std::vector<std::uint32_t>& ids;
  const std::vector<std::uint32_t>& referenceIds;
  const std::vector<float>& error;
  std::size_t width;
};

/// Shares of all objects; [0] is the background.
/// @param exact  [shares] of what shows nothing that the reference would not show there: objects at their finest level,
/// and the background
std::vector<Share> sharesOf(const Compared& pictures, const std::vector<bool>& exact) {
  const std::vector<std::uint32_t>& ids = pictures.ids;
  std::vector<Share> shares(exact.size());
  for (std::size_t i = 0; i < ids.size(); ++i) {
    ++shares.at(ids[i]).pixels;
    ++shares.at(pictures.referenceIds[i]).referencePixels;
  }
  for (std::size_t i = 0; i < ids.size(); ++i) {
    const std::uint32_t reference = pictures.referenceIds[i];
    const bool isOfReference = reference != 0 && (exact[ids[i]] || shares[reference].pixels == 0);
    const std::size_t fromTop = ids.size() / pictures.width - 1 - i / pictures.width;
    shares[isOfReference ? reference : ids[i]].flip +=
        static_cast<double>(pictures.error[fromTop * pictures.width + i % pictures.width]);
  }
  return shares;
}

/// States of the objects, read back once for all of them.
struct States {
  std::vector<gpu::ObjectState> states;
  std::vector<gpu::ScreenBox> boxes;
  std::vector<gpu::uint> marks;
};

class Judge {
 public:
  Judge(const render::FrameRenderer& renderer, const scene::SceneData& scene)
      : scene_(scene),
        view_(renderer.cullView()),
        states_{renderer.readStates(), renderer.readBoxes(), renderer.readMarks()} {}

  /// As of sharesOf.
  std::vector<bool> exact() const {
    std::vector<bool> result(states_.states.size() + 1);
    result[0] = true;
    const bool patches = has(view_.traits, gpu::kTraitPatches);
    for (std::size_t i = 0; i < states_.states.size(); ++i)
      result[i + 1] = !patches && states_.states[i].lod == 0;
    return result;
  }

  /// @param index  into SceneData::objects
  ObjectFigures judge(std::uint32_t index, const Share& share) const {
    const gpu::Object& object = scene_.objects[index];
    ObjectFigures figures;
    figures.object = object.owner;
    figures.chain = object.chain;
    figures.drawn = share.pixels > 0;
    figures.pixels = share.pixels;
    figures.flip = share.flip;
    if (!figures.drawn) return figures;
    if (has(view_.traits, gpu::kTraitPatches))
      addPatches(index, figures);
    else
      addLevel(index, figures);
    const visibility::DetailInput input =
        visibility::detailInput(scene_, scene_.chains[object.chain], states_.boxes[index],
                                (states_.marks[index] & gpu::kMarkUnseen) == 0, states_.states[index]);
    figures.allowed = known(visibility::allowedDeviation(view_, input, states_.states[index], states_.marks[index]));
    return figures;
  }

 private:
  void addLevel(std::uint32_t index, ObjectFigures& figures) const {
    const gpu::Lod* lods = &scene_.lods[scene_.chains[figures.chain].firstLod];
    const float pixelsPerUnit = states_.boxes[index].pixelsPerUnit;
    figures.level = states_.states[index].lod;
    const gpu::Lod& lod = lods[figures.level];
    figures.triangles = lod.triangleCount;
    figures.errorPixels = known(lod.errorObject * pixelsPerUnit);
    if (figures.level == 0) return;
    const gpu::Lod& finer = lods[figures.level - 1];
    figures.finer = {std::uint64_t{finer.triangleCount} - std::min(lod.triangleCount, finer.triangleCount),
                     known(finer.errorObject * pixelsPerUnit)};
  }

  /// The error of patches falls with the square of their tessellation level.
  void addPatches(std::uint32_t index, ObjectFigures& figures) const {
    const gpu::Chain& chain = scene_.chains[figures.chain];
    const gpu::Lod& base = scene_.lods[chain.patchLod];
    const float flat = base.errorObject * states_.boxes[index].pixelsPerUnit;
    const std::uint32_t parts = std::max(states_.states[index].tessellation, 1U);
    const auto triangles = [&](std::uint32_t n) {
      return std::uint64_t{base.triangleCount} * scene::tessellatedTriangles(n);
    };
    const auto error = [&](std::uint32_t n) { return known(flat / static_cast<float>(n * n)); };
    figures.level = chain.lodCount - 1;
    figures.tessellation = parts;
    figures.triangles = triangles(parts);
    figures.errorPixels = error(parts);
    if (parts < view_.maxTessellation) figures.finer = {triangles(parts + 1) - figures.triangles, error(parts + 1)};
  }

  const scene::SceneData& scene_;
  gpu::CullView view_;
  States states_;
};

}  // namespace

ObjectsSample figuresOf(render::FrameRenderer& renderer, const scene::SceneData& scene, const std::vector<float>& error,
                        const std::vector<std::uint32_t>& referenceIds, std::size_t most) {
  const Judge judge(renderer, scene);
  renderer.renderIds();
  const std::vector<std::uint32_t> ids = renderer.readIds();
  JAL_CHECK(ids.size() == error.size());
  JAL_CHECK(ids.size() == referenceIds.size());
  const std::vector<Share> shares = sharesOf({ids, referenceIds, error, renderer.width()}, judge.exact());
  ObjectsSample sample;
  sample.flipOfBackground = shares[0].flip;
  std::vector<std::uint32_t> order;
  for (std::uint32_t i = 0; i < scene.objects.size(); ++i)
    if (shares[i + 1].pixels > 0 || shares[i + 1].referencePixels > 0) order.push_back(i);
  for (const Share& share : shares)
    sample.flip += share.flip;
  sample.listed = order.size();
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return shares[a + 1].flip > shares[b + 1].flip; });
  order.resize(std::min(order.size(), most));
  for (const std::uint32_t i : order)
    sample.rows.push_back(judge.judge(i, shares[i + 1]));
  return sample;
}

}  // namespace jalousie::compare
