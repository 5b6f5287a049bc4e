#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "hal/types/time.h"

namespace hal::config {

/// Writes YAML that Document::load() reads back to the same values: doubles in their shortest form
/// that parses to the same bits, times in whole units.
///
///   Writer out;
///   out.open("radio");
///   out.number("range", 250, "m");
///   out.close();
///   out.open_list("walls");
///   out.open_item();
///   out.text("name", "w0");
///   out.close();  // the item
///   out.close();  // the list
///   out.take();
class Writer {
 public:
  void number(std::string_view key, double value, std::string_view unit);
  void integer(std::string_view key, std::int64_t value);
  void duration(std::string_view key, Duration value);
  void flag(std::string_view key, bool value);
  void text(std::string_view key, std::string_view value);
  /// [1 m, 2 m]
  void numbers(std::string_view key, const std::vector<double>& values, std::string_view unit);
  void texts(std::string_view key, const std::vector<std::string>& values);

  void open(std::string_view key);       ///< A mapping.
  void open_list(std::string_view key);  ///< A list of mappings.
  void open_item();                      ///< A mapping in a list.
  void close();                          ///< What was opened last.

  /// @pre everything is closed.
  std::string take();

 private:
  enum class Level { kMapping, kList, kItem };

  void line(std::string_view key, std::string_view value);
  std::string indent();

  std::string out_;
  std::vector<Level> open_;
  bool empty_ = true;         ///< Nothing was written into what was opened last.
  bool starts_item_ = false;  ///< The next line carries the item's dash.
};

/// "10 ms": the largest of s, ms, us, ns that gives a whole number.
std::string format_duration(Duration value);

}  // namespace hal::config
