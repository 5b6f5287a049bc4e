#pragma once

#include <sys/types.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "programs/netns/descriptor.h"
#include "programs/netns/program_time.h"
#include "programs/netns/room_page.h"
#include "programs/netns/wait_page.h"

namespace programs::netns {

/// The file in the results folder by which `baraka exec` finds a run. It exists as long as the run.
inline constexpr const char* kStateFile = "namespaces.txt";

/// A route of an agent's kernel.
struct KernelRoute {
  bool is_ipv6 = false;
  int prefix = 0;  ///< Length of the network part of `destination` [bit].
  std::array<std::uint8_t, 16> destination{};  ///< Network byte order; IPv4: the first four.
  std::uint16_t via = 0;      ///< IPv6: AgentNetwork::id of the next hop; 0: directly.
  std::uint32_t gateway = 0;  ///< IPv4: address of the next hop, host byte order; 0: directly.
};

/// An agent's interface `wlan0`: an Ethernet card to programs, with MAC address 02:00:00:00:hh:ll.
struct AgentNetwork {
  std::string agent;          ///< Name; also the host name inside, and in every /etc/hosts.
  std::uint16_t id = 0;       ///< Hh:ll of the MAC address.
  std::uint32_t address = 0;  ///< IPv4, host byte order; unique in the run.
  int prefix = 16;            ///< Length of the network part of the address [bit], 8 .. 30.
  int mtu = 1500;  ///< Maximum IP packet [byte], 576 .. 2296; below 1280 there is no IPv6.
  std::vector<KernelRoute> routes{};  ///< Besides that of its own network, each destination once.
  bool forwards = false;              ///< It is a router: it forwards packets of others.
};

struct Settings {
  std::vector<AgentNetwork> agents;  ///< At least one.
  ProgramTime time;                  ///< See programs/preload and programs/waits.
  std::uint64_t seed = 1;            ///< Seed of the programs' entropy in lock-step.
  /// Results folder, for kStateFile; empty: none is written. May be renamed during the run.
  std::filesystem::path state_folder;
  /// Files and folders of the host's /tmp, /run and /dev/shm that all programs see: see Namespaces.
  std::vector<std::filesystem::path> shown;
  /// Folder with baraka-holder and the libraries to be preloaded; empty: the folder of this
  /// program, or ../lib/baraka relative to it.
  std::filesystem::path programs;
};

/// A program to start inside an agent.
struct Command {
  std::vector<std::string> arguments;  ///< The first is the program, searched in PATH.
  std::vector<std::pair<std::string, std::string>> environment;  ///< Added to this process's own.
  std::filesystem::path log;     ///< Its standard output and error are appended here.
  std::filesystem::path folder;  ///< Working folder; empty: that of this process.
  /// Files of the host's /tmp, /run and /dev/shm, in addition to what all programs see: see
  /// Namespaces.
  std::vector<std::filesystem::path> shown{};
  /// Descriptors of this process that the program keeps, numbered from 3 on in this order. Those of
  /// the preloaded library and of the C library are numbered above them.
  std::vector<int> inherited;
  std::optional<std::size_t> slot{};  ///< In lock-step: reserved for it in the agent's WaitPage.
};

/// A program that runs.
struct Started {
  std::uint32_t program = 0;  ///< Its number, from 1 on.
  pid_t process = 0;          ///< Its process, as its agent numbers it.
};

/// A program that has ended.
struct Ended {
  std::size_t agent = 0;
  std::uint32_t program = 0;  ///< As returned by start().
  int status = 0;             ///< As from waitpid().
};

/// The namespaces of a run, and the programs inside. Each agent has its own network with `lo` and
/// `wlan0`, whose other end is a TAP in this process. This process itself stays outside.
///
///   baraka ── fork, exec ── baraka-holder ── fork ── init: process 1 of the run
///     │ TAPs, pages                                    ├─ process 1 of r0, programs of r0
///     └──────── two sockets ───────────────────────────┴─ process 1 of r1, programs of r1, …
///
/// Everything ends with this object, and also if this process is killed: init ends when its socket
/// closes, and then the kernel kills everything inside, including daemons. Each agent has its own
/// process ids, and its own `/tmp` and `/dev/shm` (at most 1 GiB each) and `/run` (256 MiB; with
/// the host's folders, empty). Of the host's files in these folders, programs see Settings::shown,
/// the results folder, their working folder, and the folder of their own file, unless that is one
/// of these three itself. The names of all agents resolve, in IPv4 and IPv6. The kernel's timers of
/// neighbours, fragments and multicast groups are stretched by 1/factor; those of TCP are not.
///
/// Programs run as user 0 of the agent's own user namespace, which is the caller outside, and have
/// `libbaraka_dilate.so` preloaded at every factor, in lock-step `libbaraka_lockstep.so`;
/// IdMapper describes which other users exist. Mounts cannot be unmounted inside. /sys is
/// read-only, and so is /proc except for the files of processes and of the network. No privilege is
/// needed except read-write access to /dev/net/tun and permission to make user namespaces.
///
/// One thread, which must live as long as this object: the kernel kills the holder when it ends.
class Namespaces {
 public:
  /// Makes the namespaces; takes some milliseconds per agent.
  /// @throws std::runtime_error  one sentence: what is missing or refused, and how to allow it.
  explicit Namespaces(const Settings& settings);
  /// Ends everything inside: SIGTERM, after 10 s SIGKILL; waits until it has ended.
  ~Namespaces();
  Namespaces(const Namespaces&) = delete;
  Namespaces& operator=(const Namespaces&) = delete;

  /// Why programs cannot become another user than 0, for display; empty: they can.
  const std::string& why_only_user_0() const;

  /// The other end of the agent's wlan0, owned by this object, non-blocking: each read and write is
  /// one Ethernet frame with complete checksums and without FCS. @param agent  index in
  /// Settings::agents.
  int tap(std::size_t agent) const;

  /// Starts a program inside an agent; it has a session of its own and runs when this returns.
  /// @throws std::runtime_error  it is not found, is no program, or cannot be slowed or held where
  ///   that is needed (statically linked, another machine's).
  Started start(std::size_t agent, const Command& command);

  /// Readable when a program has ended, or the namespaces are gone.
  int descriptor() const;
  /// Programs that have ended since the last call.
  /// @throws std::runtime_error  "the namespaces of the run are gone": they were killed.
  std::vector<Ended> take_ended();

  /// User and system time of everything that has run inside so far [s].
  double program_cpu_seconds() const;

  /// The room of an agent, for back-pressure: the caller must publish to it, see RoomPage.
  RoomPage& room(std::size_t agent);

  /// For lock-step: see programs/lockstep.
  WaitPage& waits(std::size_t agent);
  /// The agent's namespace of process numbers. @throws std::runtime_error  it is gone.
  FileDescriptor processes(std::size_t agent) const;

  /// Agents for which the kernel was to send messages of ICMP and did not, see icmp.h, and how
  /// many: packets that never came to wlan0.
  std::vector<std::pair<std::string, std::uint64_t>> icmp_not_sent() const;

  /// Whether the agent's kernel is to send something of TCP when a timer of the wall clock says so.
  bool has_tcp_timer(std::size_t agent) const;

  /// Frames that the kernel dropped because the TAP was full: a counter of wlan0. Must stay 0.
  std::uint64_t tx_dropped(std::size_t agent) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace programs::netns
