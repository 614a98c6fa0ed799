// std::visit with one callable per alternative.
#pragma once

namespace jalousie {

/// A callable made of several: std::visit(Overloaded{[](int) {...}, [](float) {...}}, variant).
template <class... Calls>
struct Overloaded : Calls... {
  using Calls::operator()...;
};

}  // namespace jalousie
