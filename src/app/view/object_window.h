// The window of the list of objects.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "app/view/actions.h"

namespace jalousie::app {

struct ObjectTable;
struct Selection;

/// What the user asked for in this frame of the window. Objects are meant by their numbers in the file.
struct ObjectWindowResult {
  std::optional<std::uint32_t> select;
  std::optional<std::uint32_t> toggle;  ///< hide it, or show it again
  std::optional<std::uint32_t> isolate;
  bool frame = false;           ///< fit the view to the object that is selected
  std::vector<Action> actions;  ///< buttons that were pressed
};

inline constexpr std::uint32_t kTrianglesColumn = 4;

/// Search, order and the rows that follow from them, kept from frame to frame.
struct ObjectRows {
  std::uint64_t version = 0;  ///< of the table that the order is of
  std::string search;
  std::uint32_t column = kTrianglesColumn;
  bool descending = true;
  std::vector<std::uint32_t> order;  ///< indices into ObjectTable::objects
};

/// Draws the list, the most expensive object first until the user sorts by another column.
/// @param open  set to false where the user closes the window
ObjectWindowResult drawObjects(const ObjectTable& table, const std::optional<Selection>& selection, ObjectRows& rows,
                               bool* open);

}  // namespace jalousie::app
