// The linked programs are asked where they expect each field of the shared structs: proof, not discipline.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "gl/capabilities.h"
#include "gl/program.h"
#include "render/program_table.h"
#include "shared/face_structs.h"
#include "shared/frame_structs.h"
#include "shared/motion_structs.h"
#include "shared/query_structs.h"
#include "shared/scene_structs.h"
#include "support/gl_test.h"
#include "visibility/program_table.h"

namespace jalousie {
namespace {

struct Layout {
  std::size_t stride;                         ///< of the top-level array; 0 for uniform blocks
  std::map<std::string, std::size_t> fields;  ///< name as the program spells it -> offset
};

#define JAL_FIELD(prefix, type, field) \
  { prefix #field, offsetof(gpu::type, field) } /* NOLINT(bugprone-macro-parentheses): names, not expressions */

/// Every field of every shared struct, with the variable name the shaders use.
const std::map<std::string, Layout>& expectedLayouts() {
  static const std::map<std::string, Layout> kLayouts = {
      {"TransformBlock",
       {sizeof(gpu::Transform),
        {JAL_FIELD("transforms[0].", Transform, worldFromObject0),
         JAL_FIELD("transforms[0].", Transform, worldFromObject1),
         JAL_FIELD("transforms[0].", Transform, worldFromObject2)}}},
      {"ObjectBlock",
       {sizeof(gpu::Object),
        {JAL_FIELD("objects[0].", Object, chain), JAL_FIELD("objects[0].", Object, transform),
         JAL_FIELD("objects[0].", Object, owner), JAL_FIELD("objects[0].", Object, object)}}},
      {"CellBlock",
       {sizeof(gpu::Object),
        {JAL_FIELD("cells[0].", Object, chain), JAL_FIELD("cells[0].", Object, transform),
         JAL_FIELD("cells[0].", Object, owner), JAL_FIELD("cells[0].", Object, object)}}},
      {"BoundsBlock",
       {sizeof(gpu::CellBounds),
        {JAL_FIELD("bounds[0].", CellBounds, minObject), JAL_FIELD("bounds[0].", CellBounds, maxObject)}}},
      {"CellStateBlock",
       {sizeof(gpu::ObjectState),
        {JAL_FIELD("cellStates[0].", ObjectState, verdict), JAL_FIELD("cellStates[0].", ObjectState, lod),
         JAL_FIELD("cellStates[0].", ObjectState, tessellation), JAL_FIELD("cellStates[0].", ObjectState, lv)}}},
      {"CellMarkBlock", {sizeof(gpu::uint), {{"cellMarks[0]", 0}}}},
      {"ObjectMarkBlock", {sizeof(gpu::uint), {{"objectMarks[0]", 0}}}},
      {"ChainBlock",
       {sizeof(gpu::Chain),
        {JAL_FIELD("chains[0].", Chain, boundsMinObject), JAL_FIELD("chains[0].", Chain, boundsMaxObject),
         JAL_FIELD("chains[0].", Chain, firstLod), JAL_FIELD("chains[0].", Chain, lodCount),
         JAL_FIELD("chains[0].", Chain, patchLod), JAL_FIELD("chains[0].", Chain, binCount),
         JAL_FIELD("chains[0].", Chain, firstEntry), JAL_FIELD("chains[0].", Chain, tileCount),
         JAL_FIELD("chains[0].", Chain, surfaceObject), JAL_FIELD("chains[0].", Chain, reserved0)}}},
      {"LodBlock",
       {sizeof(gpu::Lod),
        {JAL_FIELD("lods[0].", Lod, firstIndex), JAL_FIELD("lods[0].", Lod, solidCount),
         JAL_FIELD("lods[0].", Lod, sheetCount), JAL_FIELD("lods[0].", Lod, blendCount),
         JAL_FIELD("lods[0].", Lod, baseVertex), JAL_FIELD("lods[0].", Lod, triangleCount),
         JAL_FIELD("lods[0].", Lod, errorObject), JAL_FIELD("lods[0].", Lod, meanErrorObject),
         JAL_FIELD("lods[0].", Lod, leastCoverage)}}},
      {"TileBlock",
       {sizeof(gpu::Tile),
        {JAL_FIELD("tiles[0].", Tile, firstObject), JAL_FIELD("tiles[0].", Tile, objectCount),
         JAL_FIELD("tiles[0].", Tile, chain), JAL_FIELD("tiles[0].", Tile, tileOfChain)}}},
      {"BinBlock", {sizeof(gpu::Bin), {JAL_FIELD("bins[0].", Bin, chain), JAL_FIELD("bins[0].", Bin, bin)}}},
      {"MaterialBlock",
       {sizeof(gpu::Material),
        {JAL_FIELD("materials[0].", Material, baseColor), JAL_FIELD("materials[0].", Material, emission),
         JAL_FIELD("materials[0].", Material, flags), JAL_FIELD("materials[0].", Material, alphaCutoff),
         JAL_FIELD("materials[0].", Material, reserved0), JAL_FIELD("materials[0].", Material, reserved1),
         JAL_FIELD("materials[0].", Material, base.uvAxes), JAL_FIELD("materials[0].", Material, base.uvOffset),
         JAL_FIELD("materials[0].", Material, base.place), JAL_FIELD("materials[0].", Material, base.sampling),
         JAL_FIELD("materials[0].", Material, emissive.uvAxes), JAL_FIELD("materials[0].", Material, emissive.uvOffset),
         JAL_FIELD("materials[0].", Material, emissive.place), JAL_FIELD("materials[0].", Material, emissive.sampling),
         JAL_FIELD("materials[0].", Material, normals.uvAxes), JAL_FIELD("materials[0].", Material, normals.uvOffset),
         JAL_FIELD("materials[0].", Material, normals.place), JAL_FIELD("materials[0].", Material, normals.sampling)}}},
      {"CommandBlock",
       {sizeof(gpu::DrawCommand),
        {JAL_FIELD("commands[0].", DrawCommand, count), JAL_FIELD("commands[0].", DrawCommand, instanceCount),
         JAL_FIELD("commands[0].", DrawCommand, firstIndex), JAL_FIELD("commands[0].", DrawCommand, baseVertex),
         JAL_FIELD("commands[0].", DrawCommand, baseInstance)}}},
      {"StateBlock",
       {sizeof(gpu::ObjectState),
        {JAL_FIELD("states[0].", ObjectState, verdict), JAL_FIELD("states[0].", ObjectState, lod),
         JAL_FIELD("states[0].", ObjectState, tessellation), JAL_FIELD("states[0].", ObjectState, lv)}}},
      {"BoxBlock",
       {sizeof(gpu::ScreenBox),
        {JAL_FIELD("boxes[0].", ScreenBox, minX), JAL_FIELD("boxes[0].", ScreenBox, minY),
         JAL_FIELD("boxes[0].", ScreenBox, maxX), JAL_FIELD("boxes[0].", ScreenBox, maxY),
         JAL_FIELD("boxes[0].", ScreenBox, nearestDepth), JAL_FIELD("boxes[0].", ScreenBox, pixelsPerUnit),
         JAL_FIELD("boxes[0].", ScreenBox, tau), JAL_FIELD("boxes[0].", ScreenBox, cover)}}},
      {"MarkBlock", {sizeof(gpu::uint), {{"marks[0]", 0}}}},
      {"GhostMarkBlock", {sizeof(gpu::uint), {{"ghostMarks[0]", 0}}}},
      {"GhostStateBlock",
       {sizeof(gpu::ObjectState),
        {JAL_FIELD("ghostStates[0].", ObjectState, verdict), JAL_FIELD("ghostStates[0].", ObjectState, lod),
         JAL_FIELD("ghostStates[0].", ObjectState, tessellation), JAL_FIELD("ghostStates[0].", ObjectState, lv)}}},
      {"SlotBlock", {sizeof(gpu::uint), {{"slots[0]", 0}}}},
      {"EarlySlotBlock", {sizeof(gpu::uint), {{"earlySlots[0]", 0}}}},
      {"LateSlotBlock", {sizeof(gpu::uint), {{"lateSlots[0]", 0}}}},
      {"EntryBlock", {sizeof(gpu::uint), {{"entries[0]", 0}}}},
      {"BlockSumBlock", {sizeof(gpu::uint), {{"blockSums[0]", 0}}}},
      {"InstanceBlock", {sizeof(gpu::uint), {{"instances[0]", 0}}}},
      {"DrawCountBlock", {sizeof(gpu::uint), {{"drawCounts[0]", 0}}}},
      {"PixelCountBlock", {sizeof(gpu::uint), {{"pixelCounts[0]", 0}}}},
      {"CounterBlock", {sizeof(gpu::uint), {{"counters[0]", 0}}}},
      {"BudgetBlock", {sizeof(gpu::uint), {{"budget[0]", 0}}}},
      {"DrawnBlock", {sizeof(gpu::uint), {{"drawn[0]", 0}}}},
      {"CosineBlock", {sizeof(float), {{"cosines[0]", 0}}}},
      {"OrderBlock", {sizeof(gpu::uint), {{"order[0]", 0}}}},
      {"DrawnBitBlock", {sizeof(gpu::uint), {{"drawnBits[0]", 0}}}},
      {"LeafBlock", {sizeof(gpu::uint), {{"leafOf[0]", 0}}}},
      {"SampleBlock", {sizeof(gpu::uint), {{"samples[0]", 0}}}},
      {"RangeBlock",
       {sizeof(gpu::SliceRange),
        {JAL_FIELD("ranges[0].", SliceRange, firstUnit), JAL_FIELD("ranges[0].", SliceRange, unitCount),
         JAL_FIELD("ranges[0].", SliceRange, node), JAL_FIELD("ranges[0].", SliceRange, reserved0)}}},
      {"NodeBlock",
       {sizeof(gpu::FaceNode),
        {JAL_FIELD("nodes[0].", FaceNode, lowest), JAL_FIELD("nodes[0].", FaceNode, highest),
         JAL_FIELD("nodes[0].", FaceNode, origin), JAL_FIELD("nodes[0].", FaceNode, sphere),
         JAL_FIELD("nodes[0].", FaceNode, apex), JAL_FIELD("nodes[0].", FaceNode, axis),
         JAL_FIELD("nodes[0].", FaceNode, firstIndex), JAL_FIELD("nodes[0].", FaceNode, indexCount),
         JAL_FIELD("nodes[0].", FaceNode, next), JAL_FIELD("nodes[0].", FaceNode, normals),
         JAL_FIELD("nodes[0].", FaceNode, inradius), JAL_FIELD("nodes[0].", FaceNode, reserved0),
         JAL_FIELD("nodes[0].", FaceNode, reserved1), JAL_FIELD("nodes[0].", FaceNode, reserved2)}}},
      {"FaceLodBlock",
       {sizeof(gpu::FaceLod),
        {JAL_FIELD("faceLods[0].", FaceLod, boundsMinObject), JAL_FIELD("faceLods[0].", FaceLod, boundsMaxObject),
         JAL_FIELD("faceLods[0].", FaceLod, firstNode), JAL_FIELD("faceLods[0].", FaceLod, nodeCount),
         JAL_FIELD("faceLods[0].", FaceLod, firstIndex), JAL_FIELD("faceLods[0].", FaceLod, solidCount),
         JAL_FIELD("faceLods[0].", FaceLod, sheetCount), JAL_FIELD("faceLods[0].", FaceLod, baseVertex),
         JAL_FIELD("faceLods[0].", FaceLod, reserved0), JAL_FIELD("faceLods[0].", FaceLod, reserved1)}}},
      {"UnitBlock",
       {sizeof(gpu::FaceUnit),
        {JAL_FIELD("units[0].", FaceUnit, firstLod), JAL_FIELD("units[0].", FaceUnit, transform)}}},
      {"FaceViewBlock",
       {0,
        {JAL_FIELD("FaceViewBlock.", FaceView, test), JAL_FIELD("FaceViewBlock.", FaceView, mostRanges),
         JAL_FIELD("FaceViewBlock.", FaceView, reserved0), JAL_FIELD("FaceViewBlock.", FaceView, reserved1)}}},
      {"WorkBlock", {sizeof(gpu::uint), {{"work[0]", 0}}}},
      {"FigureBlock", {sizeof(gpu::uint), {{"figures[0]", 0}}}},
      {"SliceViewBlock",
       {sizeof(gpu::SliceView),
        {JAL_FIELD("SliceViewBlock.", SliceView, objectCount), JAL_FIELD("SliceViewBlock.", SliceView, unitCount),
         JAL_FIELD("SliceViewBlock.", SliceView, commandCapacity), JAL_FIELD("SliceViewBlock.", SliceView, listCount),
         JAL_FIELD("SliceViewBlock.", SliceView, threshold), JAL_FIELD("SliceViewBlock.", SliceView, importance),
         JAL_FIELD("SliceViewBlock.", SliceView, faceCommands), JAL_FIELD("SliceViewBlock.", SliceView, reserved0)}}},
      {"CullViewBlock",
       {0,
        {JAL_FIELD("CullViewBlock.", CullView, clipFromWorld),
         JAL_FIELD("CullViewBlock.", CullView, cameraWorld),
         JAL_FIELD("CullViewBlock.", CullView, forwardWorld),
         JAL_FIELD("CullViewBlock.", CullView, viewportWidth),
         JAL_FIELD("CullViewBlock.", CullView, viewportHeight),
         JAL_FIELD("CullViewBlock.", CullView, objectCount),
         JAL_FIELD("CullViewBlock.", CullView, traits),
         JAL_FIELD("CullViewBlock.", CullView, analyse),
         JAL_FIELD("CullViewBlock.", CullView, mapLevels),
         JAL_FIELD("CullViewBlock.", CullView, occluderDistance),
         JAL_FIELD("CullViewBlock.", CullView, cullThreshold),
         JAL_FIELD("CullViewBlock.", CullView, maxTessellation),
         JAL_FIELD("CullViewBlock.", CullView, focalPixels),
         JAL_FIELD("CullViewBlock.", CullView, tau),
         JAL_FIELD("CullViewBlock.", CullView, occluderTau),
         JAL_FIELD("CullViewBlock.", CullView, minPixels),
         JAL_FIELD("CullViewBlock.", CullView, importanceLevels),
         JAL_FIELD("CullViewBlock.", CullView, importanceWidth),
         JAL_FIELD("CullViewBlock.", CullView, importanceHeight),
         JAL_FIELD("CullViewBlock.", CullView, relax),
         JAL_FIELD("CullViewBlock.", CullView, calm),
         JAL_FIELD("CullViewBlock.", CullView, countsValid),
         JAL_FIELD("CullViewBlock.", CullView, measureCover),
         JAL_FIELD("CullViewBlock.", CullView, hysteresis),
         JAL_FIELD("CullViewBlock.", CullView, fadeFrames),
         JAL_FIELD("CullViewBlock.", CullView, maxError),
         JAL_FIELD("CullViewBlock.", CullView, triangleBudget),
         JAL_FIELD("CullViewBlock.", CullView, cellCount),
         JAL_FIELD("CullViewBlock.", CullView, cullCells),
         JAL_FIELD("CullViewBlock.", CullView, minSpherePixels),
         JAL_FIELD("CullViewBlock.", CullView, reserved0)}}},
      {"MotionNodeBlock",
       {sizeof(gpu::MotionNode),
        {JAL_FIELD("nodes[0].", MotionNode, anchorFromParent0), JAL_FIELD("nodes[0].", MotionNode, anchorFromParent1),
         JAL_FIELD("nodes[0].", MotionNode, anchorFromParent2), JAL_FIELD("nodes[0].", MotionNode, translation),
         JAL_FIELD("nodes[0].", MotionNode, rotation), JAL_FIELD("nodes[0].", MotionNode, scale),
         JAL_FIELD("nodes[0].", MotionNode, anchor), JAL_FIELD("nodes[0].", MotionNode, translationTrack),
         JAL_FIELD("nodes[0].", MotionNode, rotationTrack), JAL_FIELD("nodes[0].", MotionNode, scaleTrack)}}},
      {"MotionTrackBlock",
       {sizeof(gpu::MotionTrack),
        {JAL_FIELD("tracks[0].", MotionTrack, firstTime), JAL_FIELD("tracks[0].", MotionTrack, keyCount),
         JAL_FIELD("tracks[0].", MotionTrack, firstValue), JAL_FIELD("tracks[0].", MotionTrack, width),
         JAL_FIELD("tracks[0].", MotionTrack, interpolation)}}},
      {"MotionNumberBlock", {sizeof(float), {{"numbers[0]", 0}}}},
      {"MotionLocalBlock",
       {sizeof(gpu::Transform),
        {JAL_FIELD("locals[0].", Transform, worldFromObject0), JAL_FIELD("locals[0].", Transform, worldFromObject1),
         JAL_FIELD("locals[0].", Transform, worldFromObject2)}}},
      {"MotionWeightBlock",
       {sizeof(gpu::MotionWeight),
        {JAL_FIELD("weightTable[0].", MotionWeight, track), JAL_FIELD("weightTable[0].", MotionWeight, component),
         JAL_FIELD("weightTable[0].", MotionWeight, rest)}}},
      {"WeightBlock", {sizeof(float), {{"weights[0]", 0}}}},
      {"MotionTargetBlock",
       {sizeof(gpu::MotionTarget),
        {JAL_FIELD("targets[0].", MotionTarget, nodeFromTarget0),
         JAL_FIELD("targets[0].", MotionTarget, nodeFromTarget1),
         JAL_FIELD("targets[0].", MotionTarget, nodeFromTarget2), JAL_FIELD("targets[0].", MotionTarget, node),
         JAL_FIELD("targets[0].", MotionTarget, destination), JAL_FIELD("targets[0].", MotionTarget, reserved0),
         JAL_FIELD("targets[0].", MotionTarget, reserved1)}}},
      {"MovedTransformBlock",
       {sizeof(gpu::Transform),
        {JAL_FIELD("transforms[0].", Transform, worldFromObject0),
         JAL_FIELD("transforms[0].", Transform, worldFromObject1),
         JAL_FIELD("transforms[0].", Transform, worldFromObject2)}}},
      {"JointBlock",
       {sizeof(gpu::Transform),
        {JAL_FIELD("joints[0].", Transform, worldFromObject0), JAL_FIELD("joints[0].", Transform, worldFromObject1),
         JAL_FIELD("joints[0].", Transform, worldFromObject2)}}},
      {"VertexWordBlock", {sizeof(gpu::uint), {{"vertexWords[0]", 0}}}},
      {"LooseWordBlock", {sizeof(gpu::uint), {{"looseWords[0]", 0}}}},
      {"BentVertexBlock",
       {sizeof(gpu::BentVertex),
        {JAL_FIELD("bentVertices[0].", BentVertex, position), JAL_FIELD("bentVertices[0].", BentVertex, normal),
         JAL_FIELD("bentVertices[0].", BentVertex, destination), JAL_FIELD("bentVertices[0].", BentVertex, flags),
         JAL_FIELD("bentVertices[0].", BentVertex, firstInfluence),
         JAL_FIELD("bentVertices[0].", BentVertex, influenceCount),
         JAL_FIELD("bentVertices[0].", BentVertex, firstDelta), JAL_FIELD("bentVertices[0].", BentVertex, deltaStride),
         JAL_FIELD("bentVertices[0].", BentVertex, targetCount),
         JAL_FIELD("bentVertices[0].", BentVertex, firstWeight)}}},
      {"InfluenceBlock",
       {sizeof(gpu::Influence),
        {JAL_FIELD("influences[0].", Influence, joint), JAL_FIELD("influences[0].", Influence, weight)}}},
      {"DeltaBlock",
       {sizeof(gpu::MorphDelta),
        {JAL_FIELD("deltas[0].", MorphDelta, position), JAL_FIELD("deltas[0].", MorphDelta, normal)}}},
      {"MovedChainBlock",
       {sizeof(gpu::Chain),
        {JAL_FIELD("chains[0].", Chain, boundsMinObject), JAL_FIELD("chains[0].", Chain, boundsMaxObject),
         JAL_FIELD("chains[0].", Chain, firstLod), JAL_FIELD("chains[0].", Chain, lodCount),
         JAL_FIELD("chains[0].", Chain, patchLod), JAL_FIELD("chains[0].", Chain, binCount),
         JAL_FIELD("chains[0].", Chain, firstEntry), JAL_FIELD("chains[0].", Chain, tileCount),
         JAL_FIELD("chains[0].", Chain, surfaceObject), JAL_FIELD("chains[0].", Chain, reserved0)}}},
      {"MovedCellChainBlock",
       {sizeof(gpu::Chain),
        {JAL_FIELD("cellChains[0].", Chain, boundsMinObject), JAL_FIELD("cellChains[0].", Chain, boundsMaxObject),
         JAL_FIELD("cellChains[0].", Chain, firstLod), JAL_FIELD("cellChains[0].", Chain, lodCount),
         JAL_FIELD("cellChains[0].", Chain, patchLod), JAL_FIELD("cellChains[0].", Chain, binCount),
         JAL_FIELD("cellChains[0].", Chain, firstEntry), JAL_FIELD("cellChains[0].", Chain, tileCount),
         JAL_FIELD("cellChains[0].", Chain, surfaceObject), JAL_FIELD("cellChains[0].", Chain, reserved0)}}},
      {"BentBoxBlock",
       {sizeof(gpu::BentBox),
        {JAL_FIELD("bentBoxes[0].", BentBox, minObject), JAL_FIELD("bentBoxes[0].", BentBox, maxObject),
         JAL_FIELD("bentBoxes[0].", BentBox, joint), JAL_FIELD("bentBoxes[0].", BentBox, firstDelta),
         JAL_FIELD("bentBoxes[0].", BentBox, targetCount), JAL_FIELD("bentBoxes[0].", BentBox, firstWeight)}}},
      {"BentChainBlock",
       {sizeof(gpu::BentChain),
        {JAL_FIELD("bentChains[0].", BentChain, chain), JAL_FIELD("bentChains[0].", BentChain, firstBox),
         JAL_FIELD("bentChains[0].", BentChain, boxCount), JAL_FIELD("bentChains[0].", BentChain, cellChain),
         JAL_FIELD("bentChains[0].", BentChain, firstCellLod), JAL_FIELD("bentChains[0].", BentChain, cellLodCount),
         JAL_FIELD("bentChains[0].", BentChain, leastSum), JAL_FIELD("bentChains[0].", BentChain, mostSum),
         JAL_FIELD("bentChains[0].", BentChain, bulge), JAL_FIELD("bentChains[0].", BentChain, reserved0),
         JAL_FIELD("bentChains[0].", BentChain, longestEdge), JAL_FIELD("bentChains[0].", BentChain, weightStep)}}},
      {"DeltaBoxBlock",
       {sizeof(gpu::CellBounds),
        {JAL_FIELD("deltaBoxes[0].", CellBounds, minObject), JAL_FIELD("deltaBoxes[0].", CellBounds, maxObject)}}},
      {"MovedCellBoundsBlock",
       {sizeof(gpu::CellBounds),
        {JAL_FIELD("cellBounds[0].", CellBounds, minObject), JAL_FIELD("cellBounds[0].", CellBounds, maxObject)}}},
      {"MotionViewBlock",
       {0,
        {JAL_FIELD("MotionViewBlock.", MotionView, seconds), JAL_FIELD("MotionViewBlock.", MotionView, nodeCount),
         JAL_FIELD("MotionViewBlock.", MotionView, weightCount),
         JAL_FIELD("MotionViewBlock.", MotionView, transformCount),
         JAL_FIELD("MotionViewBlock.", MotionView, targetCount), JAL_FIELD("MotionViewBlock.", MotionView, vertexCount),
         JAL_FIELD("MotionViewBlock.", MotionView, chainCount), JAL_FIELD("MotionViewBlock.", MotionView, reserved0)}}},
      {"PriceBlock",
       {0,
        {JAL_FIELD("PriceBlock.", PriceState, logFine), JAL_FIELD("PriceBlock.", PriceState, logCoarse),
         JAL_FIELD("PriceBlock.", PriceState, gain), JAL_FIELD("PriceBlock.", PriceState, lastError),
         JAL_FIELD("PriceBlock.", PriceState, logOver), JAL_FIELD("PriceBlock.", PriceState, overAge),
         JAL_FIELD("PriceBlock.", PriceState, reserved0), JAL_FIELD("PriceBlock.", PriceState, reserved1)}}},
      {"PriceStateBlock",
       {0,
        {JAL_FIELD("price.", PriceState, logFine), JAL_FIELD("price.", PriceState, logCoarse),
         JAL_FIELD("price.", PriceState, gain), JAL_FIELD("price.", PriceState, lastError),
         JAL_FIELD("price.", PriceState, logOver), JAL_FIELD("price.", PriceState, overAge),
         JAL_FIELD("price.", PriceState, reserved0), JAL_FIELD("price.", PriceState, reserved1)}}},
      {"ListViewBlock",
       {0,
        {JAL_FIELD("ListViewBlock.", ListView, phase), JAL_FIELD("ListViewBlock.", ListView, tileCount),
         JAL_FIELD("ListViewBlock.", ListView, binCount), JAL_FIELD("ListViewBlock.", ListView, entryCount),
         JAL_FIELD("ListViewBlock.", ListView, capacity), JAL_FIELD("ListViewBlock.", ListView, commandCapacity),
         JAL_FIELD("ListViewBlock.", ListView, patches), JAL_FIELD("ListViewBlock.", ListView, reserved0)}}},
      {"ReduceViewBlock",
       {0,
        {JAL_FIELD("ReduceViewBlock.", ReduceView, screenWidth),
         JAL_FIELD("ReduceViewBlock.", ReduceView, screenHeight),
         JAL_FIELD("ReduceViewBlock.", ReduceView, sourceLevel),
         JAL_FIELD("ReduceViewBlock.", ReduceView, reserved0)}}},
      {"DrawViewBlock",
       {0,
        {JAL_FIELD("DrawViewBlock.", DrawView, clipFromWorld), JAL_FIELD("DrawViewBlock.", DrawView, cameraWorld),
         JAL_FIELD("DrawViewBlock.", DrawView, forwardWorld), JAL_FIELD("DrawViewBlock.", DrawView, lightWorld),
         JAL_FIELD("DrawViewBlock.", DrawView, view), JAL_FIELD("DrawViewBlock.", DrawView, patches),
         JAL_FIELD("DrawViewBlock.", DrawView, mapLevel), JAL_FIELD("DrawViewBlock.", DrawView, phongAlpha),
         JAL_FIELD("DrawViewBlock.", DrawView, viewportWidth), JAL_FIELD("DrawViewBlock.", DrawView, viewportHeight),
         JAL_FIELD("DrawViewBlock.", DrawView, maxTessellation), JAL_FIELD("DrawViewBlock.", DrawView, depthGuard),
         JAL_FIELD("DrawViewBlock.", DrawView, fadeFrames), JAL_FIELD("DrawViewBlock.", DrawView, reserved0),
         JAL_FIELD("DrawViewBlock.", DrawView, reserved1), JAL_FIELD("DrawViewBlock.", DrawView, reserved2)}}},
  };
  return kLayouts;
}

std::string resourceName(GLuint program, GLenum kind, GLuint index) {
  char name[256] = {};
  glGetProgramResourceName(program, kind, index, sizeof(name), nullptr, name);
  return name;
}

/// "cullView.mode" and "CullViewBlock.mode" both name a member of an instance-less or instanced uniform block.
std::string fieldOf(const std::string& variable) {
  return variable.substr(variable.find('.') + 1);
}

std::size_t checkVariable(GLuint program, GLenum kind, GLuint index, const std::string& block, const Layout& layout) {
  const std::string name = resourceName(program, kind, index);
  for (const auto& [expectedName, expectedOffset] : layout.fields) {
    if (fieldOf(expectedName) != fieldOf(name)) continue;
    // An array of structs has a top-level stride, an array of scalars an array stride; the other one is 0.
    const GLenum properties[] = {GL_OFFSET, GL_ARRAY_STRIDE, GL_TOP_LEVEL_ARRAY_STRIDE};
    GLint values[3] = {};
    glGetProgramResourceiv(program, kind, index, kind == GL_BUFFER_VARIABLE ? 3 : 1, properties, 3, nullptr, values);
    EXPECT_EQ(static_cast<std::size_t>(values[0]), expectedOffset) << block << ": " << name;
    if (kind == GL_BUFFER_VARIABLE) {
      EXPECT_EQ(static_cast<std::size_t>(std::max(values[1], values[2])), layout.stride) << block << ": " << name;
    }
    return 1;
  }
  ADD_FAILURE() << block << " has a field '" << name << "' that this test does not know";
  return 0;
}

/// Checks all blocks of one kind; returns the names of the blocks seen.
std::set<std::string> checkBlocks(GLuint program, GLenum blockKind, GLenum variableKind) {
  std::set<std::string> seen;
  GLint blocks = 0;
  glGetProgramInterfaceiv(program, blockKind, GL_ACTIVE_RESOURCES, &blocks);
  for (GLuint b = 0; b < static_cast<GLuint>(blocks); ++b) {
    const std::string name = resourceName(program, blockKind, b);
    const auto layout = expectedLayouts().find(name);
    if (layout == expectedLayouts().end()) {
      ADD_FAILURE() << "unknown block " << name;
      continue;
    }
    const GLenum countProperty = GL_NUM_ACTIVE_VARIABLES;
    GLint count = 0;
    glGetProgramResourceiv(program, blockKind, b, 1, &countProperty, 1, nullptr, &count);
    std::vector<GLint> variables(static_cast<std::size_t>(count));
    const GLenum listProperty = GL_ACTIVE_VARIABLES;
    glGetProgramResourceiv(program, blockKind, b, 1, &listProperty, count, nullptr, variables.data());
    std::size_t checked = 0;
    for (const GLint variable : variables)
      checked += checkVariable(program, variableKind, static_cast<GLuint>(variable), name, layout->second);
    EXPECT_EQ(checked, variables.size()) << name;
    seen.insert(name);
  }
  return seen;
}

class SharedStructsGl : public test::GlTest {};

void checkProgram(const gl::ProgramSource& source, std::set<std::string>& seen) {
  const gl::Program program(source);
  seen.merge(checkBlocks(program.id(), GL_SHADER_STORAGE_BLOCK, GL_BUFFER_VARIABLE));
  seen.merge(checkBlocks(program.id(), GL_UNIFORM_BLOCK, GL_UNIFORM));
}

TEST_F(SharedStructsGl, EveryProgramOfTheTablesAgreesWithTheCppLayout) {
  std::set<std::string> seen;
  const gl::Capabilities capabilities = gl::queryCapabilities();
  for (const gl::ProgramSource& source : visibility::programTable())
    checkProgram(source, seen);
  for (const gl::ProgramSource& source : render::programTable()) {
    checkProgram(source, seen);
    if (capabilities.drawParameters) checkProgram(gl::withDefine(source, render::kDrawParametersDefine), seen);
    checkProgram(gl::withDefine(source, render::kFullMaterialsDefine), seen);
  }
  for (const auto& [name, layout] : expectedLayouts())
    EXPECT_TRUE(seen.contains(name)) << name << " is used by no program";
}

}  // namespace
}  // namespace jalousie
