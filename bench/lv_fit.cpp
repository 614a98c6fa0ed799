// Fits the constants of the rule `price`: sweeps over tau for every variant, against levels by pixel error.
//
// The price of a triangle is kTrianglePrice * tau^2, so a sweep over tau at one constant visits all constants: at equal
// error the triangles do not depend on it. What it fixes is the error at a tau of one pixel.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <vector>

#include "core/error.h"
#include "gl/shader_source.h"
#include "gl_bench.h"
#include "lv_setup.h"
#include "lv_sweep.h"

namespace jalousie::bench {
namespace {

constexpr std::uint32_t kWidth = 640;
constexpr std::uint32_t kHeight = 360;
constexpr float kPriceTaus[] = {16.0F, 8.0F, 4.0F, 2.8F, 2.0F, 1.4F, 1.0F, 0.7F, 0.5F, 0.25F, 0.125F, 0.0625F};
constexpr float kNoCap = 1e6F;

/// One row of the grid.
struct Variant {
  bool mean;       ///< mean errors, else the largest ones
  float cap;       ///< kErrorCap, pixels
  float maxError;  ///< FrameOptions::maxError; 0: none

  std::string name() const {
    std::string text = mean ? "mean" : "largest";
    text += cap < kNoCap ? fmt::format(", cap {:g}", cap) : ", no cap";
    return text + (maxError > 0.0F ? fmt::format(", --max-error {:g}", maxError) : "");
  }
};
constexpr Variant kVariants[] = {{true, 1, 0},       {true, 2, 0},  {true, 8, 0}, {true, kNoCap, 0}, {false, 8, 0},
                                 {false, kNoCap, 0}, {true, 2, 16}, {true, 2, 8}, {true, 2, 4}};

/// A folder of its own, removed at the end.
class Folder {
 public:
  Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "lv_bench-XXXXXX").string();
    if (::mkdtemp(name.data()) == nullptr) throw Error(ErrorCode::kWriteFailed, "cannot make a folder", name);
    path_ = name;
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// Writes one shader file with a changed text into a folder.
void replaceIn(const std::filesystem::path& folder, const char* file, const std::string& before,
               const std::string& after) {
  std::string text = gl::ShaderLibrary().text(file);
  const std::size_t at = text.find(before);
  require(at != std::string::npos, fmt::format("{} does not contain \"{}\"", file, before));
  text.replace(at, before.size(), after);
  std::filesystem::create_directories((folder / file).parent_path());
  std::ofstream(folder / file) << text;
}

/// The shaders of a variant. @param folder  gets the changed files
gl::ShaderLibrary shadersOf(const Variant& variant, const std::filesystem::path& folder) {
  replaceIn(folder, "shared/limits.h", fmt::format("const float kErrorCap = {:.1f};", gpu::kErrorCap),
            fmt::format("const float kErrorCap = {:.1f};", variant.cap));
  return gl::ShaderLibrary(folder);
}

/// The scene with the largest errors in place of the mean ones.
scene::SceneData withLargestErrors(scene::SceneData scene) {
  for (gpu::Lod& lod : scene.lods)
    lod.meanErrorObject = lod.errorObject;
  return scene;
}

/// kTrianglePrice at which a sweep has, at a tau of one pixel, a given PSNR; NaN outside its range.
double priceAt(const std::vector<Sample>& samples, double psnr) {
  for (std::size_t i = 1; i < samples.size(); ++i) {
    const Sample& a = samples[i - 1];
    const Sample& b = samples[i];
    if (psnr < a.psnr || psnr > b.psnr || std::isinf(b.psnr)) continue;
    const double t = (psnr - a.psnr) / std::max(b.psnr - a.psnr, 1e-9);
    const double tau = kPriceTaus[i - 1] * std::pow(kPriceTaus[i] / kPriceTaus[i - 1], t);
    return static_cast<double>(gpu::kTrianglePrice) * tau * tau;
  }
  return std::nan("");
}

/// The sweep of one variant.
std::vector<Sample> sweepOf(const LvView& view, const scene::SceneData& largest, const Variant& variant,
                            const Reference& reference) {
  const Folder folder;
  const gl::ShaderLibrary shaders = shadersOf(variant, folder.path());
  render::FrameRenderer renderer(variant.mean ? view.scene : largest, kWidth, kHeight, {.shaders = &shaders});
  Stage stage{renderer, view.camera(), reference};
  render::FrameOptions options = optionsOf(kDefault, 1.0F);
  options.maxError = variant.maxError;
  return stage.sweep(options, kPriceTaus, kDefault.name);
}

/// The sweeps of one view, against which its variants are measured.
struct ViewFit {
  const LvView& view;
  std::vector<Sample> uniform;
  nlohmann::ordered_json& figures;

