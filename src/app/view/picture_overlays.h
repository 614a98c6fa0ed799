// All overlays of one document's picture.
#pragma once

#include <cstddef>

#include "app/view/documents.h"
#include "app/view/view_state.h"

namespace jalousie::app {

/// Draws notices, frustum, selection, legends and divider over the picture of a document.
/// @param scale  of the interface
void drawOverlays(Documents& documents, std::size_t index, const ViewState& state, float scale);

}  // namespace jalousie::app
