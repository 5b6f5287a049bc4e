#pragma once

#include <string>
#include <string_view>

namespace hal {

/// Text from elsewhere (a controller, another process, a file) as it may go to a terminal or into
/// a log: one line that can move no cursor. Line feeds become \n; other control characters (C0 but
/// for the tab, DEL, C1) and bytes that are not UTF-8 become \xNN. All else stays as it is.
std::string printable(std::string_view text);

/// The same, line feeds left: for texts of several lines.
std::string printable_lines(std::string_view text);

}  // namespace hal
