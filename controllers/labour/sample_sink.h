#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "controllers/labour/sample_message.h"
#include "hal/api/controller.h"

namespace controllers {

/// Receives the samples of all agents and sends one receipt per burst, when the required number of
/// its messages has arrived.
class SampleSink {
 public:
  explicit SampleSink(hal::RealWorldObject& self) : self_(self) {}

  /// Ignores messages that are not samples.
  void receive(const hal::Message& message);
  /// Records the number of different samples of each topic as "samples_<topic>".
  void record(hal::RealWorldObject& self) const;

 private:
  struct Burst {
    std::uint32_t number = 0;
    std::set<std::uint16_t> got;  ///< Indices received.
  };

  hal::RealWorldObject& self_;
  /// Latest burst by sender and topic.
  std::map<std::pair<hal::AgentId, std::string>, Burst> bursts_;
  std::map<std::string, int> samples_;  ///< By topic.
};

}  // namespace controllers
