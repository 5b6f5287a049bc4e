#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <utility>

#include "controllers/labour/sample_message.h"
#include "hal/api/controller.h"

namespace controllers {

/// Receives the samples of all agents and answers every burst once, when it has as many of its
/// messages as the burst says it needs.
class SampleSink {
 public:
  explicit SampleSink(hal::RealWorldObject& self) : self_(self) {}

  /// Messages that are no samples are passed over.
  void receive(const hal::Message& message);
  /// Records the different samples of each topic: "samples_<topic>".
  void record(hal::RealWorldObject& self) const;

 private:
  struct Burst {
    std::uint32_t number = 0;
    std::set<std::uint16_t> got;  ///< Indices.
  };

  hal::RealWorldObject& self_;
  std::map<std::pair<hal::AgentId, std::string>, Burst> bursts_;  ///< The latest of each sender.
  std::map<std::string, int> samples_;                            ///< By topic.
};

}  // namespace controllers
