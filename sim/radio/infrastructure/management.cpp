#include "sim/radio/infrastructure/management.h"

#include <algorithm>

#include "sim/radio/infrastructure/bss_config.h"
#include "sim/radio/infrastructure/capability_elements.h"
#include "sim/radio/infrastructure/edca_element.h"
#include "sim/radio/mac/mac_address.h"

namespace sim::radio {
namespace {

// Element IDs (IEEE Std 802.11-2016, table 9-77).
constexpr std::uint8_t kSsidElement = 0;
constexpr std::uint8_t kRatesElement = 1;
constexpr std::uint8_t kDsssParametersElement = 3;
constexpr std::uint8_t kTrafficIndicationElement = 5;
constexpr std::uint8_t kErpElement = 42;
constexpr std::uint8_t kQosCapabilityElement = 46;
constexpr std::uint8_t kExtendedRatesElement = 50;

constexpr std::size_t kRatesInFirst = 8;  // 9.4.2.3; the others are in the extended element
constexpr std::uint8_t kNonErpPresentAndProtection = 0x03;  // 9.4.2.12

// Bits of the Capability Information field (9.4.1.4).
constexpr std::uint16_t kEssBit = 0x0001;
constexpr std::uint16_t kShortPreambleBit = 0x0020;
constexpr std::uint16_t kQosBit = 0x0200;
constexpr std::uint16_t kShortSlotBit = 0x0400;

constexpr std::uint64_t kListenInterval = 1;  // in beacon intervals; no station uses power save
constexpr std::uint16_t kTwoHighestBits = 0xc000;  // of an AID (9.4.1.8)
constexpr std::size_t kTimestampSize = 8, kBeforeBody = 24;

void put_element(hal::Bytes& out, std::uint8_t id, Body content) {
  out.push_back(id);
  out.push_back(static_cast<std::uint8_t>(content.size()));
  out.insert(out.end(), content.begin(), content.end());
}

void put_capability(hal::Bytes& out, const BssParameters& bss) {
  const int bits = kEssBit | (bss.short_preamble ? kShortPreambleBit : 0) |
                   (bss.qos ? kQosBit : 0) | (bss.short_slot ? kShortSlotBit : 0);
  put_little_endian(out, static_cast<std::uint64_t>(bits), 2);
}

void put_ssid(hal::Bytes& out, const BssParameters& bss) {
  const hal::Bytes ssid(bss.ssid.begin(), bss.ssid.end());
  put_element(out, kSsidElement, ssid);
}

void put_rates(hal::Bytes& out, const BssParameters& bss) {
  put_element(out, kRatesElement, Body(bss.rates).first(std::min(kRatesInFirst, bss.rates.size())));
}

void put_extended_rates(hal::Bytes& out, const BssParameters& bss) {
  if (bss.rates.size() > kRatesInFirst) {
    put_element(out, kExtendedRatesElement, Body(bss.rates).subspan(kRatesInFirst));
  }
}

void put_edca(hal::Bytes& out, const BssParameters& bss) {
  if (bss.edca) put_edca_element(out, *bss.edca);
}

/// Of requests: a station without power save (9.4.1.17: QoS Info of 0).
void put_qos_capability(hal::Bytes& out, const BssParameters& bss) {
  if (bss.qos) put_element(out, kQosCapabilityElement, hal::Bytes{0});
}

void put_capabilities(hal::Bytes& out, const BssParameters& bss) {
  if (bss.capabilities) put_capability_elements(out, *bss.capabilities);
}

void put_operation(hal::Bytes& out, const BssParameters& bss) {
  if (bss.capabilities)
    put_operation_elements(out, *bss.capabilities, bss.primary_channel, bss.ht_operation);
}

/// Reads fields one after the other.
class BodyReader {
 public:
  explicit BodyReader(Body body) : rest_(body) {}

