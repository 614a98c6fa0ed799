// All objects of the current document with what they cost, and which of them are hidden.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "app/view/documents.h"
#include "app/view/messages.h"
#include "app/view/redraw.h"
#include "app/view/view_state.h"
#include "scene/scene_names.h"

namespace jalousie::app {

/// One object under configuration A.
struct ListedObject {
  std::uint32_t instance = 0;  ///< number in the file
  std::uint32_t chain = 0;
  bool hidden = false;          ///< by --hide or --only
  bool drawn = false;           ///< in the frame that was read
  std::uint32_t level = 0;      ///< where it is drawn; parts of each edge of the patches with tessellation
  std::uint64_t triangles = 0;  ///< of this level; 0 where it is not drawn
  std::uint32_t pixels = 0;     ///< visible at the last count; 0 where they are not counted
};

/// What the window of the list shows.
struct ObjectTable {
  std::vector<ListedObject> objects;  ///< in the order of the file
  scene::SceneNames names;
  bool countsPixels = false;  ///< ListedObject::pixels has a meaning
  std::uint64_t version = 0;  ///< another one after each change
};

/// Reads the list, and hides objects by changing --hide and --only of both configurations.
class ObjectList {
 public:
  /// All arguments must outlive this.
  ObjectList(ViewState& state, Documents& documents, Redraw& redraw, Messages& messages);

  const ObjectTable& table() const { return table_; }
  /// Reads the frame rendered last. Waits for the GPU.
  void update();

  /// Hides or shows one object. @param instance  its number in the file
  void toggle(std::uint32_t instance);
  /// Hides all but one object. Shows all where this is the case already.
  void isolate(std::uint32_t instance);
  void hideSelected();
  void isolateSelected();
  void showAll();

 private:
  /// Hidden objects of the current document, by number; empty where it has no scene.
  std::vector<bool> hidden() const;
  void hide(const std::vector<bool>& hidden);
  std::optional<std::uint32_t> selected() const;

  ViewState& state_;
  Documents& documents_;
  Redraw& redraw_;
  Messages& messages_;
  ObjectTable table_;
};

}  // namespace jalousie::app