  /// @param price  kTrianglePrice at which a tau of one pixel has the PSNR of `uniform` there; NaN if there is none
  void addRow(const std::string& variant, const std::vector<Sample>& samples, double price) const {
    figures.push_back({{"scene", view.sceneName},
                       {"view", view.text},
                       {"variant", variant},
                       {"triangles_at_equal_psnr", orNull(ratioAtEqualError(samples, uniform, uniform))},
                       {"triangles_at_equal_ssim", orNull(ratioAtEqualError(samples, uniform, uniform, kSsim))},
                       {"price_at_equal_psnr", orNull(price)}});
    const nlohmann::ordered_json& row = figures.back();
    std::fprintf(stderr, "%s\n", row.dump().c_str());
  }
};

}  // namespace

void measureFit(const LvView& view, nlohmann::ordered_json& figures) {
  ViewFit fit{view, {}, figures};
  Reference reference;
  {
    render::FrameRenderer renderer(view.scene, kWidth, kHeight);
    Stage stage{renderer, view.camera(), {}};
    reference.image = settledImage(renderer, finestOptions(/*twoPhases=*/false), stage.camera);
    stage.reference = reference;
    fit.uniform = stage.sweep(optionsOf(kUniform, 1.0F), kTaus, kUniform.name);
    fit.addRow(kRelaxed.name, stage.sweep(optionsOf(kRelaxed, 1.0F), kTaus, kRelaxed.name), std::nan(""));
  }
  const scene::SceneData largest = withLargestErrors(view.scene);
  for (const Variant& variant : kVariants) {
    const std::vector<Sample> samples = sweepOf(view, largest, variant, reference);
    fit.addRow(variant.name(), samples, priceAt(samples, fit.uniform[kOnePixel].psnr));
  }
}

void printFit(const nlohmann::ordered_json& figures) {
  constexpr const char* kKeys[] = {"triangles_at_equal_psnr", "triangles_at_equal_ssim", "price_at_equal_psnr"};
  std::vector<std::string> variants;
  std::map<std::string, std::vector<std::string>> perView;
  std::map<std::string, std::map<std::string, std::vector<double>>> values;
  std::string head;
  for (const nlohmann::ordered_json& row : figures) {
    const std::string variant = row["variant"];
    if (!perView.contains(variant)) variants.push_back(variant);
    if (variant == variants.front())
      head += fmt::format(" {} {} |", std::filesystem::path(row["scene"].get<std::string>()).stem().string(),
                          row["view"].get<std::string>());
    const auto text = [&](const char* key) {
      return row[key].is_null() ? std::string("-") : fmt::format("{:.2f}", row[key].get<double>());
    };
    perView[variant].push_back(text(kKeys[0]) + ", " + text(kKeys[1]));
    for (const char* key : kKeys)
      if (!row[key].is_null()) values[variant][key].push_back(row[key].get<double>());
  }
  fmt::print(
      "Triangles over hiz + pixel-error at equal PSNR, at equal SSIM\n| error |{} PSNR, mean | SSIM, mean | "
      "price at the PSNR of one pixel |\n|---|",
      head);
  for (std::size_t i = 0; i < perView[variants.front()].size() + 3; ++i)
    fmt::print("---|");
  for (const std::string& variant : variants) {
    fmt::print("\n| {} | {} |", variant, fmt::join(perView[variant], " | "));
    for (const char* key : kKeys) {
      const std::vector<double>& all = values[variant][key];
      fmt::print(" {} |", all.empty() ? "-" : fmt::format("{:.3f}", geometricMean(all)));
    }
  }
  fmt::print("\n");
}

}  // namespace jalousie::bench
