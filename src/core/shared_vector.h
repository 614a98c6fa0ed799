// A vector whose copies share their elements until one of them is edited.
#pragma once

#include <cstddef>
#include <initializer_list>
#include <memory>
#include <utility>
#include <vector>

namespace jalousie {

/// Elements are read in place; edit() makes them this vector's own first. Copies cost no memory. Not for threads that
/// edit copies of one vector at the same time.
template <class T>
class SharedVector {
 public:
  SharedVector() = default;
  SharedVector(std::vector<T> elements)  // NOLINT(google-explicit-constructor): stands for a vector
      : elements_(std::make_shared<std::vector<T>>(std::move(elements))) {}
  SharedVector(std::initializer_list<T> elements) : SharedVector(std::vector<T>(elements)) {}

  /// The elements.
  const std::vector<T>& get() const {
    static const std::vector<T> kEmpty;
    return elements_ != nullptr ? *elements_ : kEmpty;
  }
  operator const std::vector<T>&() const { return get(); }  // NOLINT(google-explicit-constructor)

  /// The elements to change; copied first where another vector shares them.
  std::vector<T>& edit() {
    if (elements_ == nullptr) {
      elements_ = std::make_shared<std::vector<T>>();
    } else if (elements_.use_count() > 1) {
      elements_ = std::make_shared<std::vector<T>>(*elements_);
    }
    return *elements_;
  }

  bool empty() const { return get().empty(); }
  std::size_t size() const { return get().size(); }
  const T& operator[](std::size_t index) const { return get()[index]; }
  const T& back() const { return get().back(); }
  auto begin() const { return get().begin(); }
  auto end() const { return get().end(); }
  friend bool operator==(const SharedVector& a, const SharedVector& b) { return a.get() == b.get(); }
  friend bool operator==(const SharedVector& a, const std::vector<T>& b) { return a.get() == b; }

 private:
  std::shared_ptr<std::vector<T>> elements_;
};

}  // namespace jalousie
