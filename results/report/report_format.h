#pragma once

#include <fmt/format.h>

#include <optional>
#include <string>

namespace results::report {

/// Writes numbers as they appear in a report.

inline std::string number(double value, int decimals) {
  return fmt::format("{:.{}f}", value, decimals);
}

/// As above; none is written "-".
template <class T>
std::string number(const std::optional<T>& value, int decimals) {
  return value ? number(static_cast<double>(*value), decimals) : "-";
}

inline std::string milliseconds(double seconds) { return number(seconds * 1e3, 3); }

}  // namespace results::report
