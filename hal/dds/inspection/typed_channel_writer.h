#pragma once

#include <cstddef>
#include <cstring>
#include <span>
#include <string>
#include <vector>

#include "hal/dds/inspection/channel_writer.h"
#include "hal/dds/inspection/inspection_endpoints.h"
#include "hal/dds/inspection/inspection_values.h"
#include "inspectPubSubTypes.h"

namespace hal::dds {

inline constexpr int kChannelSamples = 10;  // kept for a reader that is busy for a moment

/// A writer of samples of one type, which fill() makes of the values of a channel.
template <class PubSub>
class TypedWriter : public ChannelWriter {
 public:
  explicit TypedWriter(const ChannelTopic& topic)
      : writer_(topic.participant, "rt/" + topic.agent + "/" + topic.channel.name, kChannelSamples,
                topic.readers),
        length_(topic.channel.length),
        period_(topic.channel.period) {}

  bool has_readers() const noexcept override { return writer_.has_readers(); }

  void publish(Time at, std::span<const double> values) override {
    if (values.size() != length_ || is_same_measurement(at, values)) return;
    shown_.assign(values.begin(), values.end());
    shown_at_ = at;
    fill(at, values);
    writer_.write();
  }

 protected:
  auto& sample() { return writer_.sample(); }
  virtual void fill(Time at, std::span<const double> values) = 0;

 private:
  /// Whether they are the values shown last, held while the sensor measures the next ones. Bit by
  /// bit: a value may be NaN.
  bool is_same_measurement(Time at, std::span<const double> values) const {
    return shown_.size() == values.size() && at < shown_at_ + period_ &&
           std::memcmp(shown_.data(), values.data(), values.size_bytes()) == 0;
  }

  InspectionWriter<PubSub> writer_;
  std::size_t length_;
  Duration period_;
  std::vector<double> shown_;
  Time shown_at_{};
};

}  // namespace hal::dds
