// The report's page: index.html, which holds all figures, pictures and scripts and opens from disk without a network.
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "compare/results.h"

namespace jalousie::compare {

struct Configuration;

/// Most bytes of pictures inside a page. Base64 adds a third, so a page with pictures stays below 20 MB.
inline constexpr std::uint64_t kPictureBytes = 14'000'000;

/// The page as HTML. Kept pictures are encoded as WebP, at the best quality and size that fit into pictureBytes.
/// @param summary  of summaryJson()   @param folder  of the report; the pictures are read from its pictures/
/// Errors: as loadImage.
std::string makePage(const nlohmann::ordered_json& summary, const Results& results,
                     const std::vector<Configuration>& configurations, const std::filesystem::path& folder,
                     std::uint64_t pictureBytes = kPictureBytes);

// Texts that the build embeds (cmake/EmbedPage.cmake). chartsScript() is empty if the build had no charts library.
std::string_view pageHtml();
std::string_view pageStyle();
std::string_view pageScript();
std::string_view chartsScript();

}  // namespace jalousie::compare
