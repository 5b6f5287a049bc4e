#pragma once

#include <string>
#include <string_view>

namespace hal {

/// Text of any origin (a controller, another process, a file), made safe for a terminal or a log:
/// one line without control characters. Line feeds become \n; other control characters (C0 except
/// the tab, DEL, C1) and bytes that are not UTF-8 become \xNN. Everything else is unchanged.
std::string printable(std::string_view text);

/// The same for texts of several lines: line feeds are kept.
std::string printable_lines(std::string_view text);

}  // namespace hal
