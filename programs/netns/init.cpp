#include "programs/netns/init.h"

#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/signalfd.h>
#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <bit>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <deque>
#include <fstream>
#include <map>
#include <set>

#include "programs/netns/agent_root.h"
#include "programs/netns/cpu_time.h"
#include "programs/netns/launch.h"
#include "programs/netns/message.h"
#include "programs/netns/packed.h"
#include "programs/netns/packed_agent.h"
#include "programs/netns/spaces.h"

namespace programs::netns {
namespace {

/// The number that a child has in the agent that it is in; 0: it is not known.
pid_t number_inside(pid_t child) {
  std::ifstream status(fmt::format("/proc/{}/status", child));
  for (std::string line; std::getline(status, line);) {
    if (!line.starts_with("NSpid:")) continue;
    return static_cast<pid_t>(std::strtol(line.c_str() + line.rfind('\t'), nullptr, 10));
  }
  return 0;
}

/// The first process of a run: makes the agents, starts and reaps programs. It ends when baraka
/// closes its end of the socket; the kernel then kills the rest.
class Init {
 public:
  Init(int control, int events) : control_(control), events_(events) {
    sigset_t all;
    sigfillset(&all);
    sigprocmask(SIG_SETMASK, &all, nullptr);
    sigset_t children;
    sigemptyset(&children);
    sigaddset(&children, SIGCHLD);
    children_.reset(signalfd(-1, &children, SFD_CLOEXEC | SFD_NONBLOCK));
  }

  void set_up() {
    mount_proc();
    const auto message = receive(control_);
    if (!message) return;
    Unpacker in(message->content);
    RunOfAgents run;
    run.time.is_held = in.number<int>() != 0;
    run.time.factor = std::bit_cast<double>(in.number());
    for (auto left = in.number(); left > 0; --left) run.agents.push_back(unpacked_agent(in));
    run.shown = in.texts();
    for (AgentMade& made : make_agents(run)) {
      Packer out;
      const AgentSpaces& spaces = made.spaces;
      for (const auto* one : {&spaces.users, &spaces.processes, &spaces.network, &spaces.mount,
                              &spaces.host, &spaces.ipc}) {
        out.put(one->get());
      }
      const std::array ends{made.ends.tap.get(), made.ends.counters.get(), made.ends.page.get(),
                            made.ends.tcp.get(), made.ends.tcp6.get()};
      send(control_, MessageKind::kAgent, out.bytes(), ends);
      agents_.push_back(std::move(made.spaces));
      firsts_.insert(made.init);
    }
    send(control_, MessageKind::kReady, "");
  }

  /// Serves until baraka is gone or has sent kEnd.
  void serve() {
    while (!is_over_) {
      const short wanted = unsaid_.empty() ? short{0} : short{POLLOUT};
      std::array<pollfd, 3> polled{pollfd{control_, POLLIN, 0}, pollfd{children_.get(), POLLIN, 0},
                                   pollfd{events_, wanted, 0}};
      if (poll(polled.data(), polled.size(), -1) < 0 && errno != EINTR) return;
      if (polled[1].revents != 0) reap();
      if ((polled[2].revents & POLLHUP) != 0) return;
      if (polled[2].revents != 0) say_one();
      if (polled[0].revents != 0) answer();
    }
    end_programs();
  }

 private:
  struct Program {
    std::uint64_t agent = 0;
    std::uint32_t number = 0;
  };

  void answer() {
    const auto message = receive(control_);
    is_over_ = !message || message->kind == MessageKind::kEnd;
    if (is_over_) return;
    if (message->kind == MessageKind::kGetCpu) {
      Packer out;
      out.put(cpu_time_of_programs());
      send(control_, MessageKind::kCpu, out.bytes());
    }
    if (message->kind == MessageKind::kGetIcmp) {
      Packer out;
      for (const AgentSpaces& one : agents_) out.put(icmp_not_sent_by(one));
      send(control_, MessageKind::kIcmp, out.bytes());
    }
    if (message->kind == MessageKind::kStart) start(*message);
  }

  void start(const Message& message) {
    try {
      Unpacker in(message.content);
      const auto agent = in.number();
      const Launch program{in.text(), in.texts(), in.texts(), in.text(), in.texts()};
      std::vector<int> inherited;
      for (std::size_t i = 1; i < message.descriptors.size(); ++i) {
        inherited.push_back(message.descriptors[i].get());
      }
      const pid_t child =
          launch(program, agents_.at(agent), message.descriptors.at(0).get(), inherited);
      programs_[child] = {agent, ++started_};
      Packer out;
      out.put(started_);
      out.put(number_inside(child));
      send(control_, MessageKind::kStarted, out.bytes());
    } catch (const std::exception& error) {
      send(control_, MessageKind::kRefused, error.what());
    }
  }

