#pragma once

#include "hal/rtps/submessage.h"
#include "hal/types/time.h"
#include "sim/air/datagram.h"
#include "sim/air/endpoints.h"

namespace sim::air {

/// Classifies the submessages of RTPS datagrams as their fragments arrive, and collects the
/// announcements of SEDP in them: OMG DDSI-RTPS 2.5, 8.3 and 9.4. The contents are not trusted: any
/// program may have sent them.
class RtpsReader {
 public:
  explicit RtpsReader(Endpoints& endpoints) : endpoints_(endpoints) {}

  /// Goes on with what is known of a datagram. @return the number of parts that were known before.
  std::size_t read(hal::Time at, Datagram& datagram);

 private:
  void read_one(Datagram& datagram, const hal::rtps::Submessage& one);
  void learn(hal::Time at, Datagram& datagram);

  Endpoints& endpoints_;
};

/// Which of the endpoints that come with every participant it is, or kUser.
Purpose purpose_of(hal::rtps::EntityId reader, hal::rtps::EntityId writer);

}  // namespace sim::air
