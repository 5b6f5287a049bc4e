#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string_view>

#include "programs/netns/go_inside.h"
#include "programs/netns/init.h"

namespace {

/// Exit status of `baraka exec` if it could not run the command, so that scripts can distinguish it
/// from the command's own status; the same as of env(1) and docker-exec(1).
constexpr int kCannotEnter = 125;

}  // namespace

/// The program that baraka starts for what only a process with a single thread may do:
///  baraka-holder hold CONTROL EVENTS PARENT        the namespaces of a run
///  baraka-holder enter FOLDER AGENT [COMMAND…]     what `baraka exec` becomes
int main(int argc, char** argv) {
  const std::string_view what = argc > 1 ? argv[1] : "";
  try {
    if (what == "hold" && argc == 5) {
      return programs::netns::hold(std::atoi(argv[2]), std::atoi(argv[3]), std::atoi(argv[4]));
    }
    if (what == "enter" && argc >= 4) {
      return programs::netns::go_inside(argv[2], argv[3], {argv + 4, argv + argc});
    }
  } catch (const std::exception& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return what == "enter" ? kCannotEnter : 1;
  }
  std::fputs("baraka-holder is started by baraka\n", stderr);
  return 2;
}
