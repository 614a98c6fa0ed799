// Fixture for tests that need an OpenGL context: one context per program, debug output of medium or high severity
// fails.
#pragma once

#include <gtest/gtest.h>

#include <memory>
#include <optional>
#include <string>

#include "core/error.h"
#include "gl/debug_log.h"
#include "platform/headless_context.h"

namespace jalousie::test {

/// The program's context; null with a reason where the machine has no driver.
struct SharedContext {
  std::unique_ptr<platform::HeadlessContext> context;
  std::string reason;

  static SharedContext& get() {
    static SharedContext shared = make();
    return shared;
  }

 private:
  static SharedContext make() {
    SharedContext shared;
    try {
      shared.context = std::make_unique<platform::HeadlessContext>(/*debug=*/true);
    } catch (const Error& error) {
      shared.reason = error.what();
    }
    return shared;
  }
};

class GlTest : public testing::Test {
 protected:
  void SetUp() override {
    SharedContext& shared = SharedContext::get();
    if (shared.context == nullptr) GTEST_SKIP() << "no OpenGL here: " << shared.reason;
    log_.emplace();
  }

  void TearDown() override {
    if (!log_) return;
    glFinish();
    for (const std::string& problem : log_->problems())
      ADD_FAILURE() << "OpenGL debug output: " << problem;
  }

 private:
  std::optional<gl::DebugLog> log_;
};

}  // namespace jalousie::test
