// An experiment: one camera path under several configurations, interleaved frame by frame, against a reference.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "compare/image_error.h"
#include "compare/plan.h"
#include "compare/reference_frames.h"
#include "compare/results.h"

namespace jalousie::render {
struct FrameOptions;
}

namespace jalousie::compare {

struct Configuration;

/// The scene in the forms that its configurations need.
struct Scenes {
  const scene::SceneData& plain;                            ///< without patches and cells: for the reference
  std::vector<const scene::SceneData*> ofConfigurations{};  ///< built as Configuration::build says
};

/// What an experiment consists of. Everything that is referred to must outlive the experiment.
struct ExperimentInputs {
  const Scenes& scenes;
  const asset::Camera& path;
  const std::vector<Configuration>& configurations;  ///< not empty
  const Plan& plan;
  std::filesystem::path folder;  ///< of the report; exists
  std::string fingerprint;       ///< experimentFingerprint() of all of the above
  bool resume = false;           ///< continue with the steps that the folder's log holds
};

/// Runs a plan step by step. Each finished step is written to the folder at once, so that an interrupted experiment can
/// be resumed at the step where it stopped.
class Experiment {
 public:
  /// Errors: kUsage if the folder is to be resumed and holds another experiment; kMalformed, kLimit, kWriteFailed.
  explicit Experiment(ExperimentInputs inputs);
  ~Experiment();
  Experiment(const Experiment&) = delete;
  Experiment& operator=(const Experiment&) = delete;

  std::size_t stepCount() const { return steps_.size(); }
  std::size_t stepsDone() const { return done_; }
  /// Description of the next step for a progress line; empty when all steps are done.
  std::string nextStep() const;
  /// Runs the next step. @pre stepsDone() < stepCount() (checked). Errors: kWriteFailed, as ReferenceFrames::image.
  void runStep();

  const Results& results() const { return results_; }

 private:
  enum class StepKind { kFrame, kObjects, kKeep, kSweep };
  struct Step {
    StepKind kind;
    std::uint32_t frame = 0;  ///< kObjects: known when the frames have been measured
    float tau = 1.0F;
    std::size_t configuration = 0;  ///< kObjects
  };
  void planSteps();
  void readFinishedSteps();
  std::vector<Sample> runFrame(std::uint32_t frame);
  /// What addErrors compares of one configuration.
  struct Shown {
    ImageRgba8 image;
    std::vector<std::uint8_t> covered;
  };
  void addErrors(std::vector<Sample>& samples, const std::vector<Shown>& shown);
  std::vector<ObjectsSample> runObjects(std::size_t configuration);
  std::vector<KeptSample> runKeep(std::uint32_t frame);
  KeptSample keep(std::size_t configuration, std::uint32_t frame, const std::vector<float>& motion);
  std::vector<SweepSample> runSweep(std::uint32_t frame, float tau);
  render::FrameRenderer& renderer(std::size_t configuration);
  void approach(render::FrameRenderer& renderer, const render::FrameOptions& options, std::uint32_t frame);
  void catchUp(std::uint32_t frame);
  Sample measure(std::size_t configuration, const render::FrameOptions& options, std::uint32_t frame);
  bool isContinuous() const { return inputs_.plan.range.step == 1; }

  ExperimentInputs inputs_;
  std::string referenceKey_;
  ReferenceFrames reference_;
  std::vector<Step> steps_;
  std::size_t done_ = 0;
  Results results_;
  std::vector<std::unique_ptr<render::FrameRenderer>> renderers_;  ///< [configurations]; null until first used
  // Of a path without gaps, where the history runs from frame to frame:
  std::optional<std::uint32_t> lastFrame_;          ///< the frame that the renderers rendered last
  std::vector<std::optional<FlipImage>> lastSeen_;  ///< [configurations], its pictures
};

}  // namespace jalousie::compare
