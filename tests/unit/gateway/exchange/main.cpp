#include <gtest/gtest.h>

#include <unistd.h>

#include <fstream>
#include <string>

#include "gateway/exchange/controller_process.h"
#include "gateway/exchange/server.h"
#include "tests/unit/gateway/exchange/echo_controller.h"
#include "tests/unit/gateway/exchange/guest_child.h"

namespace {

/// A controller process for mote m1.
int be_controller(int domain, const std::string& name) {
  const hal::ControllerKind kind = echo_kind();
  return static_cast<int>(
      gateway::exchange::run_controllers(kind, options_for(domain, "m1", name)));
}

/// A server that starts a run and never goes on.
int be_server(int domain) {
  gateway::exchange::Server server(gateway::process::take_domain(domain));
  const hal::node::exchange::Hello hello = first_hello(server);
  const auto link = server.link(hello, 1, std::nullopt);
  if (!server.answer(session_for(hello, 1))) return 1;
  if (!exchange_step(*link, step_with(hal::node::exchange::Start{}, 1))) return 1;
  while (true) pause();
}

/// A server that starts a run of a guest, tells which process that is and never goes on.
int be_host(int domain, const std::string& told) {
  gateway::exchange::Server server(gateway::process::take_domain(domain));
  const GuestChild guest(server, {"controller", std::to_string(domain), "guest"});
  const hal::node::exchange::Hello hello = first_hello(server);
  const auto link = server.link(hello, 1, std::nullopt);
  if (!server.answer(session_for(hello, 1))) return 1;
  if (!exchange_step(*link, step_with(hal::node::exchange::Start{}, 1))) return 1;
  std::ofstream(told) << hello.pid << std::endl;
  while (true) pause();
}

}  // namespace

/// For the sanitizer: Fast DDS 2.9 deletes one of its own objects as its base class.
extern "C" const char* __asan_default_options() {  // NOLINT(bugprone-reserved-identifier)
  return "new_delete_type_mismatch=0";
}

/// Tests, or one of the roles of a Child: "controller DOMAIN NAME", "server DOMAIN", "host DOMAIN
/// FILE", "sleep".
int main(int argc, char** argv) {
  const std::string role = argc > 1 ? argv[1] : "";
  if (role == "sleep") return pause();
  if (role == "controller" && argc == 4) return be_controller(std::stoi(argv[2]), argv[3]);
  if (role == "server" && argc == 3) return be_server(std::stoi(argv[2]));
  if (role == "host" && argc == 4) return be_host(std::stoi(argv[2]), argv[3]);
  testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
