#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "hal/types/time.h"

namespace hal::files::config {

/// Writes YAML that Document::load() reads back to the same values: doubles in the shortest form
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

  void open(std::string_view key);       ///< Begins a mapping.
  void open_list(std::string_view key);  ///< Begins a list of mappings.
  void open_item();                      ///< Begins a mapping in a list.
  void close();                          ///< Ends what was opened last.

  /// @pre everything is closed.
  std::string take();

  /// Every value written so far by its dotted path, with list items by index from 0:
  /// "radio.range" and "250 m", "walls.0.name" and "w0".
  const std::vector<std::pair<std::string, std::string>>& values() const { return values_; }

 private:
  enum class Kind { kMapping, kList, kItem };
  struct Level {
    Kind kind;
    std::string path;  ///< Ends in a dot.
    int items = 0;     ///< Number so far, in a list.
  };

  void line(std::string_view key, std::string_view value);
  void open(std::string_view key, Kind kind);
  std::string path() const { return open_.empty() ? "" : open_.back().path; }
  std::string indent();

  std::string out_;
  std::vector<std::pair<std::string, std::string>> values_;
  std::vector<Level> open_;
  bool empty_ = true;         ///< Nothing was written since the last open.
  bool starts_item_ = false;  ///< The next line begins with the item's dash.
};

/// "10 ms": the largest of s, ms, us, ns that gives a whole number.
std::string format_duration(Duration value);

}  // namespace hal::files::config
