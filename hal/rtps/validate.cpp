#include "hal/rtps/validate.h"

#include <algorithm>

#include "hal/rtps/control.h"
#include "hal/rtps/data.h"

namespace hal::rtps {
namespace {

bool carries_samples(const Submessage& submessage) {
  return submessage.kind == SubmessageKind::kData || submessage.kind == SubmessageKind::kDataFrag;
}

}  // namespace

std::optional<Fault> fault_in(Octets datagram, const Limits& limits, std::int64_t& highest) {
  Walk walk(datagram);
  GuidPrefix source = walk.header().source;
  std::int64_t found = highest;
  while (const Submessage* one = walk.next()) {
    Data data;
    const Objection objection = carries_samples(*one)
                                    ? judge_data(*one, source, limits, data)
                                    : judge_control(*one, limits, source, data.sequence_number);
    if (!objection.empty()) return Fault{one->at, name_of(one->kind), objection};
    // A sender that speaks for others could also relay their discovery.
    if (!limits.relayed_discovery && source != walk.header().source) {
      return Fault{one->at, name_of(one->kind), "it is for another participant than the sender"};
    }
    found = std::max(found, data.sequence_number);
  }
  if (!walk.fault()) highest = found;
  return walk.fault();
}

std::optional<Fault> fault_in(Octets datagram, const Limits& limits) {
  std::int64_t highest = 0;
  return fault_in(datagram, limits, highest);
}

Result<void> validate(Octets datagram, const Limits& limits) {
  const std::optional<Fault> fault = fault_in(datagram, limits);
  if (!fault) return {};
  return fail(Errc::kProtocol, fault->text());
}

}  // namespace hal::rtps
