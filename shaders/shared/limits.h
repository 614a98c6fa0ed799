// Limits, workgroup sizes and bindings, once for C++ and GLSL.
#ifndef JALOUSIE_SHARED_LIMITS_H
#define JALOUSIE_SHARED_LIMITS_H

#include "shared/types.h"

JAL_SHARED_BEGIN

/// Threads per workgroup of the kernels that handle one object per thread; also the objects of one tile.
const uint kObjectGroupSize = 64u;
/// Threads per workgroup of the prefix sum, and the entries each of them adds up.
const uint kScanGroupSize = 256u;
const uint kScanEntriesPerThread = 4u;
const uint kScanBlock = 1024u;  // kScanGroupSize * kScanEntriesPerThread
/// Open chord in pixels at the end of the scale of the hole view; it is logarithmic.
const float kHoleScalePixels = 256.0;
/// Surfaces per pixel at the end of the scale of the overdraw view; it is logarithmic too.
const float kOverdrawScale = 64.0;
/// Triangles per pixel at both ends of the scale of the density view, which is logarithmic as well.
const float kLeastDensity = 0.00390625;  // 1/256
const float kMostDensity = 4.0;
/// Area on the screen of a triangle that reaches behind the eye, pixels.
const float kLargestTriangleArea = 1073741824.0;
/// Side of the square workgroup of the kernels that handle one texel per thread.
const uint kTexelGroupSide = 8u;
/// Pixels of the item buffer that one thread counts.
const int kCountBlockWidth = 32;
const int kCountBlockHeight = 2;

/// The analysed block lies this many pyramid levels below the level at which the AABR is about one texel (thesis 3.5).
const uint kBlockLevels = 4u;
/// Longest side of the analysed block in texels: 2^kBlockLevels.
const uint kMaxBlockSide = 16u;
/// A block whose longer side is shorter than this has no meaningful spectrum: its mean alone counts.
const uint kMinSpectrumSide = 4u;
/// Open chord in pixels at which the chord measure halves (docs/level_of_visibility.md).
const float kChordPixels = 16.0;
/// Masking: an error behind holes with a mean chord of d pixels counts (kMaskingPixels / d)^kMaskingExponent times
/// less, with d clamped to [1, kMaskingPixels] (docs/level_of_visibility.md).
const float kMaskingPixels = 64.0;
const float kMaskingExponent = 0.3F;
/// The smallest visible share that a budget is relaxed for.
const float kLeastShare = 1.0 / 1073741824.0;
/// Share of its rectangle that an object in full sight is taken to fill.
const float kSilhouetteShare = 0.5;
/// Pixels added to the visible and to the expected pixels before they are divided, so that one visible pixel more or
/// less of a mostly occluded object does not change its level.
const float kPixelGuard = 4.0;

/// Area of a circle over the square of its diameter, for shares of the screen.
const float kQuarterPi = 0.785398163F;

// One price (docs/lod_selection.md).
/// Mean error from which a pixel of an object is as wrong as it can be, pixels.
const float kErrorCap = 2.0;
/// Price of a triangle at a tau of one pixel: pixels of area times pixels of error.
const float kTrianglePrice = 1.0 / 32.0;
/// A calm level is chosen for at least this share of the pixels of an object in full sight. Its error then is at most
/// kMostCalmRelaxed times as large, so that an occluded object need not change its level when it becomes visible.
const float kLeastCalmVisible = 1.0 / 16.0;  // kMostCalmRelaxed^-2
/// An object whose silhouette is a smaller share of its rectangle is thin: the pixels of the rectangle do not say how
/// much of it is occluded.
const float kThinShare = 1.0 / 16.0;
/// Usual limit of the largest deviation, pixels.
const float kDefaultMaxError = 8.0;

