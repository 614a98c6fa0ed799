// The report's page: index.html with figures, pictures, script and charts inside, so that it opens from disk anywhere.
#pragma once

#include <cstdint>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "compare/experiment.h"

namespace jalousie::compare {

/// Room for the pictures inside a page, before base64 adds a third: with 20 kept frames the page stays below 20 MB.
inline constexpr std::uint64_t kPictureBytes = 14'000'000;

/// @param summary  of summaryJson()   @param folder  of the report; kept pictures are read from its pictures/
/// Pictures are encoded as WebP, at the best quality and size that fit into pictureBytes. Errors: as loadImage.
std::string makePage(const nlohmann::ordered_json& summary, const Results& results,
                     const std::vector<Configuration>& configurations, const std::filesystem::path& folder,
                     std::uint64_t pictureBytes = kPictureBytes);

// Texts that the build embeds. chartsScript() is empty where the charts library was not there.
std::string_view pageHtml();
std::string_view pageStyle();
std::string_view pageScript();
std::string_view chartsScript();

}  // namespace jalousie::compare
