#pragma once

#include "hal/rtps/submessage.h"
#include "hal/types/time.h"
#include "sim/air/datagram.h"
#include "sim/air/endpoints.h"

namespace sim::air {

/// Classifies the submessages of RTPS datagrams as their fragments arrive, and collects SEDP
/// announcements from them: OMG DDSI-RTPS 2.5, 8.3 and 9.4. The contents are not trusted, because
/// any program may have sent them.
class RtpsReader {
 public:
  explicit RtpsReader(Endpoints& endpoints) : endpoints_(endpoints) {}

  /// Continues with the octets of a datagram that have become known. @return the number of parts
  /// that were known before.
  std::size_t read(hal::Time at, Datagram& datagram);

 private:
  void read_one(Datagram& datagram, const hal::rtps::Submessage& one);
  void learn(hal::Time at, Datagram& datagram);

  Endpoints& endpoints_;
};

/// Purpose of a submessage between these entities: that of a built-in endpoint, or kUser.
Purpose purpose_of(hal::rtps::EntityId reader, hal::rtps::EntityId writer);

}  // namespace sim::air
