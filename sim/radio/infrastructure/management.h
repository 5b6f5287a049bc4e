#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "hal/types/agent_id.h"
#include "hal/types/message.h"
#include "hal/types/time.h"
#include "sim/radio/mac/edca_config.h"
#include "sim/radio/mac/ht_protection.h"
#include "sim/radio/mac/mac_sap.h"
#include "sim/radio/phy/capabilities.h"
#include "sim/radio/phy/phy_mode.h"

namespace sim::radio {

// Bodies of management frames (IEEE Std 802.11-2016, 9.3.3 and 9.4), as values and as bytes. The
// decoders skip unknown elements; they return nullopt if a mandatory element is missing or
// truncated.

/// The parameters that the stations of a BSS share, as carried in its frames.
struct BssParameters {
  std::string ssid;
  std::vector<std::uint8_t> rates;        ///< In 500 kb/s, ascending; basic rates have bit 7 set.
  std::optional<std::uint8_t> channel{};  ///< In 2.4 GHz, 1 .. 14.
  bool short_preamble = false;
  bool short_slot = false;
  bool erp = false;                  ///< Beacons carry the ERP element (9.4.2.12).
  bool use_protection = false;       ///< ERP element: there are NonERP stations.
  bool qos = false;                  ///< QoS station.
  std::optional<EdcaConfig> edca{};  ///< In beacons and responses of QoS access points.
  /// Of the sender, if it has MCSs; the width of stations in 80 MHz only in beacons and responses
  /// (capability_elements.h).
  std::optional<Capabilities> capabilities{};
  std::uint8_t primary_channel = 0;  ///< For the operation elements.
  HtOperation ht_operation{};        ///< Of an access point that knows HT.
  bool operator==(const BssParameters&) const = default;
};

struct Beacon {
  hal::Time timestamp{};  ///< TSF timer, in whole microseconds.
  hal::Duration interval{};
  BssParameters bss;
};

/// Open System authentication (9.4.1.1: algorithm 0).
struct Authentication {
  std::uint16_t transaction = 1;  ///< 1: request, 2: response.
  std::uint16_t status = 0;       ///< 0: successful.
};

struct AssociationRequest {
  BssParameters bss;
  std::optional<hal::AgentId> current_access_point{};  ///< Reassociation only.
};

struct AssociationResponse {
  BssParameters bss;
  std::uint16_t status = 0;
  std::uint16_t association_id = 0;  ///< 1 .. 2007 if successful.
};

/// Status codes (9.4.1.9) and reason codes (9.4.1.7).
inline constexpr std::uint16_t kStatusSuccess = 0;
inline constexpr std::uint16_t kStatusTooManyStations = 17;
inline constexpr std::uint16_t kReasonNotAuthenticated = 6;  ///< For class 2 frames.
inline constexpr std::uint16_t kReasonNotAssociated = 7;     ///< For class 3 frames.
inline constexpr std::uint16_t kMaxAssociationId = 2007;     ///< 9.4.1.8.

hal::Bytes encode(const Beacon& beacon);
hal::Bytes encode(const Authentication& authentication);
hal::Bytes encode(const AssociationRequest& request);
hal::Bytes encode(const AssociationResponse& response);
/// Encodes the body of a disassociation or deauthentication frame.
hal::Bytes encode_reason(std::uint16_t reason);

using Body = std::span<const std::uint8_t>;
std::optional<Beacon> decode_beacon(Body body);
std::optional<Authentication> decode_authentication(Body body);
/// @param again  true for a reassociation request.
std::optional<AssociationRequest> decode_association_request(Body body, bool again);
std::optional<AssociationResponse> decode_association_response(Body body);
std::optional<std::uint16_t> decode_reason(Body body);

/// The body of a beacon that starts at `at` in the given mode, with its timestamp: the time at
/// which its own first bit is sent (11.1.3.1).
Payload with_timestamp(const hal::Bytes& beacon, hal::Time at, const PhyMode& mode);

}  // namespace sim::radio
