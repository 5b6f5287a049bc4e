#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hal/types/agent_id.h"
#include "hal/types/message.h"
#include "hal/types/time.h"
#include "sim/radio/mac_sap.h"
#include "sim/radio/phy_mode.h"

namespace sim::radio {

// Bodies of management frames (IEEE Std 802.11-2016, 9.3.3 and 9.4), as values and as bytes. What
// the decoders do not know they skip; they give nothing if what must be there is not, or is cut.

/// What the stations of a BSS have in common, as its frames say it.
struct BssParameters {
  std::string ssid;
  std::vector<std::uint8_t> rates;        ///< In 500 kb/s, basic ones with bit 7 set; ascending.
  std::optional<std::uint8_t> channel{};  ///< Of 2.4 GHz, 1 .. 14.
  bool short_preamble = false;
  bool short_slot = false;
  bool erp = false;             ///< Beacons carry the ERP element (9.4.2.12) …
  bool use_protection = false;  ///< … which says whether there are stations without ERP.
  bool operator==(const BssParameters&) const = default;
};

struct Beacon {
  hal::Time timestamp{};  ///< Of the TSF; whole microseconds.
  hal::Duration interval{};
  BssParameters bss;
};

/// Open system (9.4.1.1: algorithm 0).
struct Authentication {
  std::uint16_t transaction = 1;  ///< 1: request, 2: answer.
  std::uint16_t status = 0;       ///< 0: successful.
};

struct AssociationRequest {
  BssParameters bss;
  std::optional<hal::AgentId> current_access_point{};  ///< Of a reassociation.
};

struct AssociationResponse {
  BssParameters bss;
  std::uint16_t status = 0;
  std::uint16_t association_id = 0;  ///< 1 .. 2007 if successful.
};

/// 9.4.1.9 and 9.4.1.7.
inline constexpr std::uint16_t kStatusSuccess = 0;
inline constexpr std::uint16_t kStatusTooManyStations = 17;
inline constexpr std::uint16_t kReasonNotAuthenticated = 6;  ///< Class 2 frame.
inline constexpr std::uint16_t kReasonNotAssociated = 7;     ///< Class 3 frame.
inline constexpr std::uint16_t kMaxAssociationId = 2007;     ///< 9.4.1.8.

hal::Bytes encode(const Beacon& beacon);
hal::Bytes encode(const Authentication& authentication);
hal::Bytes encode(const AssociationRequest& request);
hal::Bytes encode(const AssociationResponse& response);
/// Of a disassociation or deauthentication.
hal::Bytes encode_reason(std::uint16_t reason);

using Body = std::span<const std::uint8_t>;
std::optional<Beacon> decode_beacon(Body body);
std::optional<Authentication> decode_authentication(Body body);
/// @param again  whether it is one of reassociation.
std::optional<AssociationRequest> decode_association_request(Body body, bool again);
std::optional<AssociationResponse> decode_association_response(Body body);
std::optional<std::uint16_t> decode_reason(Body body);

/// The body of a beacon that starts at `at` and is sent so: the timestamp is the time at which its
/// own first bit goes out (11.1.3.1).
Payload with_timestamp(const hal::Bytes& beacon, hal::Time at, const PhyMode& mode);

}  // namespace sim::radio
