#pragma once

#include <optional>
#include <string>

namespace view::server {

/// The page of the view, and the message for the case that it does not exist.
inline constexpr const char* kPage = "view_page.html";
inline constexpr const char* kNoPage =
    "the page was not built, only its data are served: ./setup pages";

/// Finds a page that npm has bundled; the data that it shows are not part of it. It is beside this
/// program if it was built, or in the installation folder.
/// @param name  "view_page.html". @return none if it does not exist.
std::optional<std::string> find_page(const std::string& name);

/// Like find_page(), but requires the page. @param advice  how to build it, and what works without
/// it.
/// @throws std::runtime_error  it does not exist; the message has the searched places and the
/// advice.
std::string bundled_page(const std::string& name, const std::string& advice);

}  // namespace view::server
