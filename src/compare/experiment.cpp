// Steps of an experiment: measured frames, kept frames, points of the sweep.
#include "compare/experiment.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "asset/image_io.h"
#include "compare/experiment_log.h"
#include "core/check.h"
#include "core/error.h"

namespace jalousie::compare {
namespace {

constexpr std::size_t kReferencesInMemory = 2;

render::FrameOptions referenceOptions(Reference reference) {
  render::FrameOptions options;
  options.cullMode = reference == Reference::kFull ? gpu::kCullNone : gpu::kCullHiz;
  options.lodRule = gpu::kLodFinest;
  options.lvMeasure = gpu::kLvNone;
  return options;
}

/// Whether a frame depends on the ones before it.
bool remembers(const render::FrameOptions& options) {
  return options.cullMode == gpu::kCullHiz || options.lvMeasure == gpu::kLvPixels || options.calm;
}

/// Mean difference between what changes in a picture and what changes in the reference.
double temporalError(const FlipImage& before, const FlipImage& after, const std::vector<float>& motion) {
  std::vector<float> moved = flipMap(before, after);
  for (std::size_t i = 0; i < moved.size(); ++i)
    moved[i] = std::abs(moved[i] - motion[i]);
  return mean(moved);
}

/// Whether a file is one that pictureName() names.
bool isPicture(const std::string& name) {
  const bool digits = name.size() > 5 && name.find_first_not_of("0123456789") >= 5;
  return digits && (name.ends_with("-image.png") || name.ends_with("-error.png") || name.ends_with("-lod.png"));
}

/// KEY-FRAME.png, the key of 16 digits.
bool isReference(const std::string& name) {
  return name.size() >= 26 && name[16] == '-' && name.find_first_not_of("0123456789abcdef") == 16 &&
         name.ends_with(".png");
}

/// Removes what an earlier experiment left, but for references that serve this one.
void removeOldPictures(const std::filesystem::path& folder, const std::string& referenceKey) {
  std::error_code error;
  const auto remove = [&](const char* name, const auto& isOld) {
    std::vector<std::filesystem::path> old;
    for (const auto& entry : std::filesystem::directory_iterator(folder / name, error))
      if (isOld(entry.path().filename().string())) old.push_back(entry.path());
    for (const std::filesystem::path& file : old)
      std::filesystem::remove(file, error);
  };
  remove("pictures", isPicture);
  remove("references", [&](const std::string& name) { return isReference(name) && !name.starts_with(referenceKey); });
}

void forgetOldest(auto& entries, std::uint32_t kept) {
  while (entries.size() > kReferencesInMemory)
    entries.erase(entries.begin()->first != kept ? entries.begin() : std::prev(entries.end()));
}

}  // namespace

Switches countSwitches(render::FrameRenderer& renderer) {
  const std::vector<gpu::uint> marks = renderer.readMarks();
  renderer.renderIds();
  std::vector<bool> seen(marks.size() + 1);
  for (const std::uint32_t id : renderer.readIds())
    seen[id] = true;
  Switches result;
  for (std::size_t i = 0; i < marks.size(); ++i) {
    if (!seen[i + 1]) continue;
    ++result.visible;
    result.switched += (marks[i] & gpu::kMarkSwitched) != 0 ? 1 : 0;
  }
  return result;
}

std::vector<std::uint32_t> FrameRange::frames() const {
  JAL_CHECK(step > 0U);
  std::vector<std::uint32_t> result;
  for (std::uint64_t frame = first; frame <= last; frame += step)
    result.push_back(static_cast<std::uint32_t>(frame));
  return result;
}

std::vector<std::uint32_t> Plan::keptFrames() const {
  const std::vector<std::uint32_t> frames = range.frames();
  std::vector<std::uint32_t> result;
  if (reference == Reference::kNone || frames.empty()) return result;
  const std::size_t count = std::min<std::size_t>(keep, frames.size());
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t index = count == 1 ? frames.size() / 2 : i * (frames.size() - 1) / (count - 1);
    result.push_back(frames[index]);
  }
  return result;
}

