#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "hal/types/result.h"

namespace hal::files::config {

/// Reads one value as written in a file: "15 s", "-45 deg", "11 Mb/s", "0.6". The number is
/// decimal; the unit is required, must have the dimension of `unit`, and is converted.
///
///   parse_value("250 ms", "s", 0, 10)  ->  0.25
///
/// @param unit  unit of the result and of the limits. "1": a plain number without unit. Powers
///   convert between W, mW and dBm. See units.cpp for the list.
/// @param low, high  inclusive limits in `unit`. If `high` is infinite, "never" and "none" are
///   accepted and give infinity; otherwise the result is finite.
/// @return the value in `unit`; kInvalidArgument with what is wrong, without place or key.
/// @pre `unit` is in that list.
Result<double> parse_value(std::string_view text, std::string_view unit, double low, double high);

/// The value in a form that parse_value() reads back to the same bits: "0.25 s", "never", "3".
std::string format_value(double value, std::string_view unit);

/// The same for display, in the most readable unit of the dimension: "100 ms", "30 deg".
std::string readable(double value, std::string_view unit);

/// A number as written in a file, with its unit.
struct WrittenNumber {
  double number = 0;
  std::string unit;  ///< "1": a plain number.
};

/// Reads a number with any unit of the list, or without one: "15 cm" is 15 and "cm".
/// @return nullopt: the text is neither. Nothing is ignored: "15 cm x" is neither.
std::optional<WrittenNumber> written_number(std::string_view text);

/// The SI unit of the same dimension: "m" for "cm", "W" for "dBm". @pre is_unit(unit)
std::string_view base_unit(std::string_view unit);

/// Whether parse_value() knows the unit.
bool is_unit(std::string_view unit);

}  // namespace hal::files::config