// Budget of triangles (docs/lod_selection.md).
/// Logarithm of triangles over budget that is left alone.
const float kBudgetTolerance = 1.0 / 64.0;
/// Step of the logarithm of the price per unit of this logarithm, at most; and the gain from which a frame below the
/// budget is left alone. Triangles fall with about the root of the price.
const float kMostGain = 1.5;
const float kLeastGain = 1.0 / 64.0;
/// Share of the calm margin by which a narrowed one becomes wider in each frame that is within its budget.
const float kMarginRecovery = 1.0 / 64.0;
/// A step across the budget halves the gain, so that the price comes to rest where one object's levels are the only
/// choice. The gain grows by this factor while the frame stays above the budget or moves away from it.
const float kGainGrowth = 1.5;
/// Growth of the logarithm in one frame that a cut of the camera makes and no step of the price: the gain starts again.
const float kBudgetJump = 0.25;
/// Without calm levels, where the gain is at its least below the budget: share of the budget that a finer level of one
/// object may add, and the least share of the step that the price of such levels takes. A smaller gain grows by
/// kSmallGainGrowth.
const float kBudgetSmallStep = 1.0 / 64.0;
const float kLeastSmallGain = 1.0 / 64.0;
const float kSmallGainGrowth = 4.0;
/// A price from which the frame was above the budget bounds the steps down for so many frames: a step goes half the way
/// to it, and the price rests where less than this is left. Between the two lies a step of the levels of one object.
const float kOverFrames = 8.0;
const float kNarrowestStep = 0.03125;  // 1/32
/// Largest step in one frame, and the range of the logarithm of the factor.
const float kMostLogStep = 1.0;
const float kMostLogFactor = 24.0;

// What a frame with a budget sums up: two words per sum, bits 0-9 and the rest of all terms.
const uint kBudgetStages = 2u;  // objects that the first phase draws, and all others
/// Triangles over budget from which levels become coarser in the same frame, before each of the two phases is drawn.
const float kBudgetLimitEarly = 1.0625;
const float kBudgetLimitLate = 1.078125;
/// Share of the budget that is reserved at most for what came into view.
const float kMostReserved = 0.5;
/// Steps of coarser levels: each multiplies tau and the limit of the largest deviation. The last one is the coarsest
/// level of every chain.
const uint kBudgetSteps = 32u;
const float kBudgetStepScale = 1.125;
const float kBudgetLastScale = 1048576.0;
const uint kBudgetWanted = 0u;         // [kBudgetStages][2] at the price, without levels that fade out
const uint kBudgetDrawn = 4u;          // [kBudgetStages][2] in this frame, with them
const uint kBudgetForecast = 8u;       // [kBudgetSteps][2] of the stage's objects at each step
const uint kBudgetReserve = 72u;       // [2] of the coarsest levels of what came into view and may be drawn late
const uint kBudgetObjectGroups = 74u;  // [3] workgroups of the kernels that make levels coarser; 0 within the limit
const uint kBudgetCellGroups = 77u;    // [3] and of those that then decide about cells again
const uint kBudgetWords = 80u;

// Calm (docs/lod_selection.md).
/// A level stays while its error is at most the budget times CullView.hysteresis, and the next coarser one's is above
/// the budget divided by it. The usual margin.
const float kDefaultHysteresis = 2.0;
/// A calm budget is relaxed by at most the width of the default margin: the level of an occluded object then still fits
/// when the object becomes visible.
const float kMostCalmRelaxed = 4.0;         // kDefaultHysteresis^2
const float kLeastCalmShare = 1.0 / 256.0;  // kMostCalmRelaxed^-4
/// Step of the level of visibility towards its new value in one frame, as a share of the difference, when the object
/// becomes visible and when it becomes occluded.
const float kSmoothAppearing = 0.25;
const float kSmoothHiding = 0.03125;
/// Frames of a cross-fade: the usual ones, and how many the marks have room for.
const uint kDefaultFadeFrames = 8u;
const uint kMaxFadeFrames = 15u;
/// The overlap test looks at most this many levels below LOM (thesis 3.4).
const uint kMaxDescent = 2u;

/// A slot holds an object's bin in its low bits and its rank among the tile's objects of that bin above them.
const uint kSlotBinBits = 8u;
const uint kNoBin = 0xffffffffu;

/// Two phases: an object that comes into view is drawn before the test if its rectangle covers at least this share of
/// the screen, because it probably occludes more than it costs.
const float kLargeShare = 1.0 / 32.0;

/// Bound of the rounding error of a clip-space component, as a share of the sum of the magnitudes that went into it.
/// Clip space is two affine sums of four products each; the kernel and the vertex stage each round them.
const float kRounding = 1.0 / 1048576.0;  // 2^-20
/// Bound of the error of a rasterised depth, as a share of the depth: rasterisers lose bits when they interpolate it.
const float kDepthSlack = 1.0 / 16384.0;
/// Lowest importance that a region of the screen can have: tau grows to at most 16 times.
const float kLeastImportance = 1.0 / 16.0;

/// Finest tessellation level (thesis 4.1.3). A patch then has 3 * 20^2 / 2 = 600 triangles.
const uint kMaxTessellationLevel = 20u;
/// Array textures that the base colours of a scene are sorted into by size, at most.
const uint kTextureClasses = 8u;
/// Most levels one chain may have. State and colour scales assume no more.
const uint kMaxLods = 32u;
/// Bins of a chain: per level, plain and mirrored instances.
const uint kMaxBinsPerChain = 64u;

