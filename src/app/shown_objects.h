// Which objects of a file are drawn: the options --hide and --only.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "app/render_options.h"
#include "scene/scene_data.h"

namespace jalousie::app {

/// Instances of a file that --hide and --only leave out, ascending. An entry of a list is the number of an object in
/// the order of the file ("7"), a range of them ("7-12"), or a name of nodes or meshes, which stands for all their
/// objects.
/// Errors: kUsage for an empty entry, and for one that is no object of the file.
std::vector<std::uint32_t> hiddenObjects(const asset::SceneFile& file, const RenderOptions& options);

/// Lists of numbers, such as "1,3-7,9". @param objects  ascending
std::string objectList(const std::vector<std::uint32_t>& objects);

/// Sets --hide or --only, whichever is shorter, so that these objects are left out. @param hidden  ascending, distinct
/// @param count  of all objects of the file
void hideObjects(RenderOptions& options, const std::vector<std::uint32_t>& hidden, std::size_t count);

/// How the scene of these options is built. Errors: as hiddenObjects.
scene::BuildOptions buildOptionsOf(const asset::SceneFile& file, const RenderOptions& options);

}  // namespace jalousie::app
