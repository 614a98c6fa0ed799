// Pictures of all open documents: rendering, composing, capturing.
#include "app/view/pictures.h"

#include <cmath>

#include "app/capture.h"
#include "app/view/clock.h"
#include "core/error.h"

namespace jalousie::app {

Pictures::Pictures(const gl::Capabilities& capabilities, ViewState& state, Documents& documents, Redraw& redraw)
    : capabilities_(capabilities), state_(state), documents_(documents), redraw_(redraw) {}

void Pictures::resize(std::uint32_t width, std::uint32_t height) {
  documents_.setSize(width, height);
  if (canvas_.width() == width && canvas_.height() == height) return;
  canvas_.resize(width, height);
  redraw_.scenesChanged();
}

void Pictures::render() {
  documents_.forgetHiddenFailures();
  for (std::size_t i = 0; i < documents_.size(); ++i)
    renderDocument(i);
}

void Pictures::renderDocument(std::size_t index) {
  Document& document = documents_[index];
  for (int side = 0; side < state_.sides(); ++side) {
    const RenderOptions options = documents_.optionsFor(index, side);
    Side* scene = document.prepare(side, options);
    if (scene == nullptr) continue;
    render::FrameRenderer& renderer = scene->renderer();
    renderer.setTiming(capabilities_.softwareRenderer ? Timing::kWall : Timing::kGpu);
    const std::optional<RenderCameras> cameras = documents_.camerasFor(index, side);
    if (!cameras) continue;
    renderer.render(options.frameOptions, cameras->cull, cameras->draw);
    if (index != state_.current || side != 0) continue;
    if (historyOf_ != &document) state_.history.clear();
    historyOf_ = &document;
    if (const auto statistics = renderer.latestStatistics())
      state_.history.add(makeSample(secondsNow(), renderer.passTimes(), *statistics));
  }
}

void Pictures::flicker() {
  if (!state_.flicker) return;
  const auto seconds = static_cast<double>(state_.flickerSeconds);
  const int side = std::fmod(secondsNow(), 2.0 * seconds) < seconds ? 0 : 1;
  if (side != state_.flickerSide) redraw_.interfaceChanged(1);
  state_.flickerSide = side;
}

void Pictures::compose() {
  canvas_.clear();
  for (std::size_t i = 0; i < documents_.size(); ++i)
    composeDocument(i);
}

void Pictures::composeDocument(std::size_t index) {
  const Region where = documents_.region(index);
  const auto left = static_cast<std::uint32_t>(where.x);
  const auto width = static_cast<std::uint32_t>(where.width);
  // A picture is copied only at its full size: after a failure it may still have another one.
  const auto columns = [&](Side* side, std::uint32_t from, std::uint32_t count) {
    if (side != nullptr && side->renderer().width() == width && side->renderer().height() == canvas_.height())
      canvas_.copy(side->renderer().color(), from, left + from, count);
  };
  Side* b = state_.showsDivider() ? documents_[index].side(1) : nullptr;
  const std::uint32_t divider = b != nullptr ? static_cast<std::uint32_t>(where.dividerColumns(state_.divider)) : width;
  columns(documents_[index].side(state_.firstSide()), 0, divider);
  columns(b, divider, width - divider);
}

ImageRgba8 Pictures::capture() {
  if (canvas_.width() == 0) throw Error(ErrorCode::kUsage, "the window has no size, so there is no picture");
  for (std::size_t i = 0; i < documents_.size(); ++i) {
    for (int side = 0; side < state_.sides(); ++side) {
      const RenderOptions options = documents_.optionsFor(i, side);
      Side* scene = documents_[i].prepare(side, options);
      if (scene == nullptr) continue;
      captureFrame(options, scene->renderer(), capabilities_,
                   renderCameras(options, scene->scene(), documents_[i].path()));
    }
  }
  compose();
  return canvas_.read();
}

void Pictures::forgetHistory() {
  historyOf_ = nullptr;
  state_.history.clear();
}

}  // namespace jalousie::app
