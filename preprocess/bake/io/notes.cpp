// Counts by kind.
#include "bake/io/notes.h"

#include <fmt/format.h>

#include <algorithm>

#include "core/error.h"

namespace jalousie::bake {

void Notes::add(const std::string& kind, const std::string& example) {
  auto found = std::find_if(kinds_.begin(), kinds_.end(), [&](const Kind& known) { return known.text == kind; });
  if (found == kinds_.end()) found = kinds_.insert(kinds_.end(), Kind{kind, oneLine(example), 0});
  ++found->count;
}

std::vector<std::string> Notes::lines() const {
  std::vector<std::string> lines;
  for (const Kind& kind : kinds_)
    lines.push_back(fmt::format("{}: {}{}", kind.text, kind.example,
                                kind.count > 1 ? fmt::format(" and {} more", kind.count - 1) : ""));
  return lines;
}

}  // namespace jalousie::bake
