#pragma once

#include <optional>
#include <string>

namespace view::server {

/// The page of the view, and what to say where it is not.
inline constexpr const char* kPage = "view_page.html";
inline constexpr const char* kNoPage =
    "the page was not built, only its data are served: ./setup pages";

/// A page that npm has bundled, still without what it shows. It lies beside this program, if it was
/// built, or where it was installed.
/// @param name  "view_page.html". @return none: it is not there.
std::optional<std::string> find_page(const std::string& name);

/// The same. @param advice  on what makes it, and what can be done without it.
/// @throws std::runtime_error  it is not there; says where it was looked for, and the advice.
std::string bundled_page(const std::string& name, const std::string& advice);

}  // namespace view::server
