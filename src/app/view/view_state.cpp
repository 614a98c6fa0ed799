// Changes of a configuration: validation, and the next value of an option.
#include "app/view/view_state.h"

#include <fmt/format.h>

#include <algorithm>

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

std::string Configuration::cycle(const char* option, int step) {
  const RenderOption& row = renderOption(option);
  const auto& choice = std::get<ChoiceValue>(row.value);
  const auto count = static_cast<int>(choice.names.size());
  const RenderOptions before = wanted;
  const auto at =
      static_cast<int>(std::find(choice.names.begin(), choice.names.end(), choice.get(wanted)) - choice.names.begin());
  for (int i = 1; i <= count; ++i) {
    wanted = before;
    choice.set(wanted, choice.names[static_cast<std::size_t>((at + (i * step) + i * count) % count)]);
    update();
    if (refusal.empty()) break;
  }
  return fmt::format("{}: {}", row.label, choice.get(wanted));
}

}  // namespace jalousie::app
