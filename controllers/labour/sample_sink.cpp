#include "controllers/labour/sample_sink.h"

namespace controllers {

void SampleSink::receive(const hal::Message& message) {
  const auto sample = sample_in(message.payload);
  if (!sample) return;
  Burst& burst = bursts_[{message.source, message.topic}];
  if (sample->burst < burst.number) return;  // a late message of an earlier burst
  if (sample->burst > burst.number) burst = {.number = sample->burst, .got = {}};
  if (!burst.got.insert(sample->index).second) return;
  ++samples_[message.topic];
  if (burst.got.size() != sample->needed) return;
  // If the receipt is lost, the sender counts a failure: a network that cannot return the receipt
  // is no better than one that cannot deliver the samples.
  (void)self_.send(message.source, message.topic, receipt_for(burst.number));
}

void SampleSink::record(hal::RealWorldObject& self) const {
  for (const auto& [topic, count] : samples_) self.record("samples_" + topic, count);
}

}  // namespace controllers
