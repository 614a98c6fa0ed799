// Writes small scenes as files: the one place where tests turn a procedural mesh into glTF or PLY.
#pragma once

#include <tiny_gltf.h>

#include <filesystem>
#include <glm/glm.hpp>
#include <string>

#include "asset/scene_types.h"

namespace jalousie::test {

/// Model with one empty scene, the default one.
tinygltf::Model emptyModel();

/// Appends a mesh of one primitive with positions, normals and indices. Returns its index.
int addMesh(tinygltf::Model& model, const asset::Primitive& mesh);

/// Appends a node that draws a mesh; it is in no scene yet. Returns its index.
int addMeshNode(tinygltf::Model& model, int mesh, const glm::dvec3& translation = glm::dvec3(0.0), double scale = 1.0);

/// A mesh as ASCII PLY, without normals.
std::string plyText(const asset::Primitive& mesh);

}  // namespace jalousie::test