  void reap() {
    signalfd_siginfo info{};
    while (read(children_.get(), &info, sizeof info) > 0) continue;
    int status = 0;
    for (pid_t child = 0; (child = waitpid(-1, &status, WNOHANG)) > 0;) {
      const auto found = programs_.find(child);
      if (found == programs_.end()) continue;  // an orphan inside
      Packer out;
      out.put(found->second.agent);
      out.put(found->second.number);
      out.put(status);
      unsaid_.push_back(out.bytes());
      programs_.erase(found);
    }
  }

  /// Sends one message, when there is room: baraka may be waiting for a reply at the same time.
  void say_one() {
    if (unsaid_.empty()) return;
    send(events_, MessageKind::kEnded, unsaid_.front());
    unsaid_.pop_front();
  }

  /// @return whether there are processes other than the agents' first ones.
  bool reap_all() const {
    while (waitpid(-1, nullptr, WNOHANG) > 0) continue;
    const std::vector<pid_t> all = processes_inside();
    return std::ranges::any_of(all, [this](pid_t one) { return !firsts_.contains(one); });
  }

  void end_programs() const {
    constexpr std::chrono::seconds kGrace{10};  // of a busy computer, too, for journals
    kill(-1, SIGTERM);
    kill(-1, SIGCONT);
    const auto end = std::chrono::steady_clock::now() + kGrace;
    while (reap_all() && std::chrono::steady_clock::now() < end) {
      pollfd polled{children_.get(), POLLIN, 0};
      poll(&polled, 1, 50);  // ms
      signalfd_siginfo info{};
      while (read(children_.get(), &info, sizeof info) > 0) continue;
    }
  }

  int control_, events_;
  FileDescriptor children_;
  std::vector<AgentSpaces> agents_;
  std::set<pid_t> firsts_;  ///< The agents' first processes: start_first_of_agent().
  std::map<pid_t, Program> programs_;
  std::deque<std::string> unsaid_;
  std::uint32_t started_ = 0;
  bool is_over_ = false;
};

/// Tells baraka why it failed; if that cannot be sent, nothing else can be done.
int refuse(int control, const std::exception& error) {
  try {
    send(control, MessageKind::kRefused, error.what());
  } catch (const std::exception&) {
    return EXIT_FAILURE;
  }
  return EXIT_FAILURE;
}

int be_init(int control, int events, const FileDescriptor& holder) {
  prctl(PR_SET_NAME, "baraka-init");
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  pollfd polled{holder.get(), POLLIN, 0};
  if (poll(&polled, 1, 0) != 0) return EXIT_FAILURE;  // the holder died before the line above
  try {
    if (chdir("/") != 0) fail("/");
    Init init(control, events);
    init.set_up();
    init.serve();
    return EXIT_SUCCESS;
  } catch (const std::exception& error) {
    return refuse(control, error);
  }
}

}  // namespace

int hold(int control, int events, int parent) {
  fcntl(control, F_SETFD, FD_CLOEXEC);
  fcntl(events, F_SETFD, FD_CLOEXEC);
  std::array<int, 2> lifeline{};
  pid_t init = -1;
  std::string why_alone;
  try {
    why_alone = enter_new_run();
    prctl(PR_SET_PDEATHSIG, SIGKILL);  // not earlier: a change of user clears it
    if (getppid() != parent) return EXIT_FAILURE;
    if (pipe2(lifeline.data(), O_CLOEXEC) != 0) fail("a pipe");
    init = fork();
    if (init < 0) fail("the first process of the run");
  } catch (const std::exception& error) {
    return refuse(control, error);
  }
  if (init == 0) {
    close(lifeline[1]);
    raise_descriptor_limit();
    _exit(be_init(control, events, FileDescriptor(lifeline[0])));
  }
  close(lifeline[0]);
  Packer out;
  out.put(init);
  out.put(std::string_view(why_alone));
  try {
    send(control, MessageKind::kHolder, out.bytes());
  } catch (const std::exception&) {
    // baraka has died: init will notice it as well.
  }
  close(control);
  close(events);
  int status = 0;
  while (waitpid(init, &status, 0) < 0 && errno == EINTR) continue;
  return WIFEXITED(status) ? WEXITSTATUS(status) : EXIT_FAILURE;
}

}  // namespace programs::netns