// Draw lists, one multi-draw-indirect call each.
const uint kListSolid = 0u;       // single-sided opaque triangles, back faces culled by the rasteriser
const uint kListSheet = 1u;       // double-sided or masked triangles, and mirrored objects: facing decided per fragment
const uint kListBlend = 2u;       // blended triangles: drawn last, never occlude
const uint kListSolidPatch = 3u;  // the same three, drawn as tessellated patches
const uint kListSheetPatch = 4u;
const uint kListBlendPatch = 5u;
const uint kListCount = 6u;
const uint kListsPerDetail = 3u;
// Behind the command counts of the lists, in the same buffer of draw counts.
const uint kCountInstances = 6u;  // entries of the instance list
const uint kDrawCounts = 7u;

// Frame counters (count_states.comp).
const uint kCounterVerdicts = 0u;    // [kVerdictCount]
const uint kCounterLevels = 16u;     // [kMaxLods] drawn objects per LOD, or per tessellation level - 1
const uint kCounterTriangles = 48u;  // [4] sums of bits 0-9, 10-19, 20-29, 30-31 of the drawn triangles per object
const uint kCounterEarly = 52u;      // objects drawn in the first phase
const uint kCounterLate = 53u;       // and in the second
const uint kCounterSwitches = 54u;   // drawn at another level than in the last frame
const uint kCounterFading = 55u;     // drawn at two levels
const uint kCounterDropped = 56u;    // not drawn, or not at both levels, because a list had no room
const uint kCounterCells = 57u;      // drawn cells
const uint kCounterCount = 58u;

// Shader storage bindings; core OpenGL promises eight, so kernels that never share a dispatch share numbers.
const uint kBindingTransforms = 0u;
const uint kBindingObjects = 1u;
const uint kBindingChains = 2u;
const uint kBindingLods = 3u;
const uint kBindingStates = 4u;
const uint kBindingBoxes = 5u;
const uint kBindingMarks = 6u;
const uint kBindingCosines = 7u;
const uint kBindingPixelCounts = 7u;
// Kernels that build the draw lists.
const uint kBindingTiles = 0u;
const uint kBindingBins = 0u;
const uint kBindingSlots = 1u;
const uint kBindingDrawCounts = 1u;
const uint kBindingInstances = 4u;
const uint kBindingCommands = 5u;
const uint kBindingBlockSums = 6u;
const uint kBindingEntries = 7u;
// Cells (classify_cells.comp, analyse_cells.comp, count_cells.comp): what belongs to a cell, not to its object.
const uint kBindingCellBounds = 3u;
const uint kBindingCellStates = 5u;
const uint kBindingCellMarks = 7u;
const uint kBindingObjectMarks = 7u;
const uint kBindingSlotsOfList = 5u;
// Culled objects (mark_ghosts.comp).
const uint kBindingGhostStates = 5u;
const uint kBindingGhostMarks = 7u;
// Counting.
const uint kBindingCounters = 0u;
const uint kBindingEarlySlots = 5u;
const uint kBindingLateSlots = 7u;
const uint kBindingPriceState = 1u;
// Budget of triangles.
const uint kBindingBudget = 0u;
const uint kBindingDrawnOfCells = 5u;
const uint kBindingDrawnOfObjects = 7u;
// Drawing programs.
const uint kBindingDrawBoxes = 3u;
const uint kBindingDrawInstances = 5u;
const uint kBindingMaterials = 7u;

// Uniform buffer bindings.
const uint kBindingCullView = 0u;
const uint kBindingDrawView = 1u;
const uint kBindingListView = 2u;
const uint kBindingReduceView = 3u;
const uint kBindingPrice = 4u;

// Texture and image units.
const uint kUnitBaseColor = 8u;  // and the next ones: [kTextureClasses]
const uint kUnitOcclusionMap = 1u;
const uint kUnitDepthPyramid = 2u;
const uint kUnitDepth = 3u;
const uint kUnitImportance = 4u;
const uint kImageSource = 0u;
const uint kImageTarget = 1u;

// Vertex attribute locations.
const uint kAttributePosition = 0u;
const uint kAttributeNormal = 1u;
const uint kAttributeUv = 2u;
const uint kAttributeColor = 3u;
const uint kAttributeMaterial = 4u;
const uint kAttributeObject = 5u;
const uint kAttributeUv1 = 6u;  // of scenes with JAL_FULL_MATERIALS

JAL_SHARED_END

#endif
