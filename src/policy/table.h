// What all tables of the policy share: rows lie in the order of their ids.
#pragma once

#include <cstddef>
#include <span>

#include "core/check.h"

namespace jalousie::policy {

/// Whether row i has the id i, for static_assert beside a table.
template <class Row, std::size_t kCount>
constexpr bool isInOrder(const Row (&rows)[kCount]) {
  for (std::size_t i = 0; i < kCount; ++i)
    if (static_cast<std::size_t>(rows[i].id) != i) return false;
  return true;
}

/// The row of an id. @pre id is one of the table's (checked)
template <class Row, class Id>
const Row& row(std::span<const Row> rows, Id id) {
  const auto index = static_cast<std::size_t>(id);
  JAL_CHECK(index < rows.size());
  return rows[index];
}

}  // namespace jalousie::policy
