// What each action does.
#pragma once

#include "app/view/actions.h"
#include "app/view/viewer_parts.h"

namespace jalousie::app {

/// Performs an action of a key or a button. Actions on a document do nothing if none is open.
void perform(Action action, ViewerParts& parts);

}  // namespace jalousie::app
