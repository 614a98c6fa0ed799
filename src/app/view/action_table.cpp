// What each action does: one row per action.
#include "app/view/action_table.h"

#include <epoxy/gl.h>
// epoxy must come before GLFW, which otherwise includes the system's OpenGL header.
#include <GLFW/glfw3.h>

#include <algorithm>
#include <cstdint>
#include <iterator>
#include <variant>

#include "app/render_option_table.h"

namespace jalousie::app {
namespace {

void cycle(ViewerParts& parts, const char* option, int step) {
  parts.messages.say(parts.state.configurations[0].cycle(option, step));
  parts.redraw.scenesChanged();
}

/// Changes the frame options of configuration A.
template <class Change>
void changeFrameOptions(ViewerParts& parts, Change change) {
  change(parts.state.configurations[0].wanted.frameOptions);
  parts.state.configurations[0].update();
  parts.redraw.scenesChanged();
}

std::uint32_t coarsestMapLevel() {
  return std::get<CountValue>(renderOption("--map-level").value).most;
}

void toggleLayout(ViewerParts& parts, bool& choice) {
  choice = !choice;
  parts.redraw.scenesChanged();
}

void close(ViewerParts& parts) {
  if (parts.documents.current() == nullptr) return;
  parts.recorder.stop();
  parts.documents.closeCurrent();
  parts.selection.clear();
  parts.pictures.forgetHistory();
}

void screenshot(ViewerParts& parts) {
  parts.outputs.screenshot();
  parts.redraw.scenesChanged();  // the history of the renderers is that of the capture now
}

struct Row {
  Action action;
  void (*perform)(ViewerParts&);
};

using P = ViewerParts;
constexpr Row kRows[] = {
    {Action::kHelp, [](P& p) { p.state.help = !p.state.help; }},
    {Action::kPanel, [](P& p) { p.state.settings.panel = !p.state.settings.panel; }},
    {Action::kGraph, [](P& p) { p.state.settings.graph = !p.state.settings.graph; }},
    {Action::kObjects,
     [](P& p) {
       p.state.settings.objects = !p.state.settings.objects;
       p.redraw.inspectionOutdated();
     }},
    {Action::kReset, [](P& p) { p.documents.resetCameras(); }},
    {Action::kFrame, [](P& p) { p.cameras.frame(); }},
    {Action::kFreeze, [](P& p) { p.cameras.freezeOrThaw(); }},
    {Action::kSplit, [](P& p) { toggleLayout(p, p.state.split); }},
    {Action::kFlicker, [](P& p) { toggleLayout(p, p.state.flicker); }},
    {Action::kNextView, [](P& p) { cycle(p, "--view", 1); }},
    {Action::kPreviousView, [](P& p) { cycle(p, "--view", -1); }},
    {Action::kNextMode, [](P& p) { cycle(p, "--mode", 1); }},
    {Action::kMapCoarser,
     [](P& p) { changeFrameOptions(p, [](auto& o) { o.mapLevel = std::min(o.mapLevel + 1, coarsestMapLevel()); }); }},
    {Action::kMapFiner,
     [](P& p) { changeFrameOptions(p, [](auto& o) { o.mapLevel = std::max(o.mapLevel, 1U) - 1; }); }},
    {Action::kBoxes, [](P& p) { changeFrameOptions(p, [](auto& o) { o.boxes = !o.boxes; }); }},
    {Action::kHide, [](P& p) { p.objects.hideSelected(); }},
    {Action::kIsolate, [](P& p) { p.objects.isolateSelected(); }},
    {Action::kShowAll, [](P& p) { p.objects.showAll(); }},
    {Action::kPlay, [](P& p) { p.player.toggle(); }},
    {Action::kRecord, [](P& p) { p.recorder.toggle(); }},
    {Action::kScreenshot, screenshot},
    {Action::kScreenshotInterface, [](P& p) { p.outputs.requestWindowScreenshot(); }},
    {Action::kSaveFrames, [](P& p) { p.outputs.saveFrames(); }},
    {Action::kNextFrame, [](P& p) { p.player.move(1); }},
    {Action::kPreviousFrame, [](P& p) { p.player.move(-1); }},
    {Action::kCopyCommand, [](P& p) { p.outputs.copyCommand(); }},
    {Action::kDeselect, [](P& p) { p.selection.clear(); }},
    {Action::kClose, close},
    {Action::kQuit, [](P& p) { glfwSetWindowShouldClose(p.window.handle(), GLFW_TRUE); }},
};

constexpr bool followsTheActions() {
  for (std::size_t i = 0; i < std::size(kRows); ++i)
    if (kRows[i].action != static_cast<Action>(i)) return false;
  return std::size(kRows) == kActionCount;
}
static_assert(followsTheActions(), "kRows has one row per action, in the order of Action");

}  // namespace

void perform(Action action, ViewerParts& parts) {
  kRows[static_cast<std::size_t>(action)].perform(parts);
}

}  // namespace jalousie::app
