// A run without a simulator: namespaces whose interfaces are joined by a wire. Each station has a
// queue of frames that it sends one after the other at a bit rate; all others hear them.
//
//   wire NAME=ADDRESS/PREFIX… [--mtu M] [--factor F] [--rate BITS] [--queue N] [--state DIR]
//       [--programs DIR]
//
// BITS per second of the programs' time. Reads from its input, one command per line, words parted
// by tabs, and answers each on its output with a line:
//   start AGENT LOG WORD…   started N | refused WHY
//   cpu | dropped AGENT | loaded AGENT | refusals AGENT    a number
// In between: `ended AGENT N STATUS`. Ends with its input.
#include <arpa/inet.h>
#include <fmt/core.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <map>
#include <string>
#include <vector>

#include "programs/netns/namespaces.h"

namespace {

using programs::netns::Namespaces;
using Clock = std::chrono::steady_clock;
using Frame = std::vector<unsigned char>;

struct Line {
  programs::netns::Settings settings;
  double rate = 0;  // bit/s of wall time; 0: at once
  std::size_t queue = 64;
};

struct Station {
  std::deque<Frame> queue;
  Clock::time_point free_at;  // when what is being sent has been sent
  std::uint64_t refusals = 0;
  bool is_outstanding = false;
};

std::vector<std::string> words_of(const std::string& line) {
  std::vector<std::string> words{""};
  for (const char letter : line) {
    if (letter == '\t') {
      words.emplace_back();
    } else {
      words.back() += letter == '\x1e' ? '\n' : letter;
    }
  }
  return words;
}

programs::netns::AgentNetwork network_of(const std::string& text, std::size_t index) {
  const std::size_t equals = text.find('='), slash = text.find('/');
  in_addr address{};
  if (slash == std::string::npos ||
      inet_pton(AF_INET, text.substr(equals + 1, slash - equals - 1).c_str(), &address) != 1) {
    throw std::runtime_error("not NAME=ADDRESS/PREFIX: " + text);
  }
  programs::netns::AgentNetwork network;
  network.agent = text.substr(0, equals);
  network.id = static_cast<std::uint16_t>(index + 1);
  network.address = ntohl(address.s_addr);
  network.prefix = std::stoi(text.substr(slash + 1));
  return network;
}

Line line_of(int argc, char** argv) {
  Line line;
  double rate = 0;
  int mtu = 1500;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (!word.starts_with("--")) {
      line.settings.agents.push_back(network_of(word, line.settings.agents.size()));
      continue;
    }
    const std::string value = ++i < argc ? argv[i] : "";
    if (word == "--mtu") mtu = std::stoi(value);
    if (word == "--factor") line.settings.time.factor = std::stod(value);
    if (word == "--rate") rate = std::stod(value);
    if (word == "--queue") line.queue = static_cast<std::size_t>(std::stoi(value));
    if (word == "--programs") line.settings.programs = value;
    if (word == "--state") line.settings.state_folder = value;
  }
  for (auto& agent : line.settings.agents) agent.mtu = mtu;
  line.rate = rate * line.settings.time.factor;
  return line;
}

class Wire {
 public:
  explicit Wire(const Line& line)
      : line_(line), run_(line.settings), stations_(line.settings.agents.size()) {
    for (std::size_t i = 0; i < stations_.size(); ++i) drain(i);
    say("ready");
  }

  void run() {
    while (!is_over_) {
      std::vector<pollfd> polled{{STDIN_FILENO, POLLIN, 0}, {run_.descriptor(), POLLIN, 0}};
      for (std::size_t i = 0; i < stations_.size(); ++i) polled.push_back({run_.tap(i), POLLIN, 0});
      const auto wait = std::chrono::ceil<std::chrono::nanoseconds>(until_next());
      const timespec time{wait.count() / 1'000'000'000, wait.count() % 1'000'000'000};
      ppoll(polled.data(), polled.size(), &time, nullptr);
      if (polled[0].revents != 0) read_input();
      if (polled[1].revents != 0) {
        for (const auto& ended : run_.take_ended()) {
          say(fmt::format("ended {} {} {}", ended.agent, ended.program, ended.status));
        }
      }
      for (std::size_t i = 0; i < stations_.size(); ++i) {
        send_due(i);
        if (polled[i + 2].revents != 0 || stations_[i].is_outstanding) drain(i);
      }
    }
  }

 private:
  static void say(const std::string& text) {
    std::puts(text.c_str());
    std::fflush(stdout);
  }

