#include "sim/scenario/network_section.h"

#include <arpa/inet.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "sim/scenario/fields.h"
#include "sim/scenario/ip_routes.h"
#include "sim/scenario/program.h"

namespace sim::scenario {
namespace {

using agents::AgentConfig;
using air::NetworkConfig;

/// Default address: 10.77.hi.lo, from the 16 bits of an agent's address in the scenario.
constexpr std::uint32_t kDefaultNetwork = 10u << 24 | 77u << 16;

constexpr std::uint32_t host_bits(int prefix) { return 0xffffffffu >> prefix; }

/// Parses "10.77.0.3/16"; nullopt if the text is anything else.
std::optional<NetworkConfig> parsed(const std::string& text) {
  const std::size_t slash = text.find('/');
  if (slash == std::string::npos) return std::nullopt;
  in_addr address{};
  if (::inet_pton(AF_INET, text.substr(0, slash).c_str(), &address) != 1) return std::nullopt;
  NetworkConfig result{.address = ntohl(address.s_addr)};
  const char* const end = text.data() + text.size();
  const auto [rest, error] = std::from_chars(text.data() + slash + 1, end, result.prefix);
  if (error != std::errc{} || rest != end) return std::nullopt;
  return result;
}

/// What is wrong with it as the address of a host; empty if nothing is.
std::string complaint(const NetworkConfig& a) {
  if (a.prefix < air::kLeastPrefix || a.prefix > air::kMostPrefix) {
    return fmt::format("the prefix must be from {} to {}", air::kLeastPrefix, air::kMostPrefix);
  }
  const std::uint32_t first = a.address >> 24, host = a.address & host_bits(a.prefix);
  if (first == 0 || first == 127 || first >= 224) {
    return fmt::format("{} is not the address of a host on a network", dotted(a.address));
  }
  if (host == 0) return fmt::format("{} is the address of the network", dotted(a.address));
  if (host != host_bits(a.prefix)) return {};
  return fmt::format("{} is the broadcast address of the network", dotted(a.address));
}

std::string text_of(const NetworkConfig& network) {
  return fmt::format("{}/{}", dotted(network.address), network.prefix);
}

/// Address of the network itself, in host order.
std::uint32_t network_of(const NetworkConfig& network) {
  return network.address & ~host_bits(network.prefix);
}

void take_address(Fields& io, const std::string& text, NetworkConfig& c) {
  const auto address = parsed(text);
  const std::string wrong =
      address ? complaint(*address)
              : fmt::format("'{}' is not an IPv4 address with a prefix length, e.g. 10.77.0.3/16",
                            text);
  if (!wrong.empty()) return io.mistake("address", wrong);
  c.address = address->address;
  c.prefix = address->prefix;
}

/// The keys of the interface of the first agent.
void interface_keys(Fields& io, NetworkConfig& c) {
  io.spelled({"address",
              "IPv4 address of the first agent's interface and the prefix length of the network; "
              "the other agents have the addresses that follow.",
              "10.77.0.3/16", "10.77.h.l/16, where 256 h + l is the agent's address"},
             c, text_of, [&](const std::string& text, NetworkConfig& network) {
               take_address(io, text, network);
             });
  io.count(
      {"mtu", "Largest IP packet on the interface, in bytes; IPv6 needs at least 1280.", "1500"},
      air::kLeastMtu, air::kMostMtu, c.mtu);
  if (io.reading() != nullptr && c.mtu < air::kLeastMtuOfIpv6) {
    io.reading()->warn(
        "mtu", fmt::format("{} is below {}: there is no IPv6", c.mtu, air::kLeastMtuOfIpv6));
  }
}

constexpr std::array kUnknownWaits = {
    Option<air::UnknownWaits>{"fail", air::UnknownWaits::kFail},
    Option<air::UnknownWaits>{"allow", air::UnknownWaits::kAllow}};

void unknown_waits_key(Fields& io, NetworkConfig& c) {
  io.choice({"unknown_waits",
             "In lock-step, what to do with a program that blocks in a system call that lock-step "
             "does not support. fail: the run fails and names both; allow: simulated time goes on "
             "without the program until the call returns, at a time that depends on this computer; "
             "the result counts such calls and carries a warning.",
             "allow"},
            kUnknownWaits, c.unknown_waits);
}

void processor_keys(Fields& io, NetworkConfig& c) {
  constexpr Range kPerWake{0, 1};  // s
  io.duration({"per_wake",
               "In lock-step: simulated time that the agent's processor takes whenever a thread of "
               "its programs begins, or goes on after a wait, before the thread does anything. "
               "There is one processor: threads that are woken together go on one after the other.",
               "20 us"},
              kPerWake, c.per_wake);
}

bool reaches(const NetworkConfig& from, const NetworkConfig& to) {
  return network_of(from) == (to.address & ~host_bits(from.prefix));
}

/// Names that /etc/hosts maps to other addresses.
constexpr std::array<std::string_view, 4> kNamesOfHosts{"localhost", "ip6-localhost",
                                                        "ip6-loopback", "ip6-allnodes"};

void check_names(Fields& io, std::span<const AgentConfig> agents) {
  for (const AgentConfig& agent : agents) {
    if (std::ranges::find(kNamesOfHosts, agent.name) == kNamesOfHosts.end()) continue;
    io.mistake("", fmt::format("an agent with a network cannot be called '{}', which every host "
                               "has for an address of its own",
                               agent.name));
  }
}

/// The addresses and networks so far.
class NetworkCheck {
 public:
  /// @param in  the mapping of the agent's network, which may have routes.
  /// @return false if a mistake was noted.
  bool add(const AgentConfig& agent, Mapping& in) {
    const NetworkConfig& network = *agent.network;
    const auto [other, is_new] = taken_.try_emplace(network.address, &agent);
    if (!is_new) {
      in.mistake("address", fmt::format("{} of {} is the address of {}, too",
                                        dotted(network.address), agent.name, other->second->name));
      return false;
    }
    if (first_ == nullptr) first_ = &agent;
    const NetworkConfig& first = *first_->network;
    if (in.has("routes") || (reaches(network, first) && reaches(first, network))) return true;
    in.warn("address", fmt::format("{} of {} and {} of {} are of different networks: without "
                                   "routes they cannot reach each other",
                                   text_of(network), agent.name, text_of(first), first_->name));
    return false;
  }

