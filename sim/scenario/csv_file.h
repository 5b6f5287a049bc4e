#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "sim/scenario/fields.h"

namespace sim::scenario {

/// A value of a CSV file, and where it is, for messages: "links.csv:7:12", or "row 7" of a key.
struct CsvCell {
  std::string text;
  std::string place;
};

/// The rows of a CSV file: values without spaces around them. Lines that are empty or begin with #
/// are left out. The first line is the header.
struct CsvTable {
  std::vector<std::string> header;
  std::vector<std::vector<CsvCell>> rows;  ///< Each with as many cells as the header has.
};

/// The table of a file. Notes at `key` what is wrong: no such file, above 4 MB, no rows, or rows
/// with another number of cells, which are left out.
CsvTable read_csv(const std::filesystem::path& file, const std::string& key, Mapping& in);

/// The rows of a key, as from a file with this header.
CsvTable csv_of(const Key& key, std::string_view header, Mapping& in);

/// nullopt, and a note at `key`: not a number from `low` to `high`. @param column  its name.
std::optional<double> csv_number(const CsvCell& cell, std::string_view column, Range range,
                                 const std::string& key, Mapping& in);

}  // namespace sim::scenario
