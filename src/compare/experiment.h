// An experiment: one camera path under several configurations, interleaved frame by frame, against a reference.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "asset/scene_file.h"
#include "compare/image_error.h"
#include "render/frame_renderer.h"
#include "scene/camera.h"

namespace jalousie::compare {

/// One way to render the scene.
struct Configuration {
  std::string name;         ///< unique within an experiment
  std::string commandLine;  ///< the same as options of `jalousie render`
  render::FrameOptions frame;
  render::RendererOptions renderer;  ///< its importance mask, if any, outlives the experiment

  /// Whether FrameOptions::tau says anything, so that a sweep can vary it.
  bool followsTau() const { return frame.lodRule == gpu::kLodPixelError || frame.lodRule == gpu::kLodLvError; }
};

/// What pictures are compared with: every object at LOD 0.
enum class Reference {
  kNone,  ///< no pictures at all: the culling passes and their figures alone
  kLod0,  ///< culled in two phases, which loses no pixel
  kFull,  ///< not culled at all; slow, and beyond doubt
};

/// The frames that are measured.
struct FrameRange {
  std::uint32_t first = 0;
  std::uint32_t last = 0;  ///< inclusive
  std::uint32_t step = 1;  ///< > 0

  std::vector<std::uint32_t> frames() const;
};

struct Plan {
  FrameRange range;
  std::uint32_t width = 1280;  ///< pixels
  std::uint32_t height = 720;
  Reference reference = Reference::kLod0;
  /// Where frames are left out (step > 1) and for the kept ones, history starts this many frames before.
  std::uint32_t lead = 8;
  std::uint32_t keep = 6;    ///< frames whose pictures are kept, evenly spread; 0: none
  std::vector<float> taus;   ///< of the sweep; empty: none
  std::size_t baseline = 0;  ///< index of the configuration that ratios refer to
  double pixelsPerDegree = kDefaultPixelsPerDegree;
  bool gpuTiming = false;  ///< timestamps on the GPU; off: wall time between glFinish, for software renderers
  std::string renderer;    ///< GL_RENDERER: pictures and times of two drivers never mix
  std::string build;       ///< digest of the program: nor do those of two builds

  /// Frames whose pictures are kept; none without a reference.
  std::vector<std::uint32_t> keptFrames() const;
};

/// Figures of one configuration at one frame.
struct Sample {
  std::uint32_t frame = 0;
  std::size_t configuration = 0;
  render::FrameStatistics statistics;
  double frameMs = 0.0;                                ///< all passes
  std::vector<std::pair<std::string, double>> passes;  ///< in frame order, ms
  std::optional<ImageError> error;                     ///< absent without a reference
  std::optional<std::uint64_t> visible;                ///< objects that show a pixel; absent without pictures
  std::optional<std::uint64_t> switched;               ///< of these: at another level than in the frame before
  std::optional<double> temporal;                      ///< as KeptSample::temporal; absent where frames are left out
};

/// Objects that a picture shows, and those of them at another level than in the frame before.
struct Switches {
  std::uint64_t visible = 0;
  std::uint64_t switched = 0;
};
/// Of the renderer's last frame; draws its object numbers and waits for them.
Switches countSwitches(render::FrameRenderer& renderer);

/// What a kept frame tells beside its pictures.
struct KeptSample {
  std::uint32_t frame = 0;
  std::size_t configuration = 0;
  /// Camera frozen, state advanced by one frame: what level switches alone change. FLIP of the two pictures.
  double frozenMean = 0.0;
  double frozenLargest = 0.0;  ///< of one pixel
  /// Mean |FLIP(I_k, I_k-1) - FLIP(R_k, R_k-1)| over the pixels: motion that the reference does not have (popping) and
  /// motion it has and the picture lacks.
  double temporal = 0.0;
};

/// One point of a configuration's curve, means over the kept frames.
struct SweepSample {
  std::size_t configuration = 0;
  float tau = 1.0F;
  std::uint32_t frame = 0;
  std::uint64_t triangles = 0;
  double frameMs = 0.0;
  ImageError error;
};

/// Everything measured so far, in the order of the plan.
struct Results {
  std::vector<Sample> samples;
  std::vector<KeptSample> kept;
  std::vector<SweepSample> sweep;
  bool complete = false;
};

/// The scene as its configurations need it.
struct Scenes {
  const scene::SceneData& plain;
  /// Built with patches; null if no configuration tessellates.
  const scene::SceneData* patches = nullptr;
};

/// File name of a kept picture: "00120-default-image.png". Names that differ in special characters may share one.
enum class Picture { kImage, kError, kLod };
/// The name of the reference among the configurations' pictures.
inline constexpr const char* kReferenceName = "reference";
std::string pictureName(std::uint32_t frame, const std::string& configuration, Picture picture);

/// Runs a plan step by step. Between steps everything is on disk: an interrupted experiment goes on where it stopped.
class Experiment {
 public:
  /// @param folder  of the report; exists   @param fingerprint  of scene, path, plan and configurations
  /// @param resume  goes on with what the folder holds; Errors: kUsage if that is another experiment
  /// Keeps references to all of them. Errors: kLimit, kWriteFailed.
  Experiment(const Scenes& scenes, const asset::Camera& path, const std::vector<Configuration>& configurations,
             const Plan& plan, std::filesystem::path folder, const std::string& fingerprint, bool resume);
  ~Experiment();
  Experiment(const Experiment&) = delete;
  Experiment& operator=(const Experiment&) = delete;

