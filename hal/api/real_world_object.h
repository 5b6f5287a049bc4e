#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "hal/types/agent_id.h"
#include "hal/types/channel.h"
#include "hal/types/geometry.h"
#include "hal/types/log.h"
#include "hal/types/message.h"
#include "hal/types/priority.h"
#include "hal/types/random.h"
#include "hal/types/record.h"
#include "hal/types/result.h"
#include "hal/types/route.h"
#include "hal/types/time.h"

namespace hal {

/// The agent's view of its network: routes and neighbours to which its controller subscribes (Wants
/// in controller.h), as of the event being handled.
class Network {
 public:
  virtual ~Network() = default;

  /// Routes of one message class to one destination, by next hop; empty if there is none.
  /// Classes the controller does not watch are always empty.
  virtual std::vector<Route> routes(std::string_view topic, AgentId destination) const = 0;

  /// Nodes heard directly, by address; empty unless the controller subscribes to neighbours.
  virtual const std::vector<Neighbour>& neighbours() const = 0;

  /// Forgets every route of the class to the destination, at this node only.
  /// Errors: kInvalidArgument (topic empty or too long).
  virtual Result<void> invalidate(std::string_view topic, AgentId destination) = 0;
};

/// An agent with a radio: the common interface of motes and robots.
///
/// Call these functions only from within a callback of the controller, on the thread that runs it;
/// any other call throws std::logic_error. SI units, radians, x forward, y left, z up.
class RealWorldObject {
 public:
  virtual ~RealWorldObject() = default;

  /// Address of this agent, 1..kLastAddress.
  virtual AgentId id() const = 0;
  /// Name of this agent, for people; valid for the life of the controller.
  virtual std::string_view name() const = 0;
  virtual Time now() const = 0;                 ///< Time of the event being handled.
  virtual Duration control_period() const = 0;  ///< Time between two calls of Controller::step().

  /// The only network interface on which this controller may open its own sockets and DDS
  /// participants: in the simulator "wlan0" if the controller runs inside the agent's network, on
  /// hardware the card that the agent's file names for it. Packets sent there use the radio. Empty:
  /// there is none. Valid for the life of the controller.
  virtual std::string_view air_interface() const = 0;

  /// Address of the agent with this name; nullopt if it is unknown. The simulator knows every agent
  /// of the run, a daemon its own and those on the map of its file. Only for controllers that
  /// request names (Wants::names); for others always nullopt, which is logged once.
  virtual std::optional<AgentId> address_of(std::string_view name) const = 0;
  /// Name of the agent with this address, under the same conditions; valid for the life of the
  /// controller.
  virtual std::optional<std::string_view> name_of(AgentId agent) const = 0;

  /// Sends `payload` to one agent over any number of hops, to kEveryone by flooding, or to
  /// kNeighbours by one broadcast. Controller::notice reports the result.
  /// @param destination  an agent, kEveryone or kNeighbours.
  /// @param topic    message class, 1..kMaxTopic bytes.   @param payload  0..kMaxPayload bytes.
  /// @param options  its priority: send(to, "alarm", payload, {.priority = Priority::kVoice}).
  ///   The agent's file may give the messages of a topic another one. It decides which messages go
  ///   first where a radio keeps access categories apart (`qos`); elsewhere it has no effect.
  /// Errors: kInvalidArgument (sizes; the destination is this agent itself; this agent already uses
  /// kMaxTopics other topics; no such priority).
  virtual Result<MessageId> send(AgentId destination, std::string_view topic,
                                 std::span<const std::uint8_t> payload,
                                 const SendOptions& options = {}) = 0;

  /// Routes and neighbours to which this controller subscribes.
  virtual Network& network() = 0;
  virtual const Network& network() const = 0;  ///< The same, read-only.

  /// Controller::timer(id) is called at `at`. Setting the same id again moves it.
  /// Errors: kInvalidArgument (`at` is before now()).
  virtual Result<void> set_timer(TimerId id, Time at) = 0;

  /// The channels that this agent offers to this controller.
  virtual std::span<const Channel> channels() const = 0;

  /// Latest values of a channel, held until the next sample. Valid until the callback returns.
  /// Errors: kNotAvailable (no such channel, not asked for, not sampled yet, or lost: on hardware
  /// the last sample is older than the `stale_after` of the agent's file; in the simulator the
  /// agent's battery was empty and has switched it off).
  virtual Result<std::span<const double>> reading(std::string_view channel) const = 0;

  /// Position of another agent relative to this one, in this body's frame [m].
  /// Errors: kNotAvailable (no localisation on this agent, or it is lost; the other is out of its
  /// range).
  virtual Result<Vec2> relative_position(AgentId other) const = 0;

  /// State of charge, 0..1, of this battery's capacity. Use battery_energy() to compare agents or
  /// to estimate a range. Errors: kNotAvailable (the agent has no battery gauge).
  virtual Result<double> battery() const = 0;

  /// Energy in the battery now, J. Errors: kNotAvailable (no battery gauge, or one that does not
  /// know it).
  virtual Result<double> battery_energy() const = 0;

  /// Energy in the battery when it is full, J. Errors: as of battery_energy().
  virtual Result<double> battery_capacity() const = 0;

  /// Switches the radio on or off. Switching it off cuts the frame on the air short and drops the
  /// queue.
  virtual void set_radio(bool on) = 0;

  /// This agent's own random stream; equal seeds give equal numbers.
  virtual RandomStream& random() = 0;

  /// Declares the state of the controller, for the results and for end conditions.
  /// @param name  1..kMaxRecordedName bytes, longer names are cut. One of ControllerKind::states,
  ///   if it declares any: other names are refused, which is logged once.
  virtual void state(std::string_view name) = 0;

  /// Records a number in the results (table `recorded`) and publishes it for tools
  /// (rt/baraka/values), with the time now(): record("distance", 0.35).
  /// @param name  1..kMaxRecordedName bytes, none of them zero; an agent may use kMaxRecordedNames
  ///   names. One of ControllerKind::records, if it declares any.
  /// @param value  finite. Other names and values are refused, which is logged once.
  virtual void record(std::string_view name, double value) = 0;

  /// Writes one line to the log of the run, or of the daemon, with the time of now().
  virtual void log(log::Level level, std::string_view text) = 0;
};

/// An agent without wheels: a sensor node or a station.
class Mote : public RealWorldObject {};

}  // namespace hal
