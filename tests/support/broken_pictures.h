// Pictures that must be refused, each with its code and a part of the reason.
#pragma once

#include <string>
#include <vector>

#include "core/error.h"

namespace jalousie::test {

struct BrokenPicture {
  std::string name;
  std::string bytes;
  ErrorCode code;
  std::string reason;  ///< a part of the message
};

/// One of each kind of damage.
std::vector<BrokenPicture> brokenPictures();
/// JPEG, PNG and WebP cut off at every marker or chunk and at random places.
std::vector<BrokenPicture> cutPictures();

/// A file that must be read, although parts of it are odd or broken that no pixel depends on.
struct OddPicture {
  std::string name;
  std::string bytes;
};
std::vector<OddPicture> oddPictures();

}  // namespace jalousie::test
