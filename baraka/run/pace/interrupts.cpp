#include "baraka/run/pace/interrupts.h"

#include <csignal>

#include "gateway/runtime/exit_watch.h"

namespace baraka::run::pace {
namespace {

constexpr int kInterruptedStatus = 130;

volatile std::sig_atomic_t interrupts = 0;

void on_signal(int) {
  if (interrupts != 0) gateway::runtime::leave(kInterruptedStatus);
  interrupts = 1;
}

}  // namespace

void catch_interrupts() {
  struct sigaction action {};
  action.sa_handler = on_signal;
  ::sigaction(SIGINT, &action, nullptr);
  ::sigaction(SIGTERM, &action, nullptr);
  // SIGHUP: the terminal is gone; nohup(1) sets it to be ignored.
  struct sigaction before {};
  ::sigaction(SIGHUP, nullptr, &before);
  if (before.sa_handler != SIG_IGN) ::sigaction(SIGHUP, &action, nullptr);
}

bool interrupted() { return interrupts != 0; }

}  // namespace baraka::run::pace