  Clock::duration until_next() const {
    Clock::duration wait = std::chrono::milliseconds(200);
    const auto now = Clock::now();
    for (const Station& station : stations_) {
      if (!station.queue.empty()) wait = std::min(wait, station.free_at - now);
      if (station.is_outstanding)
        wait = std::min<Clock::duration>(wait, std::chrono::milliseconds(1));
    }
    return std::max(wait, Clock::duration::zero());
  }

  Clock::duration time_of(const Frame& frame) const {
    if (line_.rate == 0) return Clock::duration::zero();
    return std::chrono::duration_cast<Clock::duration>(
        std::chrono::duration<double>(static_cast<double>(frame.size()) * 8 / line_.rate));
  }

  /// As the run does: what was sent before is in the queue when its room is told.
  void drain(std::size_t i) {
    Station& station = stations_[i];
    const std::uint64_t sent = run_.room(i).sent();
    std::array<unsigned char, 65536> bytes{};
    for (ssize_t n = 0; (n = read(run_.tap(i), bytes.data(), bytes.size())) > 0;) {
      if (station.queue.size() >= line_.queue) {
        ++station.refusals;
        continue;
      }
      station.queue.emplace_back(bytes.data(), bytes.data() + n);
      if (station.queue.size() == 1) station.free_at = Clock::now() + time_of(station.queue[0]);
    }
    publish(i, sent);
    send_due(i);
  }

  void publish(std::size_t i, std::uint64_t sent) {
    const auto room = static_cast<std::uint32_t>(line_.queue - stations_[i].queue.size());
    stations_[i].is_outstanding =
        run_.room(i).publish(sent, room, static_cast<std::uint32_t>(line_.queue));
  }

  void send_due(std::size_t i) {
    Station& station = stations_[i];
    const auto now = Clock::now();
    bool has_sent = false;
    while (!station.queue.empty() && station.free_at <= now) {
      deliver(i, station.queue.front());
      station.queue.pop_front();
      has_sent = true;
      if (!station.queue.empty()) station.free_at += time_of(station.queue.front());
    }
    if (has_sent) drain(i);
  }

  void deliver(std::size_t from, const Frame& frame) {
    const bool is_group = (frame[0] & 1) != 0;
    for (std::size_t i = 0; i < stations_.size(); ++i) {
      const auto id = line_.settings.agents[i].id;
      const std::array<unsigned char, 6> mac{
          2, 0, 0, 0, static_cast<unsigned char>(id >> 8), static_cast<unsigned char>(id)};
      if (i == from || (!is_group && !std::equal(mac.begin(), mac.end(), frame.begin()))) continue;
      if (write(run_.tap(i), frame.data(), frame.size()) < 0 && errno != EIO) {
        say(fmt::format("error {}", std::strerror(errno)));
      }
    }
  }

  void read_input() {
    std::array<char, 4096> bytes{};
    const ssize_t n = read(STDIN_FILENO, bytes.data(), bytes.size());
    is_over_ = n <= 0;
    if (n > 0) input_.append(bytes.data(), static_cast<std::size_t>(n));
    for (std::size_t end = 0; (end = input_.find('\n')) != std::string::npos;) {
      obey(words_of(input_.substr(0, end)));
      input_.erase(0, end + 1);
    }
  }

  void obey(const std::vector<std::string>& words) {
    const std::size_t agent = words.size() > 1 ? std::stoul(words[1]) : 0;
    if (words[0] == "cpu") say(fmt::format("{}", run_.program_cpu_seconds()));
    if (words[0] == "dropped") say(fmt::format("{}", run_.tx_dropped(agent)));
    if (words[0] == "loaded") say(fmt::format("{}", run_.room(agent).loaded()));
    if (words[0] == "refusals") say(fmt::format("{}", stations_.at(agent).refusals));
    if (words[0] != "start") return;
    programs::netns::Command command;
    command.log = words.at(2);
    command.arguments.assign(words.begin() + 3, words.end());
    try {
      say(fmt::format("started {}", run_.start(agent, command).program));
    } catch (const std::exception& error) {
      say(fmt::format("refused {}", error.what()));
    }
  }

  Line line_;
  Namespaces run_;
  std::vector<Station> stations_;
  std::string input_;
  bool is_over_ = false;
};

}  // namespace

int main(int argc, char** argv) {
  try {
    Wire(line_of(argc, argv)).run();
    return EXIT_SUCCESS;
  } catch (const std::exception& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return EXIT_FAILURE;
  }
}
