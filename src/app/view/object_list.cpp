// Joins the objects of the file with the states of the frame.
#include "app/view/object_list.h"

#include <algorithm>

#include "app/shown_objects.h"
#include "core/error.h"
#include "scene/patch_base.h"
#include "visibility/object_decision.h"

namespace jalousie::app {
namespace {

/// Fills in what the last frame of a renderer decided.
void addFrame(ObjectTable& table, Side& side, bool patches) {
  const scene::SceneData& scene = side.scene();
  const std::vector<gpu::ObjectState> states = side.renderer().readStates();
  const std::vector<gpu::uint> pixels =
      table.countsPixels ? side.renderer().readPixelCounts() : std::vector<gpu::uint>(states.size());
  for (std::size_t i = 0; i < states.size(); ++i) {
    ListedObject& object = table.objects.at(scene.objects[i].owner);
    object.hidden = false;
    object.drawn = visibility::isDrawn(states[i]);
    if (!object.drawn) continue;
    const gpu::Chain& chain = scene.chains[object.chain];
    object.pixels = pixels[i];
    object.level = patches ? states[i].tessellation : states[i].lod;
    object.triangles = patches ? std::uint64_t{scene.lods[chain.patchLod].triangleCount} *
                                     scene::tessellatedTriangles(states[i].tessellation)
                               : scene.lods[chain.firstLod + states[i].lod].triangleCount;
  }
}

}  // namespace

ObjectList::ObjectList(ViewState& state, Documents& documents, Redraw& redraw, Messages& messages)
    : state_(state), documents_(documents), redraw_(redraw), messages_(messages) {}

void ObjectList::update() {
  table_.objects.clear();
  table_.names = {};
  ++table_.version;
  Document* document = documents_.current();
  if (document == nullptr || document->sceneFile() == nullptr) return;
  Side* side = document->side(0);
  if (side == nullptr) return;
  const std::vector<asset::Instance>& instances = document->sceneFile()->instances;
  for (std::uint32_t i = 0; i < instances.size(); ++i)
    table_.objects.push_back({.instance = i, .chain = instances[i].chain, .hidden = true});
  table_.names = side->scene().names;
  const RenderOptions& options = state_.configurations[0].active;
  table_.countsPixels = rowOf(options.frameOptions.lvMeasure).countsPixels;
  addFrame(table_, *side, rowOf(options.frameOptions.detail).patches);
  redraw_.interfaceChanged();
}

std::vector<bool> ObjectList::hidden() const {
  const Document* document = documents_.current();
  if (document == nullptr || document->sceneFile() == nullptr) return {};
  std::vector<bool> hidden(document->sceneFile()->instances.size());
  try {
    for (const std::uint32_t i : hiddenObjects(*document->sceneFile(), state_.configurations[0].active))
      hidden[i] = true;
  } catch (const Error&) {
    std::fill(hidden.begin(), hidden.end(), false);  // a list that another file was meant by: replaced
  }
  return hidden;
}

void ObjectList::hide(const std::vector<bool>& hidden) {
  std::vector<std::uint32_t> numbers;
  for (std::uint32_t i = 0; i < hidden.size(); ++i)
    if (hidden[i]) numbers.push_back(i);
  for (Configuration& configuration : state_.configurations) {
    hideObjects(configuration.wanted, numbers, hidden.size());
    configuration.update();
  }
  redraw_.scenesChanged();
}

void ObjectList::toggle(std::uint32_t instance) {
  std::vector<bool> now = hidden();
  if (instance >= now.size()) return;
  now[instance] = !now[instance];
  hide(now);
}

void ObjectList::isolate(std::uint32_t instance) {
  std::vector<bool> now = hidden();
  if (instance >= now.size()) return;
  std::vector<bool> alone(now.size(), true);
  alone[instance] = false;
  if (now == alone) return showAll();
  hide(alone);
}

std::optional<std::uint32_t> ObjectList::selected() const {
  if (state_.selection && state_.selection->document == state_.current) return state_.selection->instance;
  return std::nullopt;
}

void ObjectList::hideSelected() {
  if (const auto instance = selected())
    toggle(*instance);
  else
    messages_.say("No object is selected. Click one, or choose one in the list of objects (L).");
}

void ObjectList::isolateSelected() {
  if (const auto instance = selected())
    isolate(*instance);
  else
    messages_.say("No object is selected. Click one, or choose one in the list of objects (L).");
}

void ObjectList::showAll() {
  hide(std::vector<bool>(hidden().size()));
}

}  // namespace jalousie::app
