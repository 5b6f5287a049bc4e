#pragma once

#include <filesystem>
#include <functional>
#include <string_view>

namespace results::report {

/// Writes the received power of every frame of a run as the law `measured` reads it: from, to,
/// time_s to 1 us and rssi_dbm to 0.001 dB, in order of time. Frames that no radio was synchronised
/// to are in it if they were sensed. MPDUs of one A-MPDU are one row.
/// @param write  receives the text piece by piece.
/// @throws std::runtime_error  the folder has no result of this version, or no frame of it was
/// recorded with its power (record: {frames: all}).
void write_link_trace(const std::filesystem::path& folder,
                      const std::function<void(std::string_view)>& write);

}  // namespace results::report
