#pragma once

#include <cstdint>
#include <ctime>
#include <string>
#include <vector>

/// Stands between the dilating calls and the C library: while it is armed, a timed call is noted
/// and comes back at once; otherwise it goes on.
namespace tests::recorder {

inline constexpr std::int64_t kNone = -1;  ///< A null pointer.

struct Call {
  std::string name;
  std::vector<std::int64_t> times;  ///< What it was given, ns or, of poll() and its like, ms.
};

/// What an armed call does.
struct Reaction {
  int result = 0;
  int error = 0;              ///< errno, if the result is -1.
  std::int64_t left = 0;      ///< ns, where it writes back what is left of a time.
  std::int64_t interval = 0;  ///< ns, the same of a timer.
};

void arm(const Reaction& reaction);
/// What was called since arm().
std::vector<Call> disarm();

/// Whether SO_SNDTIMEO goes on to the kernel, armed or not: the calls that send ask for it.
void set_sending(bool sending);

/// The clock of the kernel, while armed, ns.
void set_clock(std::int64_t now);

}  // namespace tests::recorder
