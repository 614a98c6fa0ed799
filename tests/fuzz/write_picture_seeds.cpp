// picture_seeds OUT: small pictures of every kind, and broken ones, as seeds for the fuzzer.
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "support/broken_pictures.h"
#include "support/picture_writer.h"

namespace {

using namespace jalousie::test;

constexpr std::size_t kMaxBytes = 4096;

void save(const std::filesystem::path& file, const std::string& bytes) {
  if (bytes.size() <= kMaxBytes)
    std::ofstream(file, std::ios::binary).write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
}

void saveAll(const std::filesystem::path& folder) {
  for (const unsigned depth : {1U, 2U, 4U, 8U, 16U})
    for (const unsigned type : {0U, 2U, 3U, 4U, 6U})
      for (const bool interlaced : {false, true}) {
        const bool valid = type == 0 || (type == 3 ? depth <= 8 : depth >= 8);
        const std::string name = "png-" + std::to_string(type) + "-" + std::to_string(depth) + (interlaced ? "i" : "");
        const std::string palette = type == 3 ? pngChunk("PLTE", std::string(3U << depth, '\7')) : std::string();
        if (valid)
          save(folder / name,
               pngFile({.depth = depth, .colourType = type, .interlaced = interlaced, .before = palette}));
      }
  for (int colours = 0; colours < 5; ++colours)
    for (const bool progressive : {false, true})
      save(folder / ("jpeg-" + std::to_string(colours) + (progressive ? "p" : "")),
           jpegFile({.colours = static_cast<JpegColours>(colours), .progressive = progressive}));
  save(folder / "webp-lossless", webpFile(noisePicture(16, 16), true));
  save(folder / "webp-lossy", webpFile(noisePicture(16, 16), false));
  save(folder / "webp-animation", webpAnimation());
  for (const BrokenPicture& picture : brokenPictures())
    save(folder / picture.name, picture.bytes);
  for (const OddPicture& picture : oddPictures())
    save(folder / picture.name, picture.bytes);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("usage: picture_seeds OUT\n", stderr);
    return 2;
  }
  std::filesystem::create_directories(argv[1]);
  saveAll(argv[1]);
  return 0;
}