  std::uint64_t take(std::size_t bytes) {
    if (!has(bytes)) return 0;
    const std::uint64_t value = get_little_endian(rest_, bytes);
    rest_ = rest_.subspan(bytes);
    return value;
  }
  std::uint16_t take_field() { return static_cast<std::uint16_t>(take(2)); }
  std::optional<hal::AgentId> take_address() {
    if (!has(kAddressSize)) return std::nullopt;
    const auto address = get_address(rest_);
    rest_ = rest_.subspan(kAddressSize);
    return address;
  }
  void take_capability(BssParameters& bss) {
    const std::uint16_t bits = take_field();
    bss.short_preamble = (bits & kShortPreambleBit) != 0;
    bss.qos = (bits & kQosBit) != 0;
    bss.short_slot = (bits & kShortSlotBit) != 0;
  }
  /// Reads all elements up to the end.
  void take_elements(BssParameters& bss) {
    while (good_ && !rest_.empty()) {
      const auto id = static_cast<std::uint8_t>(take(1));
      const auto size = static_cast<std::size_t>(take(1));
      if (!has(size)) return;
      take_element(id, rest_.first(size), bss);
      rest_ = rest_.subspan(size);
    }
  }
  bool good() const { return good_; }

 private:
  bool has(std::size_t bytes) { return good_ = good_ && rest_.size() >= bytes; }

  /// The first element of HT, VHT or HE says that there are any.
  static void take_capabilities(std::uint8_t id, Body content, BssParameters& bss) {
    Capabilities found = bss.capabilities.value_or(
        Capabilities{.classes = 0, .streams = 1, .width = 20, .short_guard = false});
    const std::uint8_t before = found.classes;
    if (!take_capability_element(id, content, found)) return;
    if (bss.capabilities || found.classes != before) bss.capabilities = found;
  }

  static void take_element(std::uint8_t id, Body content, BssParameters& bss) {
    if (id == kSsidElement) bss.ssid.assign(content.begin(), content.end());
    if (id == kRatesElement || id == kExtendedRatesElement) {
      bss.rates.insert(bss.rates.end(), content.begin(), content.end());
    }
    take_capabilities(id, content, bss);
    take_ht_operation(id, content, bss.ht_operation);
    if (id == kEdcaElement) bss.edca = take_edca_element(content);
    if (id == kDsssParametersElement && !content.empty()) bss.channel = content[0];
    if (id == kErpElement && !content.empty()) {
      bss.erp = true;
      bss.use_protection = (content[0] & kNonErpPresentAndProtection) != 0;
    }
  }

