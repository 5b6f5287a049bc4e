#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

namespace programs::lockstep {

/// What turns cost: the one processor of an agent is busy for a fixed virtual time before each turn
/// of a thread, and takes the threads one after the other.
///
///   if (charge.is_paid(slot, now)) …  // it goes on, at once; otherwise at charge.due()
class ProcessorCharge {
 public:
  /// @param per_turn  virtual time, ns; 0: turns cost nothing.
  explicit ProcessorCharge(std::int64_t per_turn) : per_turn_(per_turn) {}

  /// The thread that the processor is busy with; none: it is free.
  std::optional<std::size_t> slot() const { return slot_; }
  /// When it is free again, virtual time, ns; none: it is free.
  std::optional<std::int64_t> due() const {
    return slot_ ? std::optional<std::int64_t>(due_) : std::nullopt;
  }

  /// Makes a free processor busy with a thread. @return whether the thread's turn begins now; the
  /// processor is free then.
  bool is_paid(std::size_t slot, std::int64_t now) {
    if (!slot_) due_ = now + per_turn_;
    slot_ = slot;
    if (due_ > now) return false;
    slot_.reset();
    return true;
  }

  /// The thread does not want to go on any more: it has been killed. The processor is free.
  void drop() { slot_.reset(); }

 private:
  std::int64_t per_turn_, due_ = 0;
  std::optional<std::size_t> slot_;
};

}  // namespace programs::lockstep
