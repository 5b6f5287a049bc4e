#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "hal/types/time.h"
#include "sim/air/sample_loss.h"

namespace sim::air {

/// What was lost of one sample on its way to one agent: the last loss of each range of its
/// fragments, latest last. What was lost and came in another carrier counts no more.
class SampleLosses {
 public:
  /// Fragments of RTPS from the first on, the second is behind the last; both from 0.
  using Range = std::pair<std::uint32_t, std::uint32_t>;
  /// Of more ranges the last so many are remembered.
  static constexpr std::size_t kMost = 8;

  void add(const SampleLoss& loss, Range range);

  /// A frame to everyone carries it: lost unless the agent's radio says otherwise.
  /// @param over  when that must have been said.
  void expect(const SampleLoss& loss, Range range, hal::Time over);
  /// The radio said how that frame ended: it is lost by another cause, or came in.
  void on_heard(std::uint64_t frame);
  /// What is expected and over by now is lost.
  void settle(hal::Time now);

  /// The last loss of a fragment that did not arrive. @param got  by fragment.
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