 private:
  std::map<std::uint32_t, const AgentConfig*> taken_;
  const AgentConfig* first_ = nullptr;
};

}  // namespace

void network_keys(Fields& io, Group& group, std::span<AgentConfig> agents) {
  const std::uint32_t id = agents.empty() ? 1u : agents.front().id.value;
  NetworkConfig first{.address = kDefaultNetwork | id};
  if (!agents.empty()) first = agents.front().network.value_or(first);
  interface_keys(io, first);
  unknown_waits_key(io, first);
  io.inside({"cpu", "What the agent's programs take of its processor in lock-step."},
            [&](Fields& processor) { processor_keys(processor, first); });
  ip_routes_key(io, group.ip_routes);
  if (io.reading() == nullptr) return;
  check_names(io, agents);
  NetworkConfig last = first;
  for (AgentConfig& agent : agents) {
    last.address = first.address + static_cast<std::uint32_t>(&agent - agents.data());
    agent.network = last;
  }
  const std::string wrong = network_of(last) == network_of(first)
                                ? complaint(last)
                                : fmt::format("{} is outside the network", dotted(last.address));
  if (!wrong.empty()) {
    io.mistake("address", fmt::format("{}, for the last of {} agents", wrong, agents.size()));
  }
}

void check_networks(Mapping& in, const Scenario& scenario) {
  const auto& all = scenario.simulation.agents;
  NetworkCheck check;
  Mapping agents = in.within("agents");
  for (const Group& group : scenario.groups) {
    for (const hal::AgentId id : group.agents) {
      const auto agent = std::ranges::find(all, id, &AgentConfig::id);
      if (agent == all.end() || !agent->network) continue;
      Mapping network = agents.within(group.name).within("network");
      if (!check.add(*agent, network)) break;  // the others would have the same mistake
    }
  }
}

}  // namespace sim::scenario
