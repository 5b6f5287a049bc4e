#pragma once

#include <string>
#include <vector>

namespace results::report {

/// A table in plain text: the first column left-aligned, the others right-aligned.
class TextTable {
 public:
  explicit TextTable(std::vector<std::string> head) { add_row(std::move(head)); }
  TextTable() = default;

  /// Cells are made printable, because their text may come from a controller.
  void add_row(std::vector<std::string> cells);

  /// One line per row; each ends with a line feed and has no trailing blanks.
  std::string text() const;

 private:
  std::vector<std::vector<std::string>> rows_;
};

}  // namespace results::report
