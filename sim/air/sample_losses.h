#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "hal/types/time.h"
#include "sim/air/sample_loss.h"

namespace sim::air {

/// Losses of one sample on its way to one agent: the last loss of each range of its fragments,
/// latest last. A loss of fragments that arrived in another carrier does not count.
class SampleLosses {
 public:
  /// RTPS fragments [first, second), numbered from 0.
  using Range = std::pair<std::uint32_t, std::uint32_t>;
  /// Number of ranges kept; older ones are dropped.
  static constexpr std::size_t kMost = 8;

  void add(const SampleLoss& loss, Range range);

  /// A group frame carries the range: it is lost unless on_heard() is called.
  /// @param over  time by which the agent's radio will have reported the frame.
  void expect(const SampleLoss& loss, Range range, hal::Time over);
  /// The radio reported how that frame ended: it was received, or lost for another cause.
  void on_heard(std::uint64_t frame);
  /// Records the expected loss if its time is over.
  void settle(hal::Time now);

  /// The last loss of a fragment that did not arrive. @param got  whether each fragment arrived.
  std::optional<SampleLoss> last(const std::vector<bool>& got) const;
  void clear();

 private:
  struct Lost {
    SampleLoss loss;
    Range range;
  };
  std::vector<Lost> all_;
  std::optional<Lost> expected_;
  hal::Time over_{};
};

}  // namespace sim::air
