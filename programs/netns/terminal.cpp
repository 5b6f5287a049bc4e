#include "programs/netns/terminal.h"

#include <unistd.h>

#include <csignal>

namespace programs::netns {

Terminal::Terminal() : is_ours_(isatty(STDIN_FILENO) != 0 && tcgetpgrp(STDIN_FILENO) == getpgrp()) {
  // A process that is not in the foreground is stopped by this signal when it sets the foreground.
  if (is_ours_) signal(SIGTTOU, SIG_IGN);
}

void Terminal::take() const {
  if (!is_ours_) return;
  setpgid(0, 0);
  tcsetpgrp(STDIN_FILENO, getpgrp());
  signal(SIGTTOU, SIG_DFL);
}

void Terminal::give_to(pid_t child) const {
  if (!is_ours_) return;
  setpgid(child, child);  // both processes do it; the first one counts
  tcsetpgrp(STDIN_FILENO, child);
}

void Terminal::take_back() const {
  if (is_ours_) tcsetpgrp(STDIN_FILENO, getpgrp());
}

}  // namespace programs::netns