std::string pictureName(std::uint32_t frame, const std::string& configuration, Picture picture) {
  std::string name;
  for (const char c : configuration) {
    const bool plain =
        (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' || c == '+' || c == '-';
    name += plain ? c : '_';
  }
  const char* const kinds[] = {"image", "error", "lod"};
  return fmt::format("{:05}-{}-{}.png", frame, name, kinds[static_cast<int>(picture)]);
}

Experiment::Experiment(const Scenes& scenes, const asset::Camera& path,
                       const std::vector<Configuration>& configurations, const Plan& plan, std::filesystem::path folder,
                       const std::string& fingerprint, bool resume)
    : scenes_(scenes),
      path_(path),
      configurations_(configurations),
      plan_(plan),
      folder_(std::move(folder)),
      referenceKey_(referenceFingerprint(scenes.plain, path, plan)),
      lastSeen_(configurations.size()),
      renderers_(configurations.size()) {
  JAL_CHECK(!configurations.empty());
  for (const std::uint32_t frame : plan.range.frames())
    steps_.push_back({StepKind::kFrame, frame});
  const std::vector<std::uint32_t> kept = plan.keptFrames();
  for (const std::uint32_t frame : kept)
    steps_.push_back({StepKind::kKeep, frame});
  const bool sweeps =
      std::any_of(configurations.begin(), configurations.end(), [](const Configuration& c) { return c.followsTau(); });
  for (const std::uint32_t frame : kept)
    for (const float tau : plan.taus)
      if (sweeps) steps_.push_back({StepKind::kSweep, frame, tau});
  done_ = resume ? readLog(folder_, fingerprint, results_) : 0;
  for (const Sample& sample : results_.samples)
    if (sample.configuration >= configurations.size())
      throw Error(ErrorCode::kMalformed, "names configurations that do not exist; leave out --resume", folder_);
  if (done_ > steps_.size())
    throw Error(ErrorCode::kUsage, "holds more than this experiment; leave out --resume to start over", folder_);
  if (done_ == 0) startLog(folder_, fingerprint);
  for (const char* name : {"pictures", "references"}) {
    std::error_code error;
    std::filesystem::create_directories(folder_ / name, error);
    if (error) throw Error(ErrorCode::kWriteFailed, error.message(), folder_ / name);
  }
  if (done_ == 0) removeOldPictures(folder_, referenceKey_);
  results_.complete = done_ == steps_.size();
}

Experiment::~Experiment() = default;

std::string Experiment::nextStep() const {
  if (done_ == steps_.size()) return {};
  const Step& step = steps_[done_];
  switch (step.kind) {
    case StepKind::kFrame:
      return fmt::format("frame {}", step.frame);
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
    case StepKind::kKeep:
      added.kept = runKeep(step.frame);
      break;
    case StepKind::kSweep:
      added.sweep = runSweep(step.frame, step.tau);
      break;
  }
  appendLog(folder_, added);
  append(results_, added);
  ++done_;
  results_.complete = done_ == steps_.size();
}

scene::Camera Experiment::camera(std::uint32_t frame) const {
  return scene::cameraAtFrame(path_, static_cast<float>(frame));
}

render::FrameRenderer& Experiment::renderer(std::size_t configuration) {
  std::unique_ptr<render::FrameRenderer>& slot = renderers_[configuration];
  if (slot == nullptr) {
    const Configuration& c = configurations_[configuration];
    const bool patches = c.frame.detail == gpu::kDetailTessellation;
    if (patches) JAL_CHECK((scenes_.patches != nullptr));
    slot = std::make_unique<render::FrameRenderer>(patches ? *scenes_.patches : scenes_.plain, plan_.width,
                                                   plan_.height, c.renderer);
    // Warm-up: the driver compiles its shaders, memory is touched.
    render::FrameOptions options = c.frame;
    options.skipDraw = plan_.reference == Reference::kNone;
    slot->render(options, camera(plan_.range.first), camera(plan_.range.first));
    slot->resetHistory();
  }
  return *slot;
}

render::FrameRenderer& Experiment::referenceRenderer() {
  if (referenceRenderer_ == nullptr)
    referenceRenderer_ = std::make_unique<render::FrameRenderer>(scenes_.plain, plan_.width, plan_.height);
  return *referenceRenderer_;
}

void Experiment::approach(render::FrameRenderer& renderer, const render::FrameOptions& options, std::uint32_t frame) {
  renderer.timer().setTiming(gl::Timing::kOff);
  renderer.resetHistory();
  render::FrameOptions quiet = options;
  quiet.skipDraw = true;
  // What remembers nothing still needs a frame before, whose levels it may leave.
  const std::uint32_t lead = remembers(options) ? plan_.lead : std::min(plan_.lead, 1U);
  for (std::uint32_t k = frame - std::min(frame, lead); k < frame; ++k)
    renderer.render(quiet, camera(k), camera(k));
}

/// On a path without gaps: after an interruption, the history goes through the frames that were measured before it, and
/// the last of them is seen again.
void Experiment::catchUp(std::uint32_t frame) {
  for (std::uint32_t k = lastFrame_ ? *lastFrame_ + 1 : plan_.range.first; k < frame; ++k) {
    for (std::size_t c = 0; c < configurations_.size(); ++c) {
      render::FrameOptions quiet = configurations_[c].frame;
      quiet.skipDraw = k + 1 < frame || plan_.reference == Reference::kNone;
      renderer(c).timer().setTiming(gl::Timing::kOff);
      renderer(c).render(quiet, camera(k), camera(k));
      if (!quiet.skipDraw) lastSeen_[c].emplace(renderer(c).readImage(), plan_.pixelsPerDegree);
    }
  }
  lastFrame_ = frame;
}

Sample Experiment::measure(std::size_t configuration, const render::FrameOptions& options, std::uint32_t frame) {
  render::FrameRenderer& target = renderer(configuration);
  Sample sample;
  sample.frame = frame;
  sample.configuration = configuration;
  target.timer().setTiming(plan_.gpuTiming ? gl::Timing::kGpu : gl::Timing::kWall);
  target.render(options, camera(frame), camera(frame));
  for (const gl::PassTime& pass : target.timer().passes()) {
    // A frame whose pixels are counted has a pass of one name twice where the culling camera is frozen.
    sample.passes.emplace_back(std::string(pass.name), pass.ms);
    sample.frameMs += pass.ms;
  }
  target.timer().setTiming(gl::Timing::kOff);
  sample.statistics = target.readStatistics();
  return sample;
}

const ImageRgba8& Experiment::referenceImage(std::uint32_t frame) {
  if (const auto there = references_.find(frame); there != references_.end()) return there->second;
  const std::filesystem::path file = folder_ / "references" / fmt::format("{}-{:05}.png", referenceKey_, frame);
  ImageRgba8 image;
  std::error_code ignored;
  if (std::filesystem::is_regular_file(file, ignored)) {
    image = asset::loadImage(file);
  } else {
    render::FrameRenderer& target = referenceRenderer();
    const render::FrameOptions options = referenceOptions(plan_.reference);
    target.resetHistory();
    target.render(options, camera(frame), camera(frame));
    image = target.readImage();
    asset::savePng(image, file);
  }
  if (image.width != plan_.width || image.height != plan_.height)
    throw Error(ErrorCode::kMalformed, "a cached reference of another size; delete it", file);
  const ImageRgba8& result = references_.insert_or_assign(frame, std::move(image)).first->second;
  forgetOldest(references_, frame);
  return result;
}

const FlipImage& Experiment::referenceFlip(std::uint32_t frame) {
  if (const auto there = referenceFlips_.find(frame); there != referenceFlips_.end()) return there->second;
  const FlipImage& result =
      referenceFlips_.emplace(frame, FlipImage(referenceImage(frame), plan_.pixelsPerDegree)).first->second;
  forgetOldest(referenceFlips_, frame);
  return result;
}

ImageError Experiment::errorOf(const ImageRgba8& image, const FlipImage& seen, std::uint32_t frame) {
  const ImageRgba8& reference = referenceImage(frame);
  return {psnr(reference, image), ssim(reference, image), mean(flipMap(referenceFlip(frame), seen))};
}

/// From one frame to the next, what moves in the reference moves in the picture too.
std::vector<float> Experiment::motionInReference(std::uint32_t from, std::uint32_t to) {
  const FlipImage before = referenceFlip(from);  // a copy: the cache may forget it for the other one
  return flipMap(before, referenceFlip(to));
}

std::vector<Sample> Experiment::runFrame(std::uint32_t frame) {
  const bool pictures = plan_.reference != Reference::kNone;
  const bool continuous = plan_.range.step == 1;
  if (continuous) catchUp(frame);
  std::vector<Sample> samples(configurations_.size());
  std::vector<ImageRgba8> images(configurations_.size());
  const bool hasPredecessor = continuous ? frame > plan_.range.first : std::min(frame, plan_.lead) > 0;
  const std::size_t offset = (frame - plan_.range.first) / plan_.range.step;
  for (std::size_t turn = 0; turn < configurations_.size(); ++turn) {
    // Another one goes first in every frame: none always follows the same neighbour.
    const std::size_t c = (turn + offset) % configurations_.size();
    render::FrameOptions options = configurations_[c].frame;
    options.skipDraw = !pictures;
    if (!continuous) approach(renderer(c), options, frame);
    samples[c] = measure(c, options, frame);
    if (!pictures) continue;
    images[c] = renderer(c).readImage();
    const Switches switches = countSwitches(renderer(c));
    samples[c].visible = switches.visible;
    if (hasPredecessor) samples[c].switched = switches.switched;
  }
  if (!pictures) return samples;
  const bool follows = continuous && frame > plan_.range.first;
  const std::vector<float> motion = follows ? motionInReference(frame - 1, frame) : std::vector<float>();
  for (std::size_t c = 0; c < configurations_.size(); ++c) {
    FlipImage seen(images[c], plan_.pixelsPerDegree);
    samples[c].error = errorOf(images[c], seen, frame);
    if (follows) samples[c].temporal = temporalError(*lastSeen_[c], seen, motion);
    if (continuous) lastSeen_[c].emplace(std::move(seen));
  }
  return samples;
}

std::vector<KeptSample> Experiment::runKeep(std::uint32_t frame) {
  const std::filesystem::path pictures = folder_ / "pictures";
  const std::uint32_t before = frame > 0 ? frame - 1 : frame;
  const std::vector<float> motion = motionInReference(before, frame);
  std::vector<KeptSample> result;
  for (std::size_t c = 0; c < configurations_.size(); ++c) {
    const Configuration& configuration = configurations_[c];
    render::FrameRenderer& target = renderer(c);
    const auto draw = [&](std::uint32_t at, gpu::uint view = gpu::kViewShaded) {
      render::FrameOptions options = configuration.frame;
      options.view = view;
      target.render(options, camera(at), camera(at));
      return target.readImage();
    };
    approach(target, configuration.frame, before);
    const FlipImage last(draw(before), plan_.pixelsPerDegree);
    // Frame 0 has none before it: it stands still.
    const ImageRgba8 image = draw(frame);
    const FlipImage seen(image, plan_.pixelsPerDegree);
    const FlipImage frozen(draw(frame), plan_.pixelsPerDegree);
    const ImageRgba8 levels = draw(frame, gpu::kViewLod);

    KeptSample sample;
    sample.frame = frame;
    sample.configuration = c;
    const std::vector<float> change = flipMap(seen, frozen);
    sample.frozenMean = mean(change);
    sample.frozenLargest = static_cast<double>(*std::max_element(change.begin(), change.end()));
    sample.temporal = temporalError(last, seen, motion);
    result.push_back(sample);

    const std::vector<float> error = flipMap(referenceFlip(frame), seen);
    asset::savePng(image, pictures / pictureName(frame, configuration.name, Picture::kImage));
    asset::savePng(errorPicture(error, plan_.width, plan_.height),
                   pictures / pictureName(frame, configuration.name, Picture::kError));
    asset::savePng(levels, pictures / pictureName(frame, configuration.name, Picture::kLod));
  }
  asset::savePng(referenceImage(frame), pictures / pictureName(frame, kReferenceName, Picture::kImage));
  lastFrame_.reset();
  return result;
}

std::vector<SweepSample> Experiment::runSweep(std::uint32_t frame, float tau) {
  std::vector<SweepSample> result;
  for (std::size_t c = 0; c < configurations_.size(); ++c) {
    if (!configurations_[c].followsTau()) continue;
    render::FrameOptions options = configurations_[c].frame;
    options.tau = tau;
    approach(renderer(c), options, frame);
    const Sample sample = measure(c, options, frame);
    const ImageRgba8 image = renderer(c).readImage();
    result.push_back({c, tau, frame, sample.statistics.triangles, sample.frameMs,
                      errorOf(image, FlipImage(image, plan_.pixelsPerDegree), frame)});
  }
  lastFrame_.reset();
  return result;
}

}  // namespace jalousie::compare
