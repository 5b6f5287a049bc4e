#pragma once

#include <map>
#include <string>

#include "results/record/row_difference.h"
#include "results/record/run_reader.h"

namespace results::record {

/// Rows of the tables frames, frame_ends and arrivals of one run, for people.
class RowWords {
 public:
  /// @param run  outlives this object.
  explicit RowWords(RunReader& run);

  /// "m3"; "everyone" and "neighbours" for group addresses.
  std::string name(const std::string& agent) const;

  /// Who: "m3 to r0"; of an end "m3 to r0, at m5"; of a packet "r0 to r1".
  std::string stations(const Row& row);
  /// Of the frame's contents: "IPv4 UDP 40000 > 5000", "forward ant", "ack".
  std::string protocol(const Row& row);
  /// What else the row has: "unicast, sequence 17, 1234 bit at 2 Mb/s, lasts 300000 ns".
  std::string contents(const Row& row);
  /// One value of the row, agents by their names; "none" for null.
  std::string value(const Row& row, const Column& column) const;

 private:
  std::string stations_of_arrival(const Row& arrival) const;
  /// The row of frames that a row of frame_ends refers to.
  std::optional<Row> frame_of(const Row& end);

  RunReader& run_;
  std::map<std::string, std::string> names_;  ///< By address.
};

/// The columns in which two rows of a table differ, with both values: "sequence 17 | 18, retry 0 |
/// 1", "bytes of the payload (record.air records them)". Of bytes that are recorded: "byte 42 (UDP
/// payload, byte 0) of 106: 78 | 79" in hexadecimal, or "length 106 | 110 bytes"; after a byte of a
/// header, such as its checksum, also the first one of what is in the packet.
std::string differing_values(const RowWords& one, const Row& first, const RowWords& other,
                             const Row& second);

}  // namespace results::record