  std::size_t stepCount() const { return steps_.size(); }
  std::size_t stepsDone() const { return done_; }
  /// What the next step is, for people; empty when all are done.
  std::string nextStep() const;
  /// Runs the next step. @pre stepsDone() < stepCount() (checked). Errors: kWriteFailed.
  void runStep();

  const Results& results() const { return results_; }

 private:
  enum class StepKind { kFrame, kKeep, kSweep };
  struct Step {
    StepKind kind;
    std::uint32_t frame;
    float tau = 1.0F;
  };
  std::vector<Sample> runFrame(std::uint32_t frame);
  std::vector<KeptSample> runKeep(std::uint32_t frame);
  std::vector<SweepSample> runSweep(std::uint32_t frame, float tau);
  render::FrameRenderer& renderer(std::size_t configuration);
  render::FrameRenderer& referenceRenderer();
  void approach(render::FrameRenderer& renderer, const render::FrameOptions& options, std::uint32_t frame);
  void catchUp(std::uint32_t frame);
  Sample measure(std::size_t configuration, const render::FrameOptions& options, std::uint32_t frame);
  const ImageRgba8& referenceImage(std::uint32_t frame);
  const FlipImage& referenceFlip(std::uint32_t frame);
  ImageError errorOf(const ImageRgba8& image, const FlipImage& seen, std::uint32_t frame);
  std::vector<float> motionInReference(std::uint32_t from, std::uint32_t to);
  scene::Camera camera(std::uint32_t frame) const;

  const Scenes& scenes_;
  const asset::Camera& path_;
  const std::vector<Configuration>& configurations_;
  const Plan& plan_;
  std::filesystem::path folder_;
  std::string referenceKey_;
  std::vector<Step> steps_;
  std::size_t done_ = 0;
  std::optional<std::uint32_t> lastFrame_;          ///< that the renderers' history ends with, on a path without gaps
  std::vector<std::optional<FlipImage>> lastSeen_;  ///< its pictures, one per configuration
  Results results_;
  std::vector<std::unique_ptr<render::FrameRenderer>> renderers_;
  std::unique_ptr<render::FrameRenderer> referenceRenderer_;
  std::map<std::uint32_t, ImageRgba8> references_;  ///< of the last two frames asked for
  std::map<std::uint32_t, FlipImage> referenceFlips_;
};

}  // namespace jalousie::compare
