#include "programs/netns/namespaces.h"

#include <fmt/format.h>
#include <poll.h>

#include <array>
#include <bit>
#include <optional>
#include <sstream>

#include "programs/netns/addresses.h"
#include "programs/netns/clock_origin.h"
#include "programs/netns/holder.h"
#include "programs/netns/launch.h"
#include "programs/netns/loadable.h"
#include "programs/netns/mapped_page.h"
#include "programs/netns/message.h"
#include "programs/netns/packed.h"
#include "programs/netns/packed_agent.h"
#include "programs/netns/run_state.h"
#include "programs/netns/tcp_timers.h"

namespace programs::netns {
namespace {

/// Absolute paths, for a process with another working folder.
std::vector<std::string> texts_of(const std::vector<std::filesystem::path>& paths) {
  std::vector<std::string> texts;
  texts.reserve(paths.size());
  for (const auto& path : paths) {
    if (!path.empty()) texts.push_back(std::filesystem::absolute(path).string());
  }
  return texts;
}

/// @param shown  to the programs of all agents.
std::string packed(const Settings& settings, const std::vector<std::filesystem::path>& shown) {
  Packer out;
  out.put(settings.time.is_held);
  out.put(std::bit_cast<std::uint64_t>(settings.time.factor));
  out.put(settings.agents.size());
  for (const AgentNetwork& agent : settings.agents) pack(out, agent);
  out.put(texts_of(shown));
  return out.bytes();
}

void require_valid(const Settings& settings) {
  constexpr std::size_t kLongestName = 64;  // HOST_NAME_MAX
  if (settings.agents.empty()) throw std::runtime_error("no agent has a network");
  for (const AgentNetwork& agent : settings.agents) {
    const bool is_name = !agent.agent.empty() && agent.agent.size() <= kLongestName &&
                         agent.agent.find_first_of(" \t\n#/") == std::string::npos;
    if (!is_name) {
      throw std::runtime_error(
          fmt::format("agent '{}': a host's name has 1 to {} characters, and no blank, '/' or '#'",
                      agent.agent, kLongestName));
    }
  }
}

std::vector<std::string> variables_of_process() {
  std::vector<std::string> variables;
  for (char** one = environ; *one != nullptr; ++one) variables.emplace_back(*one);
  return variables;
}

std::string value_of(const std::vector<std::string>& environment, const std::string& name) {
  for (const std::string& variable : environment) {
    if (variable.starts_with(name + "=")) return variable.substr(name.size() + 1);
  }
  return "";
}

/// LD_PRELOAD is separated by blanks and colons.
std::filesystem::path preloadable(const std::filesystem::path& library) {
  if (library.string().find_first_of(" :") == std::string::npos) return library;
  throw std::runtime_error(fmt::format(
      "{} cannot be preloaded: no folder above it may have a blank or colon in its name",
      library.string()));
}

}  // namespace

struct Namespaces::State {
  explicit State(const Settings& given)
      : settings(given),
        library(preloadable(installed_file(
            given.programs, given.time.is_held ? "libbaraka_lockstep.so" : "libbaraka_dilate.so"))),
        dilation(dilation_from_now(given.time.is_held ? 1 : given.time.factor)),
        holder(installed_file(given.programs, "baraka-holder"), given.state_folder) {}

  /// Receives messages until everything has been made.
  void receive_agents() {
    try {
      std::vector<std::filesystem::path> shown = settings.shown;
      for (const auto& one : {settings.state_folder, library.parent_path()}) shown.push_back(one);
      send(holder.control(), MessageKind::kSetUp, packed(settings, shown));
    } catch (const std::exception&) {
      // It has ended, and has sent the reason.
    }
    bool is_ready = false;
    while (!is_ready || run.init.number == 0) {
      const Message message = answer();
      if (message.kind == MessageKind::kHolder) {
        Unpacker in(message.content);
        run.init = Process::of(in.number<pid_t>());
        why_alone = in.text();
      }
      if (message.kind == MessageKind::kAgent) add(message);
      is_ready = is_ready || message.kind == MessageKind::kReady;
    }
  }

  void add(const Message& message) {
    const AgentNetwork& network = settings.agents.at(agents.size());
    Unpacker in(message.content);
    RunState::Agent spaces{network.agent};
    for (int* one : {&spaces.users, &spaces.processes, &spaces.network, &spaces.mount, &spaces.host,
                     &spaces.ipc}) {
      *one = in.number<int>();
    }
    run.agents.push_back(spaces);
    const auto taken = [&message](std::size_t i) {
      return FileDescriptor(fcntl(message.descriptors.at(i).get(), F_DUPFD_CLOEXEC, 0));
    };
    agents.push_back(
        {taken(0), taken(1), MappedPage(message.descriptors.at(2)), taken(3), taken(4)});
    agents.back().page.waits().seed = settings.seed * 65'537 + network.id;
    (*agents.back().page)
        .set_interface({network.address, static_cast<std::uint32_t>(network.mtu),
                        link_local_address(network.id), unique_local_address(network.id)});
  }

  /// @throws std::runtime_error  what was refused, or that everything is gone.
  Message answer() {
    auto message = receive(holder.control());
    if (!message) throw std::runtime_error(kGone);
    if (message->kind == MessageKind::kRefused) throw std::runtime_error(message->content);
    return std::move(*message);
  }

  void write_state() {
    if (settings.state_folder.empty()) return;
    folder = open_file(settings.state_folder.string(), O_RDONLY | O_DIRECTORY);
    run.dilation = dilation;
    run.library = library.string();
    run.write(folder);
  }

