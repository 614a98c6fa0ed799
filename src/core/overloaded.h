// std::visit with one callable per alternative.
#pragma once

namespace jalousie {

/// A callable made of several: std::visit(Overloaded{[](int) {...}, [](float) {...}}, variant).
template <class... Calls>
struct Overloaded : Calls... {
  using Calls::operator()...;
};

/// clang 14 needs the guide that C++20 deduces by itself.
template <class... Calls>
Overloaded(Calls...) -> Overloaded<Calls...>;

}  // namespace jalousie
