#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "programs/netns/room_page.h"

namespace programs::netns {

/// The file in the results folder by which `baraka exec` finds a run. There as long as the run.
inline constexpr const char* kStateFile = "namespaces.txt";

/// An agent's interface `wlan0`: an Ethernet card to programs, with MAC address 02:00:00:00:hh:ll.
struct AgentNetwork {
  std::string agent;          ///< Its name: the host's name inside, and in everybody's /etc/hosts.
  std::uint16_t id = 0;       ///< hh:ll of the MAC address.
  std::uint32_t address = 0;  ///< IPv4, host order. Unique in the run.
  int prefix = 16;            ///< Bits of the address that are the network's, 8 .. 30.
  int mtu = 1500;             ///< Bytes of IP, 576 .. 2296. Below 1280 there is no IPv6.
};

struct Settings {
  std::vector<AgentNetwork> agents;  ///< At least one.
  double factor = 1;                 ///< Of the programs' time, 0.01 .. 1, see programs/preload.
  /// Results folder, for kStateFile; empty: none is written. May be renamed while the run lives.
  std::filesystem::path state_folder;
  /// Files and folders of the host's /tmp, /run and /dev/shm that all programs see: see Namespaces.
  std::vector<std::filesystem::path> shown;
  /// Where baraka-holder and libbaraka_dilate.so are; empty: where this program is, or in the
  /// folder ../lib/baraka beside it.
  std::filesystem::path programs;
};

/// A program to start inside an agent.
struct Command {
  std::vector<std::string> arguments;  ///< The first is the program, looked for in PATH.
  std::vector<std::pair<std::string, std::string>> environment;  ///< Beside this process's own.
  std::filesystem::path log;     ///< Its standard output and error are appended here.
  std::filesystem::path folder;  ///< Where it works; empty: this process's.
  /// Of the host's /tmp, /run and /dev/shm, beside what all programs see: see Namespaces.
  std::vector<std::filesystem::path> shown{};
  /// Descriptors of this process that it keeps, numbered from 3 on in this order. The library's
  /// and the C library's own start above them.
  std::vector<int> inherited;
};

/// A program that has ended.
struct Ended {
  std::size_t agent = 0;
  std::uint32_t program = 0;  ///< As start() has returned it.
  int status = 0;             ///< As of waitpid().
};

/// The namespaces of a run: for each agent a network of its own with `lo` and `wlan0`, whose other
/// end is a TAP in this process; and the programs inside. This process itself stays where it is.
///
///   baraka ── fork, exec ── baraka-holder ── fork ── init: process 1 of the run
///     │ TAPs, pages                                    ├─ process 1 of r0, programs of r0
///     └──────── two sockets ───────────────────────────┴─ process 1 of r1, programs of r1, …
///
/// All of it ends with this object, and with this process, whatever ends it: init ends when its
/// socket closes, and then the kernel ends everything inside, also what has daemonised. Each agent
/// has process numbers of its own, and its own `/tmp` and `/dev/shm` (1 GiB at most each) and
/// `/run` (256 MiB; with the host's folders, empty). Of the host's, programs see Settings::shown,
/// the results folder, the folder in which they work, and that of their own file, unless that is
/// one of these three itself. All names of agents resolve, in IPv4 and IPv6. The kernel's own
/// timers of neighbours, fragments and multicast groups are stretched by 1/factor; those of TCP are
/// not.
///
/// Programs run as user 0 of the agent's own user namespace, which is the caller outside, and have
/// `libbaraka_dilate.so` preloaded at every factor; what other users there are, IdMapper says. What
/// is mounted cannot be unmounted inside; /sys is read-only, and so is all of /proc but what is the
/// processes' or the network's. No privilege is needed but read-write access
/// to /dev/net/tun and leave to make user namespaces.
///
/// One thread; it must live as long as this, for the kernel ends the holder with it.
class Namespaces {
 public:
  /// Makes them; some milliseconds per agent. @throws std::runtime_error  one sentence: what is
  ///   missing or refused, and how to allow it.
  explicit Namespaces(const Settings& settings);
  /// Ends everything inside: SIGTERM, after 2 s SIGKILL; waits until it is gone.
  ~Namespaces();
  Namespaces(const Namespaces&) = delete;
  Namespaces& operator=(const Namespaces&) = delete;

  /// Why no program can become another user than 0, for people; empty: it can.
  const std::string& why_only_user_0() const;

  /// The other end of the agent's wlan0, owned by this, non-blocking: each read and write is one
  /// Ethernet frame, checksums complete, without FCS. @param agent  index in Settings::agents.
  int tap(std::size_t agent) const;

  /// Starts a program inside an agent; it has a session of its own and runs when this returns.
  /// @return its number, from 1 on. @throws std::runtime_error  it is not found, is no program,
  ///   or cannot be slowed at a factor other than 1 (statically linked, another machine's).
  std::uint32_t start(std::size_t agent, const Command& command);

  /// Readable when a program has ended, or the namespaces have.
  int descriptor() const;
  /// Those that have ended since it was asked last, each once.
  /// @throws std::runtime_error  "the namespaces of the run are gone": something killed them.
  std::vector<Ended> take_ended();

  /// User and system time of all that has run inside so far, s.
  double program_cpu_seconds() const;

  /// For back-pressure: to be published to, see there.
  RoomPage& room(std::size_t agent);

  /// Agents for which the kernel was to send messages of ICMP and did not, see icmp.h, and how
  /// many: packets that never came to wlan0.
  std::vector<std::pair<std::string, std::uint64_t>> icmp_not_sent() const;

  /// Frames that the kernel dropped because the TAP was full: the counter of wlan0. Must stay 0.
  std::uint64_t tx_dropped(std::size_t agent) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace programs::netns
