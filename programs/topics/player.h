#pragma once

#include <functional>
#include <memory>

#include "programs/topics/journal.h"
#include "programs/topics/plan.h"

namespace programs::topics {

/// Writes a sample of that many serialised octets, as long as the vendor lets it block. Returns
/// whether it was accepted. Called by one thread per topic.
using Write = std::function<bool(std::uint32_t bytes)>;

/// A participant of one vendor.
class Participant {
 public:
  virtual ~Participant() = default;
  /// @throws std::runtime_error  it cannot be created.
  virtual void read(const ReadTopic& topic) = 0;
  /// @param most  largest serialised sample [byte]. @throws std::runtime_error  likewise.
  virtual Write write(const WrittenTopic& topic, std::uint32_t most) = 0;
};

/// Makes the participant of a plan; it counts what it receives in the journal.
using MakeParticipant =
    std::function<std::unique_ptr<Participant>(const Plan& plan, Journal& journal)>;

/// `main` of a player: reads the plan that its only argument names, plays it until SIGTERM or
/// SIGINT, writes the journal. After SIGINT the participant takes leave of the others, which may
/// take some seconds; SIGTERM ends the program at once. Each topic has a thread: a write that
/// blocks delays the samples of its topic, which follow as soon as it returns, and no others.
/// Returns the exit status.
int play(int argc, char** argv, const MakeParticipant& make);

}  // namespace programs::topics
