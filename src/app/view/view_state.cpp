// Changes of a configuration.
#include "app/view/view_state.h"

#include "app/render_option_table.h"
#include "app/view/command_text.h"
#include "core/error.h"

namespace jalousie::app {

bool Configuration::update() {
  dropInapplicable(wanted);
  RenderOptions finished = wanted;
  try {
    finished.finishFrame();
  } catch (const Error& error) {
    refusal = error.what();
    return false;
  }
  refusal.clear();
  const bool changed = methodOptions(finished) != methodOptions(active);
  active = finished;
  return changed;
}

}  // namespace jalousie::app
