// KHR_mesh_quantization: stores vertex attributes as small integers.
#pragma once

#include <tiny_gltf.h>

namespace jalousie::asset {

/// Stores vertex attributes of triangle meshes as small integers:
///   POSITION    3 x 16 bits, normalised, on a cube around the mesh and all its levels of detail; the error is at
///               most half of 1/65535 of the cube's side along each axis
///   NORMAL      3 x 8 bits, normalised; off by at most 0.4 degrees
///   TANGENT     4 x 8 bits, normalised, handedness exact
///   TEXCOORD_n  2 x 16 bits, normalised, where every value of the primitive lies in [0, 1]
///   COLOR_n     4 x 8 bits, normalised, likewise
/// A mesh's node gets a child that carries the mesh, its MSFT_lod and the transform back to object space, so that the
/// node's own transform, animation, children and name stay what they were. Lengths in extras.jalousie follow into the
/// mesh's new object space and grow by the rounding of positions. Meshes with morph targets or skins, of other modes
/// than triangles, and with integers already are left alone; so are POSITIONs of meshes that a node with instances
/// (EXT_mesh_gpu_instancing) shows.
/// Declares the extension as used and required if anything was changed. Errors: kUnsupported (positions that span more
/// than floats can scale).
void quantizeModel(tinygltf::Model& model);

/// The most by which quantizeModel increases the errors of a mesh, object-space length. @param extent  the longest side
/// of the box around the mesh and its levels, not negative
double quantizeRounding(double extent);

}  // namespace jalousie::asset
