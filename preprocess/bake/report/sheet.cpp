// Draws pictures and tables of every chain and joins them into one page.
#include "bake/report/sheet.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "asset/image_io.h"
#include "bake/io/gltf_mesh.h"
#include "bake/io/lod_measures.h"
#include "bake/mesh/bounds.h"
#include "bake/mesh/clean.h"
#include "bake/mesh/triangle_bvh.h"
#include "bake/mesh/wedges.h"
#include "bake/report/inspect.h"
#include "bake/report/percent.h"
#include "bake/report/sheet_plot.h"
#include "bake/report/software_raster.h"
#include "bake/simplify/measure.h"

namespace jalousie::bake {
namespace {

constexpr const char* kStyle = R"(
body{font:15px/1.45 system-ui,sans-serif;color:#24282c;background:#f4f3f0;margin:0}
main{max-width:1120px;margin:0 auto;padding:28px 20px 60px}
h1{font-size:26px;margin:0 0 4px}h2{font-size:20px;margin:36px 0 6px;border-top:2px solid #d8d4cc;padding-top:22px}
p{margin:4px 0 12px;color:#5b6168}
.plot{background:#fff;border-radius:8px;padding:10px;max-width:680px;margin:12px 0 22px}
svg text{font:12px system-ui,sans-serif;fill:#5b6168}svg .grid{stroke:#e3e0da}
.row{display:grid;grid-template-columns:repeat(3,1fr);gap:12px;margin:0 0 6px}
.row>*{background:#fff;border-radius:8px;overflow:hidden;aspect-ratio:1;background-size:contain}
.row img{width:100%;display:block}
.cap{display:grid;grid-template-columns:repeat(3,1fr);gap:12px;margin:0 0 22px;font-size:13.5px;color:#5b6168}
.cap b{color:#24282c}.bar{height:9px;border-radius:4px;margin:3px 0 1px}
.ends{display:flex;justify-content:space-between}
)";

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '&')
      result += "&amp;";
    else if (c == '<')
      result += "&lt;";
    else if (c == '>')
      result += "&gt;";
    else if (c == '"')
      result += "&quot;";
    else if (c == '\'')
      result += "&#39;";
    else
      result += c;
  }
  return result;
}

std::string base64(const std::vector<std::byte>& bytes) {
  constexpr const char* kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k)
      group = group << 8U | (i + k < bytes.size() ? static_cast<std::uint32_t>(bytes[i + k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k)
      text += i + k > bytes.size() ? '=' : kDigits[group >> (18U - 6U * k) & 63U];
  }
  return text;
}

std::string dataUri(const ImageRgba8& image) {
  return "data:image/png;base64," + base64(asset::encodePng(image));
}

/// From dark violet through teal to yellow, monotone in lightness; linear RGB.
glm::dvec3 heat(double t) {
  constexpr std::array<glm::dvec3, 5> kStops = {glm::dvec3(0.058, 0.005, 0.092), glm::dvec3(0.045, 0.075, 0.26),
                                                glm::dvec3(0.013, 0.27, 0.27), glm::dvec3(0.14, 0.56, 0.12),
                                                glm::dvec3(0.98, 0.80, 0.02)};
  const double place = std::clamp(t, 0.0, 1.0) * (kStops.size() - 1);
  const std::size_t stop = std::min<std::size_t>(static_cast<std::size_t>(place), kStops.size() - 2);
  return glm::mix(kStops[stop], kStops[stop + 1], place - static_cast<double>(stop));
}

std::string heatBar() {
  std::string stops;
  for (int k = 0; k <= 8; ++k) {
    const glm::dvec3 c = heat(k / 8.0);
    const auto channel = [](double v) { return static_cast<int>(std::lround(255.0 * std::pow(v, 1.0 / 2.2))); };
    stops += fmt::format(",rgb({},{},{})", channel(c.r), channel(c.g), channel(c.b));
  }
  return fmt::format("<div class='bar' style='background:linear-gradient(90deg{})'></div>", stops);
}

WedgeMesh readLevel(const tinygltf::Model& model, int mesh, const asset::Limits& limits) {
  const tinygltf::Mesh& source = model.meshes[static_cast<std::size_t>(mesh)];
  if (!unbakeableReason(model, source).empty()) return {};
  CombinedMesh combined = readCombinedMesh(model, source, limits);
  cleanMesh(combined);
  return makeWedges(combined);
}

ImageRgba8 shadedPicture(const WedgeMesh& mesh, const RasterView& view) {
  return resolve(rasterise(mesh, view), view, [&](const RasterSample& sample) {
    return litBy(view, sample.normal, {0.62, 0.56, 0.5});
  });
}

ImageRgba8 heatPicture(const WedgeMesh& mesh, const RasterView& view, const TriangleBvh& original, double scale,
                       const SliceRunner& slices) {
  const std::vector<RasterSample> samples = rasterise(mesh, view);
  std::vector<float> distances(samples.size(), 0.0F);
  slices(samples.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i)
      if (samples[i].triangle != ~0U) distances[i] = static_cast<float>(original.distance(samples[i].position));
  });
  const double perUnit = scale > 0.0 ? 1.0 / scale : 0.0;
  return resolve(samples, view, [&](const RasterSample& sample) {
    const auto i = static_cast<std::size_t>(&sample - samples.data());
    const double light = 0.55 + 0.45 * litBy(view, sample.normal, glm::dvec3(1.0)).x;
    return heat(distances[i] * perUnit) * light;
  });
}

/// The section of the page for one chain.
class ChainSection {
 public:
  ChainSection(const tinygltf::Model& model, const InspectedChain& chain, const SheetOptions& options,
               std::size_t number)
      : model_(model),
        chain_(chain),
        options_(options),
        number_(number),
        original_(readLevel(model, chain.levels[0].mesh, options.limits)) {}

  std::string html() {
    std::string text = fmt::format("<h2>{}</h2>", escaped(chain_.name));
    if (original_.corners.empty()) return text + "<p>Not a mesh of triangles that can be shown.</p>";
    diagonal_ = boundsOf(original_.positions).diagonal();
    fitView(original_, view_);
    view_.side = options_.side;
    const DeviationMeter meter(original_, {20000, 20000, options_.slices});
    const TriangleBvh bvh(original_.positions, vertexIndices(original_));
    std::string rows;
    std::vector<PlotPoint> points;
    for (std::size_t k = 1; k < chain_.levels.size(); ++k) {
      const WedgeMesh level = readLevel(model_, chain_.levels[k].mesh, options_.limits);
      if (level.corners.empty()) continue;
      const asset::LodMeasures measures = measuresOf(k, level, meter);
      points.push_back({static_cast<double>(chain_.levels[k].triangles), percent(measures.twoSided.max),
                        percent(measures.twoSided.mean)});
      rows += row(k, level, bvh, measures);
    }
    text += fmt::format(
        "<p>{} levels, {} triangles in the finest, shown by {} node{}. Distances in % of the diagonal "
        "({:.4g} units).{}</p>",
        chain_.levels.size(), chain_.levels[0].triangles, chain_.nodes, chain_.nodes == 1 ? "" : "s", diagonal_,
        stopText());
    const std::string plot = errorPlot(points);
    if (!plot.empty()) text += "<div class='plot'>" + plot + "</div>";
    text += fmt::format("<style>.o{}{{background-image:url({})}}</style>", number_,
                        dataUri(shadedPicture(original_, view_)));
    return text + rows;
  }

 private:
  double percent(double length) const { return percentOf(diagonal_, length); }

  std::string stopText() const {
    const auto& info = chain_.levels.back().info;
    return info && info->measures && !info->measures->stop.empty()
               ? " Last level: " + escaped(info->measures->stop) + "."
               : "";
  }

  asset::LodMeasures measuresOf(std::size_t k, const WedgeMesh& level, const DeviationMeter& meter) const {
    const auto& info = chain_.levels[k].info;
    if (info && info->measures) return *info->measures;
    WedgeMesh foreign = level;  // its wedges have no counterparts in the original
    std::fill(foreign.sourceWedge.begin(), foreign.sourceWedge.end(), ~0U);
    const Deviation deviation = meter.measure(foreign);
    return lodMeasures(deviation);
  }

  std::string row(std::size_t k, const WedgeMesh& level, const TriangleBvh& bvh,
                  const asset::LodMeasures& measures) const {
    // The scale ends at five times the mean: with the maximum, almost the whole picture would be dark.
    const double scale = 5.0 * measures.toOriginal.mean;
    const double share = 100.0 * static_cast<double>(chain_.levels[k].triangles) /
                         static_cast<double>(std::max<std::uint64_t>(chain_.levels[0].triangles, 1));
    std::string text = fmt::format(
        "<div class='row'><div class='o{}'></div><div><img alt='LOD {} shaded' src='{}'></div>"
        "<div><img alt='LOD {} distance to the original' src='{}'></div></div>",
        number_, k, dataUri(shadedPicture(level, view_)), k,
        dataUri(heatPicture(level, view_, bvh, scale, options_.slices)));
    text += fmt::format(
        "<div class='cap'><div>original, {} triangles</div>"
        "<div><b>LOD {}: {} triangles</b>, {:.3g} %<br>distance mean {:.3g} %, max {:.3g} %<br>"
        "normals mean {:.3g}°, 95th percentile {:.3g}°</div>"
        "<div>distance to the original{}<div class='ends'><span>0</span><span>{:.3g} % and "
        "more</span></div></div></div>",
        chain_.levels[0].triangles, k, chain_.levels[k].triangles, share, percent(measures.twoSided.mean),
        percent(measures.twoSided.max), measures.normalDegrees.mean, measures.normalDegrees.p95, heatBar(),
        percent(scale));
    return text;
  }

  const tinygltf::Model& model_;
  const InspectedChain& chain_;
  const SheetOptions& options_;
  std::size_t number_;
  WedgeMesh original_;
  RasterView view_;
  double diagonal_ = 0.0;
};

}  // namespace

std::string sheetHtml(const tinygltf::Model& model, const SheetOptions& options) {
  std::vector<InspectedChain> chains = inspectModel(model);
  std::erase_if(chains, [](const InspectedChain& chain) { return chain.levels.size() < 2; });
  std::stable_sort(chains.begin(), chains.end(), [](const InspectedChain& a, const InspectedChain& b) {
    return a.levels[0].triangles > b.levels[0].triangles;
  });
  const std::size_t shown = std::min(chains.size(), options.maxChains);
  std::string page = fmt::format(
      "<!doctype html><html lang='en'><head><meta charset='utf-8'>"
      "<meta name='viewport' content='width=device-width'><title>{0}</title><style>{1}</style>"
      "</head><body><main><h1>{0}</h1><p>{2} chain{3} of levels of detail",
      escaped(options.title), kStyle, chains.size(), chains.size() == 1 ? "" : "s");
  if (shown < chains.size())
    page += fmt::format("; the {} with most triangles are shown, {} are left out", shown, chains.size() - shown);
  page += ".</p>";
  for (std::size_t i = 0; i < shown; ++i)
    page += ChainSection(model, chains[i], options, i).html();
  return page + "</main></body></html>\n";
}

}  // namespace jalousie::bake
