// The code a failure carries: tests assert on it, never on the text.
#pragma once

#include <optional>

#include "core/error.h"

namespace jalousie::test {

/// Code of the Error a call throws; nullopt if it returns.
template <class Call>
std::optional<ErrorCode> codeOf(const Call& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.code();
  }
  return std::nullopt;
}

}  // namespace jalousie::test
