// Steps of an experiment: measured frames, kept frames, points of the sweep.
#include "compare/experiment.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "asset/image_io.h"
#include "asset/scene_file.h"
#include "compare/configuration.h"
#include "compare/experiment_log.h"
#include "compare/fingerprint.h"
#include "compare/frame_objects.h"
#include "compare/report_folder.h"
#include "core/check.h"
#include "core/error.h"
#include "render/frame_renderer.h"
#include "scene/camera.h"
#include "scene/scene_data.h"

namespace jalousie::compare {
namespace {

scene::Camera cameraAt(const asset::Camera& path, std::uint32_t frame) {
  return scene::cameraAtFrame(path, static_cast<float>(frame));
}

/// Renders a frame of the path, with the animations at its time.
void renderFrame(render::FrameRenderer& renderer, render::FrameOptions options, const asset::Camera& path,
                 std::uint32_t frame) {
  const scene::Camera camera = cameraAt(path, frame);
  options.seconds = scene::secondsAt(static_cast<float>(frame));
  renderer.render(options, camera, camera);
}

/// Mean |FLIP(after, before) - motion| over the pixels. @param motion  ReferenceFrames::motion() of the same frames
double temporalError(const FlipImage& before, const FlipImage& after, const std::vector<float>& motion) {
  std::vector<float> moved = flipMap(before, after);
  for (std::size_t i = 0; i < moved.size(); ++i)
    moved[i] = std::abs(moved[i] - motion[i]);
  return mean(moved);
}

/// The measured frame in which a configuration has the largest FLIP over the pixels that show an object; the first one
/// of equals. @pre the configuration has been measured (checked)
std::uint32_t worstFrame(const Results& results, std::size_t configuration) {
  const Sample* worst = nullptr;
  const auto errorOf = [](const Sample& s) { return s.error ? s.error->flipCovered.value_or(s.error->flip) : 0.0; };
  for (const Sample& sample : results.samples)
    if (sample.configuration == configuration && (worst == nullptr || errorOf(sample) > errorOf(*worst)))
      worst = &sample;
  const bool wasMeasured = worst != nullptr;
  JAL_CHECK(wasMeasured);
  return worst->frame;
}

/// The column with half of the weight on each side, share of the width; absent without any weight.
std::optional<double> middleColumn(const std::vector<float>& weights, std::size_t width) {
  std::vector<double> columns(width);
  double sum = 0.0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    columns[i % width] += static_cast<double>(weights[i]);
    sum += static_cast<double>(weights[i]);
  }
  if (!(sum > 0.0)) return std::nullopt;
  double left = 0.0;
  std::size_t column = 0;
  for (; column + 1 < width && left + columns[column] < 0.5 * sum; ++column)
    left += columns[column];
  return (static_cast<double>(column) + 0.5) / static_cast<double>(width);
}

/// KeptSample::subject. @param covered  coveredPixels()
double subjectOf(const std::vector<float>& error, const std::vector<std::uint8_t>& covered, std::size_t width) {
  if (const auto column = middleColumn(error, width)) return *column;
  return middleColumn(std::vector<float>(covered.begin(), covered.end()), width).value_or(0.5);
}

}  // namespace

Experiment::Experiment(ExperimentInputs inputs)
    : inputs_(std::move(inputs)),
      referenceKey_(referenceFingerprint(inputs_.scenes.plain, inputs_.path, inputs_.plan)),
      reference_(inputs_.scenes.plain, inputs_.path, inputs_.plan, inputs_.folder, referenceKey_),
      renderers_(inputs_.configurations.size()),
      lastSeen_(inputs_.configurations.size()) {
  JAL_CHECK(!inputs_.configurations.empty());
  planSteps();
  if (inputs_.resume) readFinishedSteps();
  if (done_ == 0) startLog(inputs_.folder, inputs_.fingerprint);
  makePictureFolders(inputs_.folder);
  if (done_ == 0) removeOldPictures(inputs_.folder, referenceKey_);
  results_.complete = done_ == steps_.size();
}

Experiment::~Experiment() = default;

