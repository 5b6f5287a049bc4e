#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <memory>
#include <vector>

#include "hal/types/time.h"
#include "sim/air/datagram.h"
#include "sim/air/rtps_reader.h"
#include "sim/radio/mac/mac_sap.h"

namespace sim::air {

/// A contiguous part of a frame's contents, of one kind.
struct Piece {
  AirKind kind;
  EndpointIndex writer = 0;
  std::uint32_t octets = 1;  ///< Weight of this piece; headers are divided in the same ratio.
  bool begins = true;        ///< Its first octet is in this frame.
};

/// Contents of a frame.
struct Content {
  std::vector<Piece> pieces;  ///< At least one.
  DatagramPlace place{};
  /// A-MSDU: contents of its MSDUs; `pieces` are those of all of them, and there is no place.
  std::vector<std::shared_ptr<const Content>> msdus{};

  /// Index of the piece as which the frame is counted: the largest; ties go to the first.
  std::size_t main() const;
};

using ContentPtr = std::shared_ptr<const Content>;

/// Reads each payload once, however often and by whichever station it is transmitted. Results are
/// kept as long as the payload is held elsewhere.
class Contents {
 public:
  explicit Contents(Endpoints& endpoints) : reader_(endpoints) {}

  /// Content of a payload, and what a first reading found.
  struct Read {
    ContentPtr content;
    std::size_t first_new_part = 0;  ///< Index of the first new part in the datagram.
    bool is_new = false;
  };
  /// @param source  original source of the payload.
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
