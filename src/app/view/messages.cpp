// Messages carry the time at which they were said, so that the interface can remove them.
#include "app/view/messages.h"

#include <exception>

#include "app/view/clock.h"

namespace jalousie::app {

void Messages::say(const std::string& message) {
  state_.message = message;
  state_.messageSeconds = secondsNow();
  redraw_.interfaceChanged();
}

void Messages::fail(const Error& error) {
  failures_.push_back(error);
  say(error.what());
}

void Messages::attempt(const std::function<void()>& task) {
  try {
    task();
  } catch (const std::exception& error) {
    say(error.what());
  }
}

}  // namespace jalousie::app