void Experiment::planSteps() {
  const Plan& plan = inputs_.plan;
  for (const std::uint32_t frame : plan.range.frames())
    steps_.push_back({StepKind::kFrame, frame});
  const bool pictures = plan.reference != Reference::kNone && !steps_.empty();
  for (std::size_t c = 0; c < inputs_.configurations.size() && pictures && plan.objects > 0; ++c)
    steps_.push_back({.kind = StepKind::kObjects, .configuration = c});
  const std::vector<std::uint32_t> kept = plan.keptFrames();
  for (const std::uint32_t frame : kept)
    steps_.push_back({StepKind::kKeep, frame});
  const bool sweeps = std::any_of(inputs_.configurations.begin(), inputs_.configurations.end(),
                                  [](const Configuration& c) { return c.followsTau(); });
  for (const std::uint32_t frame : kept)
    for (const float tau : plan.taus)
      if (sweeps) steps_.push_back({StepKind::kSweep, frame, tau});
}

void Experiment::readFinishedSteps() {
  done_ = readLog(inputs_.folder, inputs_.fingerprint, results_);
  for (const Sample& sample : results_.samples) {
    if (sample.configuration >= inputs_.configurations.size()) {
      throw Error(ErrorCode::kMalformed,
                  "names configurations that do not exist; say --force instead of --resume to start over",
                  inputs_.folder);
    }
  }
  if (done_ > steps_.size()) {
    throw Error(ErrorCode::kUsage,
                "holds more steps than this experiment has; say --force instead of --resume to start over",
                inputs_.folder);
  }
}

std::string Experiment::nextStep() const {
  if (done_ == steps_.size()) return {};
  const Step& step = steps_[done_];
  switch (step.kind) {
    case StepKind::kFrame:
      return fmt::format("frame {}", step.frame);
    case StepKind::kObjects:
      return fmt::format("objects of {}", inputs_.configurations[step.configuration].name);
    case StepKind::kKeep:
      return fmt::format("pictures of frame {}", step.frame);
    case StepKind::kSweep:
      break;
  }
  return fmt::format("frame {} with tau {}", step.frame, step.tau);
}

void Experiment::runStep() {
  JAL_CHECK(done_ < steps_.size());
  const Step& step = steps_[done_];
  Results added;
  switch (step.kind) {
    case StepKind::kFrame:
      added.samples = runFrame(step.frame);
      break;
    case StepKind::kObjects:
      added.objects = runObjects(step.configuration);
      break;
    case StepKind::kKeep:
      added.kept = runKeep(step.frame);
      break;
    case StepKind::kSweep:
      added.sweep = runSweep(step.frame, step.tau);
      break;
  }
  appendLog(inputs_.folder, added);
  append(results_, added);
  ++done_;
  results_.complete = done_ == steps_.size();
}

render::FrameRenderer& Experiment::renderer(std::size_t configuration) {
  std::unique_ptr<render::FrameRenderer>& slot = renderers_[configuration];
  if (slot == nullptr) {
    const Configuration& c = inputs_.configurations[configuration];
    slot = std::make_unique<render::FrameRenderer>(*inputs_.scenes.ofConfigurations.at(configuration),
                                                   inputs_.plan.width, inputs_.plan.height, c.renderer);
    slot->prepare(c.frame);
    // Warm-up: the driver compiles the shaders and allocates memory in the first frame.
    render::FrameOptions options = c.frame;
    options.skipDraw = inputs_.plan.reference == Reference::kNone;
    renderFrame(*slot, options, inputs_.path, inputs_.plan.range.first);
    slot->resetHistory();
  }
  return *slot;
}

/// Starts a new history and renders the frames that lead to `frame`, without measuring them.
void Experiment::approach(render::FrameRenderer& renderer, const render::FrameOptions& options, std::uint32_t frame) {
  renderer.setTiming(Timing::kOff);
  renderer.resetHistory();
  render::FrameOptions quiet = options;
  quiet.skipDraw = true;
  // One frame is rendered even where nothing depends on it: switches are counted against its levels.
  const std::uint32_t lead = dependsOnHistory(options) ? inputs_.plan.lead : std::min(inputs_.plan.lead, 1U);
  for (std::uint32_t k = frame - std::min(frame, lead); k < frame; ++k)
    renderFrame(renderer, quiet, inputs_.path, k);
}

