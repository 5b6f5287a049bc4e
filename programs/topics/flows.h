#pragma once

#include <thread>
#include <vector>

#include "programs/topics/ending.h"
#include "programs/topics/journal.h"
#include "programs/topics/plan.h"

namespace programs::topics {

/// Sends a plan's flows of UDP and receives those of others, each by a thread.
class Flows {
 public:
  /// @param begin  time 0 of the flows. All must outlive this object.
  /// @throws std::runtime_error  a port cannot be had.
  Flows(const Plan& plan, Instant begin, Journal& journal, Ending& ending);
  /// Ends the receiving threads; the sending ones end with `ending`.
  ~Flows();
  Flows(const Flows&) = delete;
  Flows& operator=(const Flows&) = delete;

 private:
  void send(const SentFlow& flow, Instant begin) const;
  void receive(int socket, std::uint16_t port) const;

  Journal& journal_;
  Ending& ending_;
  int over_ = -1;  ///< Readable when the receiving threads must end.
  std::vector<int> sockets_;
  std::vector<std::thread> threads_;
};

}  // namespace programs::topics
