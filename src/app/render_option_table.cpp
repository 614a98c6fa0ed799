// One row per option of `jalousie render`, and what other code reads from a row.
#include "app/render_option_table.h"

#include <fmt/format.h>

#include <charconv>

#include <CLI/CLI.hpp>
#include <string_view>

#include "cli/option_checks.h"
#include "core/check.h"
#include "core/overloaded.h"
#include "policy/table.h"

namespace jalousie::app {
namespace {

using Options = RenderOptions;

/// A bound that says nothing to people.
constexpr double kEndless = 1e6;

std::string modesWith(bool CullModeRow::*property) {
  return "--mode " + policy::namesWith(cullModeTable(), property);
}
/// RenderOption::applies: the mode has a property.
template <bool CullModeRow::*kProperty>
bool modeHas(const Options& o) {
  return rowOf(o.frameOptions.cullMode).*kProperty;
}
bool followsError(const Options& o) {
  return rowOf(o.frameOptions.lodRule).followsError;
}
bool isCalm(const Options& o) {
  return followsError(o) && o.frameOptions.calm;
}

/// The policy with the measure that applies.
FramePolicy policyOf(const Options& o) {
  FramePolicy policy = o.frameOptions;
  policy.lvMeasure = o.lv.value_or(defaultMeasure(policy));
  return policy;
}

/// Whether masking would change anything if it were chosen.
bool canMask(const Options& o) {
  FramePolicy policy = policyOf(o);
  policy.masking = true;
  return masksErrors(policy);
}

std::string rulesWithError() {
  return "--lod " + policy::namesWith(lodRuleTable(), &LodRuleRow::followsError);
}

/// " [RULE: MEASURE, ...]": the measure that each level rule takes where none is chosen.
std::string defaultMeasures() {
  std::string text;
  for (const LodRuleRow& rule : lodRuleTable())
    if (rule.followsLv && rule.measure != LvMeasure::kPixels)
      text += fmt::format("{}{}: {}", text.empty() ? " [" : ", ", rule.name, rowOf(rule.measure).name);
  return text + ", otherwise: pixels]";
}

/// The default depends on the mode.
std::string occluderTauHelp() {
  std::string defaults;
  for (const CullModeRow& row : cullModeTable())
    if (row.usesMap) defaults += fmt::format("{}{}: {:g}", defaults.empty() ? "" : ", ", row.name, row.occluderTau);
  return fmt::format("Limit the screen-space error of the levels drawn into the occlusion map [{}]", defaults);
}

/// A choice among the rows of a table. @param kOf  lends the value
template <class Id, std::span<const typename std::remove_cvref_t<decltype(rowOf(Id{}))>> (*kTable)(),
          Id& (*kOf)(Options&)>
ChoiceValue choice() {
  return {[](const Options& o) {
            Options copy = o;
            return std::string(rowOf(kOf(copy)).name);
          },
          [](Options& o, std::string_view name) { kOf(o) = policy::idOf(kTable(), name); }, policy::namesOf(kTable())};
}

CullMode& cullModeOf(Options& o) {
  return o.frameOptions.cullMode;
}
LodRule& lodRuleOf(Options& o) {
  return o.frameOptions.lodRule;
}
Detail& detailOf(Options& o) {
  return o.frameOptions.detail;
}
View& viewOf(Options& o) {
  return o.frameOptions.view;
}

/// The measure of LV may be absent.
ChoiceValue measureChoice() {
  return {[](const Options& o) { return o.lv ? std::string(rowOf(*o.lv).name) : std::string(); },
          [](Options& o, std::string_view name) {
            o.lv = name.empty() ? std::optional<LvMeasure>() : policy::idOf(lvMeasureTable(), name);
          },
          policy::namesOf(lvMeasureTable())};
}

constexpr std::string_view kPerObject = "per-object";

ChoiceValue submissionChoice() {
  using visibility::Submission;
  return {[](const Options& o) {
            return std::string(o.rendererOptions.submission == Submission::kPerObject ? kPerObject : "instanced");
          },
          [](Options& o, std::string_view name) {
            o.rendererOptions.submission = name == kPerObject ? Submission::kPerObject : Submission::kInstanced;
          },
          {"instanced", std::string(kPerObject)}};
}

constexpr std::string_view kAutomaticCells = "auto";
constexpr std::string_view kNoCells = "off";

std::string cellsText(const Options& o) {
  switch (o.cells.kind) {
    case scene::CellOptions::Kind::kAutomatic:
      return std::string(kAutomaticCells);
    case scene::CellOptions::Kind::kOff:
      return std::string(kNoCells);
    case scene::CellOptions::Kind::kCount:
      break;
  }
  return std::to_string(o.cells.trianglesPerCell);
}

void setCells(Options& o, std::string_view name) {
  using Kind = scene::CellOptions::Kind;
  o.cells = {name == kAutomaticCells ? Kind::kAutomatic : name == kNoCells ? Kind::kOff : Kind::kCount};
  if (o.cells.kind == Kind::kCount) std::from_chars(name.data(), name.data() + name.size(), o.cells.trianglesPerCell);
}

std::vector<RenderOption> cullingRows() {
  return {
      {"--mode", "mode", "", "Choose the culling mode. " + policy::helpOf(cullModeTable()), OptionGroup::kCulling,
       choice<CullMode, cullModeTable, cullModeOf>()},
      {"--min-pixels", "smallest rectangle", "pixels of area",
       "Cull objects whose bounding rectangle covers fewer pixels (contribution culling); 0 turns this off",
       OptionGroup::kCulling, NumberValue{[](Options& o) -> float& { return o.frameOptions.minPixels; }, 0.0F, 1e6F},
       modesWith(&CullModeRow::culls), modeHas<&CullModeRow::culls>},
      {"--min-sphere-pixels", "smallest sphere", "pixels of area",
       "Cull objects whose bounding sphere covers fewer pixels (detail culling): unlike the rectangle's, its area does "
       "not change while an object turns or leaves the picture; 0 turns this off",
       OptionGroup::kCulling,
       NumberValue{[](Options& o) -> float& { return o.frameOptions.minSpherePixels; }, 0.0F, 1e6F},
       modesWith(&CullModeRow::culls), modeHas<&CullModeRow::culls>},
      {"--cells", "cells", "",
       "Divide large objects into cells of at most so many triangles, which are culled one by one; the image is the "
       "same, but for --triangles, a full list (--capacity), a frozen camera and views that show cells. auto = the "
       "cells of the file, else cells of 256 triangles for large objects; auto joins them where a scene had more than "
       "65,536. Surfaces that lie in one plane can swap pixels",
       OptionGroup::kCulling, ChoiceValue{cellsText, setCells, {"auto", "off", "64", "128", "256", "512", "1024"}},
       "--detail discrete",
       [](const Options& o) {
         return !rowOf(o.frameOptions.detail).patches || o.cells.kind == scene::CellOptions::Kind::kOff;
       }},
      {"--importance", "importance mask", "",
       "Scale --tau and --min-pixels by a grey image stretched over the screen: white keeps them, darker grey divides "
       "them by its value, at least 1/16",
       OptionGroup::kCulling, FileValue{[](Options& o) -> std::filesystem::path& { return o.importance; }, "MASK.png"}},
      {"--occluder-distance", "occluder distance", "world units",
       "Draw objects nearer than this into the occlusion map [distance to the scene + 12 % of its diagonal]",
       OptionGroup::kCulling,
       MaybeNumberValue{[](Options& o) -> std::optional<float>& { return o.frameOptions.occluderDistance; }, 0.0F,
                        1e30F},
       modesWith(&CullModeRow::usesMap), modeHas<&CullModeRow::usesMap>},
      {"--occluder-tau", "occluder error", "pixels", occluderTauHelp(), OptionGroup::kCulling,
       MaybeNumberValue{[](Options& o) -> std::optional<float>& { return o.frameOptions.occluderTau; }, 0.0F, 1000.0F},
       modesWith(&CullModeRow::usesMap), modeHas<&CullModeRow::usesMap>},
      {"--cull-threshold", "cull threshold", "opacity",
       "Treat texels of the map as occluding from this opacity on; below 1 visible pixels can be lost",
       OptionGroup::kCulling,
       NumberValue{[](Options& o) -> float& { return o.frameOptions.cullThreshold; }, 0.01F, 1.0F},
       modesWith(&CullModeRow::usesMap), modeHas<&CullModeRow::usesMap>},
  };
}

FaceCulling& faceCullingOf(Options& o) {
  return o.frameOptions.faceCulling;
}

/// Options of what is culled inside objects.
std::vector<RenderOption> faceRows() {
  return {
      {"--backface", "back faces", "",
       "Leave out groups of triangles that all face away before they are drawn; the image is the same, but for a "
       "frozen camera. Files baked with --backface have small groups, others one for each cell. " +
           policy::helpOf(faceCullingTable()),
       OptionGroup::kCulling, choice<FaceCulling, faceCullingTable, faceCullingOf>(), "--detail discrete",
       [](const Options& o) { return !rowOf(o.frameOptions.detail).patches; }},
  };
}

/// Begins the help of an option that belongs to some modes.
std::string onlyWith(bool CullModeRow::*property) {
  return "With " + modesWith(property) + ": ";
}

ChoiceValue multiqueryChoice() {
  using culling::Multiquery;
  return {[](const Options& o) {
            const Multiquery kind = o.frameOptions.queries.multiquery;
            return std::string(kind == Multiquery::kOff ? "off" : kind == Multiquery::kNodes ? "nodes" : "objects");
          },
          [](Options& o, std::string_view name) {
            o.frameOptions.queries.multiquery = name == "off"     ? Multiquery::kOff
                                                : name == "nodes" ? Multiquery::kNodes
                                                                  : Multiquery::kObjects;
          },
          {"off", "nodes", "objects"}};
}

ChoiceValue unitsChoice() {
  return {[](const Options& o) { return std::string(o.frameOptions.queries.unitsTogether ? "together" : "single"); },
          [](Options& o, std::string_view name) { o.frameOptions.queries.unitsTogether = name == "together"; },
          {"together", "single"}};
}

/// Options of the modes that ask occlusion queries (docs/occlusion_queries.md).
std::vector<RenderOption> queryRows() {
  return {
      {"--query-threshold", "query threshold", "samples",
       onlyWith(&CullModeRow::countsSamples) +
           "take a node for hidden if at most so many samples of its box are visible; above 0 visible pixels can be "
           "lost",
       OptionGroup::kCulling,
       CountValue{[](Options& o) -> std::uint32_t& { return o.frameOptions.queries.threshold; }, 0, 0x7fffffffU},
       modesWith(&CullModeRow::countsSamples), modeHas<&CullModeRow::countsSamples>},
      {"--query-importance", "importance of samples", "share of white",
       "With --importance, count only the samples of a query where the mask is at least this bright: what shows only "
       "elsewhere is not drawn",
       OptionGroup::kCulling,
       NumberValue{[](Options& o) -> float& { return o.frameOptions.queries.importance; }, 0.0F, 1.0F},
       "--importance and " + modesWith(&CullModeRow::asksQueries),
       [](const Options& o) { return !o.importance.empty() && modeHas<&CullModeRow::asksQueries>(o); }},
      {"--query-batch", "query batch", "queries",
       onlyWith(&CullModeRow::batchesQueries) + "send so many occlusion queries before an answer is waited for",
       OptionGroup::kCulling,
       CountValue{[](Options& o) -> std::uint32_t& { return o.frameOptions.queries.batch; }, 1, 1000},
       modesWith(&CullModeRow::batchesQueries), modeHas<&CullModeRow::batchesQueries>},
  };
}

std::vector<RenderOption> queryOrderRows() {
  return {
      {"--multiquery", "queries for several nodes", "",
       onlyWith(&CullModeRow::joinsQueries) +
           "let nodes that were hidden ask together. nodes = while more nodes are saved than queries are risked; "
           "objects = "
           "the same with the objects below the nodes; off = one query a node",
       OptionGroup::kCulling, multiqueryChoice(), modesWith(&CullModeRow::joinsQueries),
       modeHas<&CullModeRow::joinsQueries>},
      {"--tight-bounds", "tight bounds", "times the surface",
       onlyWith(&CullModeRow::joinsQueries) +
           "ask with the boxes of a node's descendants, up to three levels below it, while their surface is at "
           "most so "
           "many "
           "times its own; 0 = with its own box",
       OptionGroup::kCulling,
       NumberValue{[](Options& o) -> float& { return o.frameOptions.queries.tightBounds; }, 0.0F, 100.0F},
       modesWith(&CullModeRow::joinsQueries), modeHas<&CullModeRow::joinsQueries>},
      {"--requery", "query interval", "frames",
       onlyWith(&CullModeRow::joinsQueries) +
           "take a visible leaf for visible for so many frames before it asks again; 0 = it asks in every frame",
       OptionGroup::kCulling,
       CountValue{[](Options& o) -> std::uint32_t& { return o.frameOptions.queries.requery; }, 0, 1000},
       modesWith(&CullModeRow::joinsQueries), modeHas<&CullModeRow::joinsQueries>},
      {"--query-units", "query units", "",
       onlyWith(&CullModeRow::asksUnits) +
           "together = grid nodes that cannot hide each other ask together; single = one after the other",
       OptionGroup::kCulling, unitsChoice(), modesWith(&CullModeRow::asksUnits), modeHas<&CullModeRow::asksUnits>},
      {"--plane-depth", "depth of plane tests", "levels of the grid",
       onlyWith(&CullModeRow::asksUnits) +
           "test nodes down to this depth against the planes of the view; deeper ones by their query alone",
       OptionGroup::kCulling,
       CountValue{[](Options& o) -> std::uint32_t& { return o.frameOptions.queries.planeDepth; }, 0, 16},
       modesWith(&CullModeRow::asksUnits), modeHas<&CullModeRow::asksUnits>},
  };
}

ChoiceValue capChoice() {
  using culling::Cap;
  return {[](const Options& o) { return std::string(o.frameOptions.occluders.cap == Cap::kPaper ? "paper" : "exact"); },
          [](Options& o, std::string_view name) {
            o.frameOptions.occluders.cap = name == "paper" ? Cap::kPaper : Cap::kExact;
          },
          {"exact", "paper"}};
}

ChoiceValue rankChoice() {
  using culling::Rank;
  return {[](const Options& o) {
            return std::string(o.frameOptions.occluders.rank == Rank::kPaper ? "paper" : "solid-angle");
          },
          [](Options& o, std::string_view name) {
            o.frameOptions.occluders.rank = name == "paper" ? Rank::kPaper : Rank::kSolidAngle;
          },
          {"solid-angle", "paper"}};
}

/// Options of the modes that cast shadows (docs/object_space_occlusion.md). None changes the picture.
std::vector<RenderOption> occluderRows() {
  return {
      {"--active", "active occluders", "occluders",
       onlyWith(&CullModeRow::castsShadows) +
           "test objects against so many occluders, those that cover most of the view",
       OptionGroup::kCulling,
       CountValue{[](Options& o) -> std::uint32_t& { return o.frameOptions.occluders.active; }, 0,
                  culling::kMostActive},
       modesWith(&CullModeRow::castsShadows), modeHas<&CullModeRow::castsShadows>},
      {"--rank-every", "ranking interval", "frames",
       onlyWith(&CullModeRow::castsShadows) + "choose the occluders anew after so many frames", OptionGroup::kCulling,
       CountValue{[](Options& o) -> std::uint32_t& { return o.frameOptions.occluders.rankEvery; }, 1, 1000},
       modesWith(&CullModeRow::castsShadows), modeHas<&CullModeRow::castsShadows>},
      {"--rank", "ranking", "",
       onlyWith(&CullModeRow::castsShadows) +
           "choose occluders by the solid angle that they cover, or by the published formulas, which depend on the "
           "unit of length",
       OptionGroup::kCulling, rankChoice(), modesWith(&CullModeRow::castsShadows), modeHas<&CullModeRow::castsShadows>},
      {"--cap", "cap of a shadow", "",
       onlyWith(&CullModeRow::castsShadows) +
           "begin the shadow of a solid at its front faces, or at the published plane behind its silhouette, which "
           "hides less",
       OptionGroup::kCulling, capChoice(), modesWith(&CullModeRow::castsShadows), modeHas<&CullModeRow::castsShadows>},
  };
}

ChoiceValue portalReachChoice() {
  using culling::PortalReach;
  return {[](const Options& o) {
            return std::string(o.frameOptions.occluders.portalReach == PortalReach::kAll ? "all" : "neighbours");
          },
          [](Options& o, std::string_view name) {
            o.frameOptions.occluders.portalReach = name == "all" ? PortalReach::kAll : PortalReach::kNeighbours;
          },
          {"all", "neighbours"}};
}

/// Of the mode that sees rooms (docs/cells_and_portals.md).
std::vector<RenderOption> portalRows() {
  return {
      {"--portal-reach", "reach of portals", "",
       onlyWith(&CullModeRow::seesRooms) +
           "all = see every room behind a row of portals; neighbours = see the next rooms alone, as printed in "
           "lectures, which loses what is seen through two portals",
       OptionGroup::kCulling, portalReachChoice(), modesWith(&CullModeRow::seesRooms),
       modeHas<&CullModeRow::seesRooms>},
  };
}

std::vector<RenderOption> levelRows() {
  return {
      {"--lod", "level rule", "", "Choose the rule for levels. " + policy::helpOf(lodRuleTable()), OptionGroup::kDetail,
       choice<LodRule, lodRuleTable, lodRuleOf>()},
      {"--tau", "error budget", "pixels",
       "Allow this screen-space error. With --lod price it is a scale of quality: the price of a triangle grows with "
       "its square. With --lod coverage an object counts as so many times smaller",
       OptionGroup::kDetail, NumberValue{[](Options& o) -> float& { return o.frameOptions.tau; }, 0.0F, 1000.0F},
       rulesWithError(), followsError},
      {"--lv", "visibility measure", "",
       "Choose the measure of LV (level of visibility). " + policy::helpOf(lvMeasureTable()) + defaultMeasures(),
       OptionGroup::kDetail, measureChoice(),
       "--lod " + policy::namesWith(lodRuleTable(), &LodRuleRow::followsLv) + ", or --view " +
           policy::namesWith(viewTable(), &ViewRow::showsLv),
       [](const Options& o) { return wantsLv(o.frameOptions) || o.lv == LvMeasure::kNone; }},
      {"--relax", "relaxation", "times tau",
       "Limit how far --lod lv-error relaxes tau: tau grows with (visible share)^(-1/4), at most to 1 + RELAX times",
       OptionGroup::kDetail, NumberValue{[](Options& o) -> float& { return o.frameOptions.relax; }, 0.0F, 1000.0F},
       "--lod lv-error", [](const Options& o) { return relaxesTau(rowOf(o.frameOptions.lodRule)); }},
      {"--triangles", "triangle budget", "triangles",
       "Move the price of a triangle from frame to frame so that a frame has this many triangles, as far as the levels "
       "allow. A view at rest needs 10 to 60 frames (--settle), and rests below the budget where the levels of one "
       "object are a large step. In a frame that would have 1.08 times as many, objects become coarser at once, also "
       "beyond --max-error; only what appears after a part of the frame was drawn can exceed this. "
       "0 turns this off and leaves the price to --tau",
       OptionGroup::kDetail,
       CountValue{[](Options& o) -> std::uint32_t& { return o.frameOptions.triangleBudget; }, 0, 0xffffffffU},
       "--lod " + policy::namesWith(lodRuleTable(), &LodRuleRow::pricesTriangles),
       [](const Options& o) { return rowOf(o.frameOptions.lodRule).pricesTriangles; }},
      {"--max-error", "largest deviation", "pixels",
       "Draw no level whose largest deviation is more than this, although its mean error is small. Objects of which no "
       "pixel was visible have no limit, unless --calm is given; 0 turns the limit off",
       OptionGroup::kDetail, NumberValue{[](Options& o) -> float& { return o.frameOptions.maxError; }, 0.0F, 1000.0F},
       "--lod " + policy::namesWith(lodRuleTable(), &LodRuleRow::pricesTriangles),
       [](const Options& o) { return rowOf(o.frameOptions.lodRule).pricesTriangles; }},
      {"--masking", "masking", "",
       "Let the error of a partly covered object count (64 / d)^0.3 times less, at most 3.48 times; d is the mean open "
       "chord in front of it in pixels. Off by default: SSIM and Butteraugli tolerate more error behind small holes "
       "than behind a window, but mostly less than this factor; FLIP tolerates less",
       OptionGroup::kDetail, FlagValue{[](Options& o) -> bool& { return o.frameOptions.masking; }},
       rulesWithError() + ", with --mode " + policy::namesWith(cullModeTable(), &CullModeRow::testsOcclusion) +
           " and without --lv " + policy::namesWith(lvMeasureTable(), &LvMeasureRow::measuresHoles),
       canMask},
  };
}

std::vector<RenderOption> calmRows() {
  return {
      {"--calm", "temporal stability", "",
       "Make levels temporally stable for a moving camera: hysteresis, one level at a time, cross-fades. Without it a "
       "level depends on the present view alone",
       OptionGroup::kDetail, FlagValue{[](Options& o) -> bool& { return o.frameOptions.calm; }}, rulesWithError(),
       followsError},
      {"--hysteresis", "hysteresis", "times tau",
       "With --calm, keep the current level while it is allowed at both tau * H and tau / H; 1 turns hysteresis off",
       OptionGroup::kDetail, NumberValue{[](Options& o) -> float& { return o.frameOptions.hysteresis; }, 1.0F, 16.0F},
       "--calm", isCalm},
      {"--fade", "cross-fade", "frames", "With --calm, cross-fade a LOD switch over so many frames; 0 switches at once",
       OptionGroup::kDetail,
       CountValue{[](Options& o) -> std::uint32_t& { return o.frameOptions.fadeFrames; }, 0, gpu::kMaxFadeFrames},
       "--calm", isCalm},
  };
}

std::vector<RenderOption> detailRows() {
  return {
      {"--detail", "detail path", "", "Choose how detail is drawn. " + policy::helpOf(detailTable()),
       OptionGroup::kDetail, choice<Detail, detailTable, detailOf>()},
      {"--max-tessellation", "finest patches", "segments per edge", "Limit the tessellation level",
       OptionGroup::kDetail,
       CountValue{[](Options& o) -> std::uint32_t& { return o.frameOptions.maxTessellation; }, 1,
                  gpu::kMaxTessellationLevel},
       "--detail " + policy::namesWith(detailTable(), &DetailRow::patches),
       [](const Options& o) { return rowOf(o.frameOptions.detail).patches; }},
  };
}

std::vector<RenderOption> drawingRows() {
  return {
      {"--draws", "draw commands", "",
       "Choose the draw commands; the image is the same. instanced = one command per mesh and level; per-object = one "
       "command per object",
       OptionGroup::kDrawing, submissionChoice()},
      {"--capacity", "list capacity", "objects",
       "Limit the objects that one draw list holds; further objects are counted, reported and not drawn [all]",
       OptionGroup::kDrawing,
       MaybeCountValue{[](Options& o) -> std::optional<std::uint32_t>& { return o.rendererOptions.capacity; }, 1,
                       0x3fffffffU},
       "a --mode without occlusion queries", [](const Options& o) { return !modeHas<&CullModeRow::asksQueries>(o); }},
      {"--core", "core only", "", "Use OpenGL 4.5 core and no extension; the image is the same", OptionGroup::kDrawing,
       FlagValue{[](Options& o) -> bool& { return o.coreOnly; }}},
  };
}

std::vector<RenderOption> viewRows() {
  return {
      {"--view", "view", "", "Choose what the picture shows. " + policy::helpOf(viewTable()), OptionGroup::kView,
       choice<View, viewTable, viewOf>()},
      {"--map-level", "map level", "pyramid level",
       "Choose the level that --view occlusion shows; one texel is 2^level pixels wide", OptionGroup::kView,
       CountValue{[](Options& o) -> std::uint32_t& { return o.frameOptions.mapLevel; }, 0, 14},
       "--view " + policy::namesWith(viewTable(), &ViewRow::replacesFrame),
       [](const Options& o) { return rowOf(o.frameOptions.view).replacesFrame; }},
      {"--boxes", "rectangles", "",
       "Draw the bounding rectangle of every object over the view: visible green, partly occluded yellow, occluded "
       "red, "
       "occluders white",
       OptionGroup::kView, FlagValue{[](Options& o) -> bool& { return o.frameOptions.boxes; }}},
      {"--hide", "hidden objects", "",
       "Leave out these objects: a list, separated by commas, of names of nodes or meshes, of numbers in the order of "
       "the file, and of ranges of numbers such as 3-7. The cameras stay where they are",
       OptionGroup::kView, TextValue{[](Options& o) -> std::string& { return o.hide; }, "LIST"}},
      {"--only", "only these objects", "", "Leave out all objects but these: a list as of --hide", OptionGroup::kView,
       TextValue{[](Options& o) -> std::string& { return o.only; }, "LIST"}},
      {"--settle", "settle", "frames",
       "Render so many frames from the same camera before the picture; 0 shows the first frame after a cut",
       OptionGroup::kView, CountValue{[](Options& o) -> std::uint32_t& { return o.settle; }, 0, 1000},
       modesWith(&CullModeRow::needsHistory) + ", --lv " +
           policy::namesWith(lvMeasureTable(), &LvMeasureRow::countsPixels) + " or --calm",
       [](const Options& o) { return dependsOnHistory(policyOf(o)); }},
  };
}

std::vector<RenderOption> makeTable() {
  std::vector<RenderOption> rows;
  for (std::vector<RenderOption>& some :
       std::array{cullingRows(), faceRows(), queryRows(), queryOrderRows(), occluderRows(), portalRows(), levelRows(),
                  calmRows(), detailRows(), drawingRows(), viewRows()})
    for (RenderOption& row : some)
      rows.push_back(std::move(row));
  return rows;
}

}  // namespace

std::span<const RenderOption> renderOptionTable() {
  static const std::vector<RenderOption> kTable = makeTable();
  return kTable;
}

const RenderOption& renderOption(std::string_view name) {
  for (const RenderOption& row : renderOptionTable())
    if (name == row.name) return row;
  JAL_CHECK(name == "an option of the table");
  return renderOptionTable().front();
}

std::string optionHelp(const RenderOption& option) {
  return *option.unit == '\0' ? option.help : fmt::format("{}; {}", option.help, option.unit);
}

bool applies(const RenderOption& option, const RenderOptions& options) {
  return option.applies == nullptr || option.applies(options);
}

bool isSet(const RenderOption& option, const RenderOptions& options) {
  return options.given.contains(option.name) || valueText(option, options) != valueText(option, RenderOptions{});
}

std::string valueText(const RenderOption& option, const RenderOptions& options) {
  RenderOptions copy = options;
  return std::visit(
      Overloaded{
          [&](const ChoiceValue& v) { return v.get(copy); },
          [&](const NumberValue& v) { return fmt::format("{}", v.of(copy)); },
          [&](const MaybeNumberValue& v) { return v.of(copy) ? fmt::format("{}", *v.of(copy)) : std::string(); },
          [&](const CountValue& v) { return fmt::format("{}", v.of(copy)); },
          [&](const MaybeCountValue& v) { return v.of(copy) ? fmt::format("{}", *v.of(copy)) : std::string(); },
          [&](const FlagValue& v) { return std::string(v.of(copy) ? "on" : ""); },
          [&](const TextValue& v) { return v.of(copy); },
          [&](const FileValue& v) { return v.of(copy).string(); },
      },
      option.value);
}

void reset(const RenderOption& option, RenderOptions& options) {
  RenderOptions fresh;
  std::visit(Overloaded{[&](const ChoiceValue& v) { v.set(options, v.get(fresh)); },
                        [&](const auto& v) { v.of(options) = v.of(fresh); }},
             option.value);
  options.given.erase(option.name);
}

void dropInapplicable(RenderOptions& options) {
  for (bool changed = true; changed;) {
    changed = false;
    for (const RenderOption& row : renderOptionTable()) {
      if (!isSet(row, options) || applies(row, options)) continue;
      reset(row, options);
      changed = true;
    }
  }
}

namespace {

/// "a|b|c"; NAME where a manual page could not break the line, as the help names all.
std::string typeOf(const ChoiceValue& choice) {
  constexpr std::size_t kLongest = 64;
  const std::string names = fmt::format("{}", fmt::join(choice.names, "|"));
  return names.size() > kLongest ? "NAME" : names;
}

}  // namespace

void addToCommandLine(CLI::App& command, const RenderOption& option, RenderOptions& options) {
  const std::string help = optionHelp(option);
  const auto add = [&]<class Value>(const auto& v, Value /*kind*/) {
    return command.add_option_function<Value>(
        option.name,
        [&options, &option, of = v.of](const Value& value) {
          of(options) = value;
          options.given.insert(option.name);
        },
        help);
  };
  // The type says what may be given; the checks need not say it again.
  const auto number = [](CLI::Option* of, auto least, auto most, const char* endless) {
    const auto from = static_cast<double>(least);
    const auto to = static_cast<double>(most);
    return of->check(cli::inRange(from, to).description(""))
        ->type_name(to < kEndless ? fmt::format("{:g}..{:g}", from, to) : std::string(endless));
  };
  CLI::Option* added = std::visit(
      Overloaded{
          [&](const ChoiceValue& v) {
            return command
                .add_option_function<std::string>(
                    option.name,
                    [&options, &option, set = v.set](const std::string& name) {
                      set(options, name);
                      options.given.insert(option.name);
                    },
                    help)
                ->check(CLI::IsMember(v.names).description(""))
                ->type_name(typeOf(v));
          },
          [&](const NumberValue& v) { return number(add(v, float()), v.least, v.most, "NUMBER"); },
          [&](const MaybeNumberValue& v) { return number(add(v, float()), v.least, v.most, "NUMBER"); },
          [&](const CountValue& v) { return number(add(v, std::uint32_t()), v.least, v.most, "COUNT"); },
          [&](const MaybeCountValue& v) { return number(add(v, std::uint32_t()), v.least, v.most, "COUNT"); },
          [&](const FlagValue& v) { return command.add_flag(option.name, v.of(options), help); },
          [&](const TextValue& v) { return add(v, std::string())->type_name(v.type); },
          [&](const FileValue& v) { return add(v, std::string())->type_name(v.type); },
      },
      option.value);
  const std::string standard = valueText(option, RenderOptions{});
  if (!standard.empty()) added->default_str(standard);
}

}  // namespace jalousie::app