/// On a path without gaps, brings the renderers to the state that they would have without an interruption: renders all
/// frames before `frame` that they have not rendered, and reads the pictures of the last one.
void Experiment::catchUp(std::uint32_t frame) {
  const std::uint32_t first = inputs_.plan.range.first;
  if (!lastFrame_) {
    for (std::size_t c = 0; c < inputs_.configurations.size(); ++c)
      approach(renderer(c), inputs_.configurations[c].frame, first);
  }
  for (std::uint32_t k = lastFrame_ ? *lastFrame_ + 1 : first; k < frame; ++k) {
    for (std::size_t c = 0; c < inputs_.configurations.size(); ++c) {
      render::FrameOptions quiet = inputs_.configurations[c].frame;
      quiet.skipDraw = k + 1 < frame || inputs_.plan.reference == Reference::kNone;
      renderer(c).setTiming(Timing::kOff);
      renderFrame(renderer(c), quiet, inputs_.path, k);
      if (!quiet.skipDraw) lastSeen_[c].emplace(renderer(c).readImage(), inputs_.plan.pixelsPerDegree);
    }
  }
  lastFrame_ = frame;
}

Sample Experiment::measure(std::size_t configuration, const render::FrameOptions& options, std::uint32_t frame) {
  render::FrameRenderer& target = renderer(configuration);
  Sample sample;
  sample.frame = frame;
  sample.configuration = configuration;
  target.setTiming(inputs_.plan.gpuTiming ? Timing::kGpu : Timing::kWall);
  renderFrame(target, options, inputs_.path, frame);
  for (const PassTime& pass : target.passTimes()) {
    // In a frame that counts pixels, two passes can have the same name.
    sample.passes.emplace_back(std::string(pass.name), pass.ms);
    sample.frameMs += pass.ms;
  }
  target.setTiming(Timing::kOff);
  sample.statistics = target.readStatistics();
  return sample;
}

std::vector<Sample> Experiment::runFrame(std::uint32_t frame) {
  const Plan& plan = inputs_.plan;
  const std::size_t count = inputs_.configurations.size();
  const bool pictures = plan.reference != Reference::kNone;
  if (isContinuous()) catchUp(frame);
  std::vector<Sample> samples(count);
  std::vector<Shown> shown(count);
  const bool hasPredecessor = (isContinuous() && frame > plan.range.first) || std::min(frame, plan.lead) > 0;
  const std::size_t offset = (frame - plan.range.first) / plan.range.step;
  for (std::size_t turn = 0; turn < count; ++turn) {
    // The first configuration changes from frame to frame, so that none always runs after the same neighbour.
    const std::size_t c = (turn + offset) % count;
    render::FrameOptions options = inputs_.configurations[c].frame;
    options.skipDraw = !pictures;
    if (!isContinuous()) approach(renderer(c), options, frame);
    samples[c] = measure(c, options, frame);
    if (!pictures) continue;
    shown[c].image = renderer(c).readImage();
    FrameObjects objects = countObjects(renderer(c));
    samples[c].visible = objects.visible;
    if (hasPredecessor) samples[c].switched = objects.switched;
    samples[c].lost = objects.lost;
    samples[c].wrongPixels = objects.wrongPixels;
    shown[c].covered = std::move(objects.covered);
  }
  if (pictures) addErrors(samples, shown);
  return samples;
}

/// Fills the errors of one frame's samples. @param shown  their pictures, [configurations]
void Experiment::addErrors(std::vector<Sample>& samples, const std::vector<Shown>& shown) {
  const std::uint32_t frame = samples.front().frame;
  const bool follows = isContinuous() && frame > inputs_.plan.range.first;
  const std::vector<float> motion = follows ? reference_.motion(frame - 1, frame) : std::vector<float>();
  for (std::size_t c = 0; c < samples.size(); ++c) {
    FlipImage seen(shown[c].image, inputs_.plan.pixelsPerDegree);
    samples[c].error = reference_.errorOf(shown[c].image, seen, frame, shown[c].covered);
    if (follows) samples[c].temporal = temporalError(*lastSeen_[c], seen, motion);
    if (isContinuous()) lastSeen_[c].emplace(std::move(seen));
  }
}

