// What all tables of the policy share: rows lie in the order of their ids.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

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

/// The id of a name. @pre the name is in the table (checked)
template <class Row>
auto idOf(std::span<const Row> rows, std::string_view name) {
  for (const Row& row : rows)
    if (name == row.name) return row.id;
  JAL_CHECK(rows.empty());
  return rows.front().id;
}

/// Names in the order of the ids.
template <class Row>
std::vector<std::string> namesOf(std::span<const Row> rows) {
  std::vector<std::string> names;
  for (const Row& row : rows)
    names.emplace_back(row.name);
  return names;
}

/// "NAME = help; NAME = help": one help text for all rows.
template <class Row>
std::string helpOf(std::span<const Row> rows) {
  std::string text;
  for (const Row& row : rows)
    text += (text.empty() ? "" : "; ") + std::string(row.name) + " = " + row.help;
  return text;
}

/// "a, b or c": the names of the rows that have a property.
template <class Row>
std::string namesWith(std::span<const Row> rows, bool Row::*property) {
  std::vector<std::string> names;
  for (const Row& row : rows)
    if (row.*property) names.emplace_back(row.name);
  std::string text;
  for (std::size_t i = 0; i < names.size(); ++i)
    text += (i == 0 ? "" : i + 1 == names.size() ? " or " : ", ") + names[i];
  return text;
}

}  // namespace jalousie::policy
