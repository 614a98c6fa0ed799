// What a bake left out or could not read: one line for each kind.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace jalousie::bake {

/// Collects what is to be said, in the order of the first of each kind.
class Notes {
 public:
  /// @param kind  what happened, as "a picture is missing"   @param example  what it happened to
  void add(const std::string& kind, const std::string& example);
  /// "a picture is missing: wood.png and 2 more".
  std::vector<std::string> lines() const;

 private:
  struct Kind {
    std::string text;
    std::string example;
    std::size_t count = 0;
  };
  std::vector<Kind> kinds_;
};

}  // namespace jalousie::bake
