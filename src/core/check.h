// JAL_CHECK: the programmer failed. Prints both operands and aborts; on in release builds.
#pragma once

#include <fmt/format.h>

#include <string>

namespace jalousie::detail {

/// Outcome of one checked comparison; `operands` is filled only on failure.
struct CheckResult {
  bool passed;
  std::string operands;
};

[[noreturn]] void checkFailed(const char* expression, const char* file, int line, const CheckResult& result);

/// Holds the left operand of a comparison so that the right one can be printed beside it.
template <class Left>
struct CheckLeft {
  const Left& left;

  template <class Right>
  CheckResult operator==(const Right& right) const {
    return result(left == right, "==", right);
  }
  template <class Right>
  CheckResult operator!=(const Right& right) const {
    return result(left != right, "!=", right);
  }
  template <class Right>
  CheckResult operator<(const Right& right) const {
    return result(left < right, "<", right);
  }
  template <class Right>
  CheckResult operator<=(const Right& right) const {
    return result(left <= right, "<=", right);
  }
  template <class Right>
  CheckResult operator>(const Right& right) const {
    return result(left > right, ">", right);
  }
  template <class Right>
  CheckResult operator>=(const Right& right) const {
    return result(left >= right, ">=", right);
  }
  operator CheckResult() const { return {static_cast<bool>(left), {}}; }

 private:
  template <class Right>
  CheckResult result(bool passed, const char* op, const Right& right) const {
    return {passed, passed ? std::string() : fmt::format("{} {} {}", left, op, right)};
  }

 public:
  explicit CheckLeft(const Left& value) : left(value) {}
};

struct CheckDecomposer {
  template <class Left>
  CheckLeft<Left> operator<<(const Left& left) const {
    return CheckLeft<Left>(left);
  }
};

}  // namespace jalousie::detail

/// Aborts with both values printed unless the condition holds: `JAL_CHECK(index < size)`. One comparison each.
#define JAL_CHECK(...)                                                                                         \
  do {                                                                                                         \
    if (const ::jalousie::detail::CheckResult jalCheck = ::jalousie::detail::CheckDecomposer{} << __VA_ARGS__; \
        !jalCheck.passed)                                                                                      \
      ::jalousie::detail::checkFailed(#__VA_ARGS__, __FILE__, __LINE__, jalCheck);                             \
  } while (false)
