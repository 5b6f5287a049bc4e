#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <vector>

#include "hal/types/time.h"
#include "sim/air/datagram.h"
#include "sim/air/rtps_reader.h"
#include "sim/radio/mac_sap.h"

namespace sim::air {

/// A contiguous part of a frame's contents of one kind.
struct Piece {
  AirKind kind;
  EndpointIndex writer = 0;
  std::uint32_t octets = 1;  ///< By which the frame is shared out; headers go with them.
  bool begins = true;        ///< Its first octet is in this frame.
};

/// Contents of a frame.
struct Content {
  std::vector<Piece> pieces;  ///< At least one.
  DatagramPlace place{};

  /// The part of the frame that it is counted as: the largest, of equals the first.
  std::size_t main() const;
};

using ContentPtr = std::shared_ptr<const Content>;

/// Reads each payload once, however often and by whom it is then transmitted: what was read is kept
/// as long as somebody holds the payload.
class Contents {
 public:
  explicit Contents(Endpoints& endpoints) : reader_(endpoints) {}

  /// What is new in a payload that was not read before.
  struct Read {
    ContentPtr content;
    std::size_t first_new_part = 0;  ///< Of its datagram.
    bool is_new = false;
  };
  /// @param source  who sends it first.
  Read read(hal::Time at, hal::AgentId source, radio::Ethertype type,
            const radio::Payload& payload);

  std::size_t kept() const { return contents_.size(); }

 private:
  using Map = std::map<radio::Payload, ContentPtr, std::owner_less<radio::Payload>>;

  Read look_into(hal::Time at, hal::AgentId source, radio::Ethertype type, Octets payload);
  Read look_into(hal::Time at, hal::AgentId source, const IpPacket& packet);
  void forget();

  RtpsReader reader_;
  Datagrams datagrams_;
  Map contents_;
  std::deque<Map::iterator> order_;
};

}  // namespace sim::air