  ~State() {
    if (folder.is_open()) unlinkat(folder.get(), kStateFile, 0);
    // Wakes up all that wait for room, so that they can end.
    for (const Agent& agent : agents) {
      constexpr std::uint32_t kEnough = 1'000'000'000;
      (*agent.page).publish((*agent.page).sent(), kEnough, kEnough);
    }
    try {
      send(holder.control(), MessageKind::kEnd, "");
    } catch (const std::exception&) {
      // It has ended already.
    }
  }
  State(const State&) = delete;
  State& operator=(const State&) = delete;

  struct Agent {
    FileDescriptor tap, counters;
    MappedPage page;
    FileDescriptor tcp, tcp6;
  };

  Settings settings;
  std::filesystem::path library;
  std::string dilation;
  Holder holder;
  RunState run;
  std::string why_alone;
  FileDescriptor folder;
  std::vector<Agent> agents;
};

Namespaces::Namespaces(const Settings& settings) {
  require_valid(settings);
  state_ = std::make_unique<State>(settings);
  state_->receive_agents();
  state_->write_state();
}

Namespaces::~Namespaces() = default;

const std::string& Namespaces::why_only_user_0() const { return state_->why_alone; }

int Namespaces::tap(std::size_t agent) const { return state_->agents.at(agent).tap.get(); }

Started Namespaces::start(std::size_t agent, const Command& command) {
  std::vector<std::string> given;
  for (const auto& [name, value] : command.environment)
    given.push_back(fmt::format("{}={}", name, value));
  if (command.slot) given.push_back(fmt::format("{}={}", kSlotVariable, *command.slot));
  const std::vector<std::string> environment = merged(variables_of_process(), given);
  if (command.arguments.empty()) throw std::runtime_error("a program has no name");
  const auto program = program_file(command.arguments[0], value_of(environment, "PATH"));
  require_preloaded(program, state_->settings.time);
  const std::filesystem::path folder =
      command.folder.empty() ? std::filesystem::current_path() : command.folder;
  Packer out;
  out.put(agent);
  out.put(std::string_view(program.native()));
  out.put(command.arguments);
  out.put(inside(environment, state_->library.string(), state_->dilation));
  out.put(std::string_view(folder.native()));
  std::vector<std::filesystem::path> shown = command.shown;
  for (const auto& one : {folder, command.log.parent_path()}) shown.push_back(one);
  out.put(texts_of(shown));
  const FileDescriptor log = open_file(command.log.string(), O_WRONLY | O_CREAT | O_APPEND, 0644);
  std::vector<int> descriptors{log.get()};
  descriptors.insert(descriptors.end(), command.inherited.begin(), command.inherited.end());
  send(state_->holder.control(), MessageKind::kStart, out.bytes(), descriptors);
  const Message answer = state_->answer();
  Unpacker in(answer.content);
  const auto number = in.number<std::uint32_t>();
  return {number, in.number<pid_t>()};
}

int Namespaces::descriptor() const { return state_->holder.events(); }

std::vector<Ended> Namespaces::take_ended() {
  std::vector<Ended> all;
  pollfd polled{descriptor(), POLLIN, 0};
  while (poll(&polled, 1, 0) > 0) {
    const auto message = receive(descriptor());
    if (!message && all.empty()) throw std::runtime_error(kGone);
    if (!message) break;
    Unpacker in(message->content);
    const auto agent = in.number<std::size_t>();
    const auto program = in.number<std::uint32_t>();
    all.push_back({agent, program, in.number<int>()});
  }
  return all;
}

double Namespaces::program_cpu_seconds() const {
  constexpr double kNanoseconds = 1e9;
  send(state_->holder.control(), MessageKind::kGetCpu, "");
  const Message message = state_->answer();
  return static_cast<double>(Unpacker(message.content).number<std::int64_t>()) / kNanoseconds;
}

std::vector<std::pair<std::string, std::uint64_t>> Namespaces::icmp_not_sent() const {
  send(state_->holder.control(), MessageKind::kGetIcmp, "");
  const Message message = state_->answer();
  Unpacker in(message.content);
  std::vector<std::pair<std::string, std::uint64_t>> counts;
  counts.reserve(state_->settings.agents.size());
  for (const AgentNetwork& agent : state_->settings.agents) {
    const std::uint64_t count = in.number();
    if (count > 0) counts.emplace_back(agent.agent, count);
  }
  return counts;
}

RoomPage& Namespaces::room(std::size_t agent) { return *state_->agents.at(agent).page; }

WaitPage& Namespaces::waits(std::size_t agent) { return state_->agents.at(agent).page.waits(); }

FileDescriptor Namespaces::processes(std::size_t agent) const {
  return open_file(fmt::format("/proc/{}/fd/{}", state_->run.init.number,
                               state_->run.agents.at(agent).processes),
                   O_RDONLY);
}

bool Namespaces::has_tcp_timer(std::size_t agent) const {
  const State::Agent& one = state_->agents.at(agent);
  return netns::has_tcp_timer(one.tcp.get()) || netns::has_tcp_timer(one.tcp6.get());
}

std::uint64_t Namespaces::tx_dropped(std::size_t agent) const {
  std::array<char, 4096> text{};
  const int file = state_->agents.at(agent).counters.get();
  const ssize_t length = pread(file, text.data(), text.size() - 1, 0);
  if (length < 0) fail("the counters of wlan0");
  std::istringstream lines(text.data());
  for (std::string line; std::getline(lines, line);) {
    const std::size_t name = line.find("wlan0:");
    if (name == std::string::npos) continue;
    // Eight counters of received packets come first; then bytes, packets, errors, dropped.
    constexpr int kBeforeDropped = 11;
    std::istringstream counters(line.substr(name + 6));
    std::uint64_t counter = 0;
    for (int i = 0; i <= kBeforeDropped; ++i) counters >> counter;
    return counter;
  }
  fail("the counters of wlan0", ENOENT);
}

}  // namespace programs::netns