/// Lists the objects of one configuration in its worst frame.
std::vector<ObjectsSample> Experiment::runObjects(std::size_t configuration) {
  const std::uint32_t frame = worstFrame(results_, configuration);
  const render::FrameOptions& options = inputs_.configurations[configuration].frame;
  render::FrameRenderer& target = renderer(configuration);
  approach(target, options, frame);
  renderFrame(target, options, inputs_.path, frame);
  const FlipImage seen(target.readImage(), inputs_.plan.pixelsPerDegree);
  const std::vector<float> error = flipMap(reference_.flip(frame), seen);
  ObjectsSample sample = figuresOf(target, *inputs_.scenes.ofConfigurations.at(configuration), error,
                                   reference_.ids(frame), inputs_.plan.objects);
  sample.frame = frame;
  sample.configuration = configuration;
  lastFrame_.reset();
  return {std::move(sample)};
}

std::vector<KeptSample> Experiment::runKeep(std::uint32_t frame) {
  const std::vector<float> motion = reference_.motion(frame > 0 ? frame - 1 : frame, frame);
  std::vector<KeptSample> result;
  for (std::size_t c = 0; c < inputs_.configurations.size(); ++c)
    result.push_back(keep(c, frame, motion));
  asset::savePng(reference_.image(frame),
                 pictureFile(inputs_.folder, pictureName(frame, kReferenceName, Picture::kImage)));
  lastFrame_.reset();
  return result;
}

/// Measures one configuration at a kept frame and stores its pictures.
KeptSample Experiment::keep(std::size_t configuration, std::uint32_t frame, const std::vector<float>& motion) {
  const Configuration& chosen = inputs_.configurations[configuration];
  const Plan& plan = inputs_.plan;
  render::FrameRenderer& target = renderer(configuration);
  const auto draw = [&](std::uint32_t at, View view = View::kShaded) {
    render::FrameOptions options = chosen.frame;
    options.view = view;
    renderFrame(target, options, inputs_.path, at);
    return target.readImage();
  };
  const std::uint32_t before = frame > 0 ? frame - 1 : frame;  // frame 0 has no predecessor: its own camera serves
  approach(target, chosen.frame, before);
  const FlipImage last(draw(before), plan.pixelsPerDegree);
  const ImageRgba8 image = draw(frame);
  const FlipImage seen(image, plan.pixelsPerDegree);
  const FlipImage frozen(draw(frame), plan.pixelsPerDegree);
  const ImageRgba8 levels = draw(frame, View::kLod);
  target.renderIds();
  const std::vector<std::uint8_t> covered = coveredPixels(target.readIds(), plan.width);

  const std::vector<float> change = flipMap(seen, frozen);
  const std::vector<float> error = flipMap(reference_.flip(frame), seen);
  const auto save = [&](const ImageRgba8& picture, Picture kind) {
    asset::savePng(picture, pictureFile(inputs_.folder, pictureName(frame, chosen.name, kind)));
  };
  save(image, Picture::kImage);
  save(errorPicture(error, plan.width, plan.height), Picture::kError);
  save(levels, Picture::kLod);
  return {frame,
          configuration,
          mean(change),
          static_cast<double>(*std::max_element(change.begin(), change.end())),
          temporalError(last, seen, motion),
          subjectOf(error, covered, plan.width)};
}

std::vector<SweepSample> Experiment::runSweep(std::uint32_t frame, float tau) {
  std::vector<SweepSample> result;
  for (std::size_t c = 0; c < inputs_.configurations.size(); ++c) {
    if (!inputs_.configurations[c].followsTau()) continue;
    render::FrameOptions options = inputs_.configurations[c].frame;
    options.tau = tau;
    approach(renderer(c), options, frame);
    const Sample sample = measure(c, options, frame);
    const ImageRgba8 image = renderer(c).readImage();
    const FlipImage seen(image, inputs_.plan.pixelsPerDegree);
    result.push_back(
        {c, tau, frame, sample.statistics.triangles, sample.frameMs, reference_.errorOf(image, seen, frame)});
  }
  lastFrame_.reset();
  return result;
}

}  // namespace jalousie::compare
