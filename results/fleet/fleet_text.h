#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "results/fleet/fleet_answer.h"
#include "results/fleet/fleet_file.h"

namespace results::fleet {

/// "6", "fewer than 2" (not even the least number), "at least 12" (every number that was tried).
std::string largest_text(const FleetLine& line);

/// The answer as sentences: for each radio and site, the number of robots with the best profile,
/// what breaks first and why, and what the runner-up loses.
std::vector<std::string> sentences(const FleetFile& fleet, const std::vector<FleetLine>& lines);

/// The head and the rows of a table.
struct Cells {
  std::vector<std::string> head;
  std::vector<std::vector<std::string>> rows;
};

/// Largest numbers and what breaks first, one row for each line.
Cells summary_cells(const FleetFile& fleet, const std::vector<FleetLine>& lines);

/// Whether means have their intervals beside them.
enum class Intervals : std::uint8_t { kNone, kShown };

/// One line: a row for each number of robots and topic group.
Cells topic_cells(const FleetLine& line, Intervals intervals);

/// One line: shares of the time on the air, a row for each use, a column for each number.
Cells air_cells(const FleetLine& line, Intervals intervals);

/// All of it in plain text, for a terminal.
std::string fleet_text(const FleetFile& fleet, const std::vector<FleetLine>& lines);

/// The text of a profile's file; "" if it has none.
std::string xml_of(const Variant& profile);

}  // namespace results::fleet
