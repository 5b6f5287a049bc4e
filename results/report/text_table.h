#pragma once

#include <string>
#include <vector>

namespace results::report {

/// A table in plain text: the first column left-aligned, the others right-aligned.
class TextTable {
 public:
  explicit TextTable(std::vector<std::string> head) { add_row(std::move(head)); }
  TextTable() = default;

  /// Cells become printable: their text may be a controller's.
  void add_row(std::vector<std::string> cells);

  /// One line per row, each ending with a line feed and without blanks before it.
  std::string text() const;

 private:
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace results::report