  Body rest_;
  bool good_ = true;
};

template <class T>
std::optional<T> if_good(const BodyReader& in, const T& value) {
  return in.good() ? std::optional<T>{value} : std::nullopt;
}

}  // namespace

hal::Bytes encode(const Beacon& beacon) {
  hal::Bytes out;
  const auto tsf =
      std::chrono::floor<std::chrono::microseconds>(beacon.timestamp.time_since_epoch());
  put_little_endian(out, static_cast<std::uint64_t>(tsf.count()), kTimestampSize);
  put_little_endian(out, static_cast<std::uint64_t>(beacon.interval / kTimeUnit), 2);
  put_capability(out, beacon.bss);
  put_ssid(out, beacon.bss);
  put_rates(out, beacon.bss);
  if (beacon.bss.channel) put_element(out, kDsssParametersElement, Body(&*beacon.bss.channel, 1));
  // DTIM count 0, DTIM period 1, no buffered frames, because no station uses power save (9.4.2.6).
  put_element(out, kTrafficIndicationElement, hal::Bytes{0, 1, 0, 0});
  if (beacon.bss.erp) {
    const std::uint8_t flags = beacon.bss.use_protection ? kNonErpPresentAndProtection : 0;
    put_element(out, kErpElement, Body(&flags, 1));
  }
  put_extended_rates(out, beacon.bss);
  put_edca(out, beacon.bss);
  put_capabilities(out, beacon.bss);
  put_operation(out, beacon.bss);
  return out;
}

hal::Bytes encode(const Authentication& authentication) {
  hal::Bytes out;
  put_little_endian(out, 0, 2);  // Open System
  put_little_endian(out, authentication.transaction, 2);
  put_little_endian(out, authentication.status, 2);
  return out;
}

hal::Bytes encode(const AssociationRequest& request) {
  hal::Bytes out;
  put_capability(out, request.bss);
  put_little_endian(out, kListenInterval, 2);
  if (request.current_access_point) put_address(out, *request.current_access_point);
  put_ssid(out, request.bss);
  put_rates(out, request.bss);
  put_extended_rates(out, request.bss);
  put_qos_capability(out, request.bss);
  put_capabilities(out, request.bss);
  return out;
}

hal::Bytes encode(const AssociationResponse& response) {
  hal::Bytes out;
  put_capability(out, response.bss);
  put_little_endian(out, response.status, 2);
  put_little_endian(out, kTwoHighestBits | static_cast<std::uint64_t>(response.association_id), 2);
  put_rates(out, response.bss);
  put_extended_rates(out, response.bss);
  put_edca(out, response.bss);
  put_capabilities(out, response.bss);
  put_operation(out, response.bss);
  return out;
}

hal::Bytes encode_reason(std::uint16_t reason) {
  hal::Bytes out;
  put_little_endian(out, reason, 2);
  return out;
}

std::optional<Beacon> decode_beacon(Body body) {
  BodyReader in(body);
  Beacon beacon;
  beacon.timestamp =
      hal::Time{std::chrono::microseconds{static_cast<std::int64_t>(in.take(kTimestampSize))}};
  beacon.interval = in.take_field() * kTimeUnit;
  in.take_capability(beacon.bss);
  in.take_elements(beacon.bss);
  if (beacon.interval == hal::Duration{}) return std::nullopt;
  return if_good(in, beacon);
}

std::optional<Authentication> decode_authentication(Body body) {
  BodyReader in(body);
  const std::uint16_t algorithm = in.take_field();
  const Authentication authentication{.transaction = in.take_field(), .status = in.take_field()};
  if (algorithm != 0) return std::nullopt;
  return if_good(in, authentication);
}

std::optional<AssociationRequest> decode_association_request(Body body, bool again) {
  BodyReader in(body);
  AssociationRequest request;
  in.take_capability(request.bss);
  in.take_field();
  if (again) request.current_access_point = in.take_address();
  in.take_elements(request.bss);
  return if_good(in, request);
}

std::optional<AssociationResponse> decode_association_response(Body body) {
  BodyReader in(body);
  AssociationResponse response;
  in.take_capability(response.bss);
  response.status = in.take_field();
  response.association_id = static_cast<std::uint16_t>(in.take_field() & ~kTwoHighestBits);
  in.take_elements(response.bss);
  return if_good(in, response);
}

std::optional<std::uint16_t> decode_reason(Body body) {
  BodyReader in(body);
  const std::uint16_t reason = in.take_field();
  return if_good(in, reason);
}

Payload with_timestamp(const hal::Bytes& beacon, hal::Time at, const PhyMode& mode) {
  const double header = 8e9 * kBeforeBody / mode.rate().value;  // ns
  const hal::Time first =
      at + mode.preamble_and_header() + hal::Duration{static_cast<std::int64_t>(header)};
  const auto tsf = std::chrono::floor<std::chrono::microseconds>(first.time_since_epoch());
  hal::Bytes body;
  body.reserve(beacon.size());
  put_little_endian(body, static_cast<std::uint64_t>(tsf.count()), kTimestampSize);
  body.insert(body.end(), beacon.begin() + kTimestampSize, beacon.end());
  return std::make_shared<const hal::Bytes>(std::move(body));
}

}  // namespace sim::radio
