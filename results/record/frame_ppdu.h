#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "results/record/schema.h"
#include "sim/radio/mac/frame.h"

namespace results::record {

/// What the table frames tells of the PPDU of a frame, and of its place in the Block Ack and in the
/// queues. A member that does not apply to the frame is null.
struct FramePpdu {
  explicit FramePpdu(const sim::radio::Frame& frame);

  std::optional<std::string_view> modulation{};
  std::optional<int> mcs{}, streams{}, width_mhz{};
  std::optional<std::int64_t> guard_ns{};
  std::optional<int> tid{};
  std::optional<std::string_view> category{};
  int msdus = 0;
  std::optional<std::string> block_ack{};

  /// The columns in this order, behind the number and the airtime of the A-MPDU.
  static std::vector<Column> columns();
};

}  // namespace results::record
