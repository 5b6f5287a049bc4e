#include "sim/scenario/resolved.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "sim/scenario/plan.h"

namespace sim::scenario {
namespace {

namespace fs = std::filesystem;

/// Every key that a reader knows, with a value that is not its default.
constexpr const char* kEverything = R"(
version: 1
name: everything
seed: 9223372036854775807
controller_latency: 1234567 ns
control_phase: aligned
control_period: 50 ms
command_timeout: 400 ms
lateness_limit: 2 ms
on_death: silence
reply_timeout: none
wait: 12 s
link: udp_like
record: {frames: all, messages: none, samples: all, pose_period: 250 ms, air: heard.pcapng, air_heard_by: x00}
world:
  physics:
    {step: 5 ms, gravity: 1.62 m/s^2, erp: 0.3, cfm: 1e-7, surface_layer: 0.2 mm,
     max_correcting_velocity: 0.2 m/s, ground_friction: 0.4, jam_contacts: 9, jam_robots: 5}
  materials: [{name: door, loss: 2.5 dB, loss_5ghz: 3.5 dB}]
  walls: [{name: w, size: [1 m, 2 m, 3 m], position: [4 m, 5 m], yaw: 10 deg, friction: 0.7, material: door,
           radio_loss: {per_crossing: 15 dB, per_metre: 2 dB/m}}]
  boxes: [{size: [1 m, 1 m, 0.1 m], position: [-4 m, -5 m]}]
radio:
  profile: mobility_framework
  tx_power: 3 dBm
  wavelength: 12.4 cm
  path_loss_exponent: 2.5
  propagation_delay: true
  obstacles: true
  antenna_height: 1.5 m
  antenna_gain: 1 dB
  channel: 6
  loss:
    probability: 0.25
    links: [{from: "x*", to: cart0, probability: 0.5}, {from: cart0, to: x03, probability: 1}]
  body_loss_per_crossing: 5 dB
  body_loss_per_metre: 10 dB/m
  propagation:
    - {model: log_distance, reference_loss: 40 dB, reference_distance: 2 m, exponent: 2.7}
    - {model: shadowing, sigma: 7 dB, decorrelation_distance: 9 m}
    - {model: nakagami, m_near: 4, m_middle: 3, m_far: 2, middle_from: 50 m, far_from: 60 m,
       scatterer_speed: 0.5 m/s}
  sensitivity: -84 dBm
  interference_floor: -100 dBm
  noise_floor: -109.5 dBm
  cca_threshold: -83 dBm
  energy_detection: -82 dBm
  data_rate: 2 Mb/s
  control_rate: 5.5 Mb/s
  broadcast_rate: 2 Mb/s
  preamble: short
  rounding: microsecond
  lengths: bytes
  fixed_header_bits: 271
  fixed_payload_bits: 8
  error_model: dsss
  min_sinr: 3 dB
  preamble_window: 4 us
  capture_margin: 5 dB
  slot: 9 us
  sifs: 16 us
  cw_min: 15
  cw_max: 511
  cw_broadcast: 63
  rts_threshold: 400
  short_retry_limit: 6
  queue_limit: 13
routing:
  {beta: 3, direct_weight: 1e5, jitter_max: 90 ms, retry_period: 4 s, retry_jitter: 0.3,
   retries: 2, acceptance: 1.4, accept_anywhere: true, hop_limit: 29, buffer_limit: 63, buffer_age: 9 s,
   ack_timeout: 40 ms, ack_attempts: 3, hello_period: 900 ms, hello_limit: 5,
   control_priority: 6}
priorities: {alarm: voice, images: 1, cam.1: 7}
localisation: {range: none}
agents:
  odd:
    name: x0{}
    address: 300
    mote: {model: brick, size: [1 cm, 2 cm, 3 cm], mass: 7 g, friction: 0.1}
    radio:
      tx_power: 0.5 mW
      antenna_height: 30 cm
      antenna_gain: 3 dB
      channel: 11
      overrides:
        - {agents: "x01", channel: 3, data_rate: 1 Mb/s, control_rate: 2 Mb/s,
           broadcast_rate: 5.5 Mb/s, tx_power: 7 mW}
    grid: {columns: 2, rows: 2, spacing: [1 m, 2 m], origin: [-1 m, -1 m], yaw: 5 deg}
    controller:
      program: help_mote
      processes: 2
      parameters: {help_at: never, repeat_after: 20 s, friends: [r1, "a, b", -1 m], none: [],
                   deep: {size: 3, more: {x: [1 s], y: true}}}
      overrides:
        - {agents: "x0?", parameters: {help_at: 3 s, deep: {size: 4}}}
  cart:
    address: 7
    robot:
      model: cart
      link:
        friction: 0.31
        collision:
          - {cylinder: {radius: 0.3 m, bottom: 0.1 m, top: 0.2 m, centre: [1 cm, 2 cm]}, mass: 3 kg}
          - {box: {size: [0.1 m, 0.2 m, 0.3 m], centre: [0 m, 1 cm, 0.4 m], yaw: 1 rad}, mass: 1 kg}
      wheels:
        wheel: {radius: 3 cm, mass: 100 g, mu: 0.5, mu2: 0.01, limit: {effort: 2 N m, velocity: 9 rad/s}}
        joints:
          - {position: [0.2 m, 0 m], axis: 1 deg}
          - {distance: 0.2 m, bearing: 120 deg, mu: 0.55}
          - {distance: 0.2 m, bearing: 240 deg, limit: {effort: 3 N m}}
      acceleration:
        {linear_up: 1 m/s^2, linear_down: 2 m/s^2, angular_up: 3 rad/s^2, angular_down: 4 rad/s^2}
      encoder_steps: 2048
      infrared:
        sensor:
          height: 5 cm
          half_angle: 3 deg
          noise_sigma: 1 mV
          hold_period: 20 ms
          curve: table
          table: [{distance: 10 cm, output: 2 V}, {distance: 50 cm, output: 1 V}]
          converter: {bits: 12, full_scale: 3.3 V}
        mounts: [{position: [0.1 m, 0.1 m]}, {distance: 0.1 m, bearing: 90 deg, curve: gp2d120}]
    poses: [{x: 1 m, y: 2 m, yaw: -30 deg}]
    controller: {program: help_robot, inside: true}
    network: {address: 192.168.7.9/24, mtu: 1400, unknown_waits: allow, cpu: {per_wake: 20 us}}
  desk:
    address: 517
    station: {}
    poses: [{x: 1 m, y: 9 m}, {x: 2 m, y: 9 m}]
    network: {}
    programs:
      - {name: late, command: [sh, -c, "echo 'a {b}: {agent} # $X' \\"], start: 1500 ms,
         environment: {X: "{number}, 5", Y: ""}, log: "l{number}.log", on_exit: end,
         shown: ["/tmp/{agent}", /run/user]}
      - {name: early, command: [cat, "{results}/x"], on_exit: fail}
end:
  - {agent: x03, state: DONE, after: 20 ms, result: good}
  - {at: 99 s, result: bad}
expect:
  - {result: good}
  - {distance: [x00, cart0], below: 3.5 m}
  - {distance: [x0*, cart0], below: 4 m, entered: DONE}
)";

class Resolved : public testing::Test {
 protected:
  Resolved() : file_(fs::path(testing::TempDir()) / ("resolved_" + std::to_string(::getpid()))) {}
  ~Resolved() override { fs::remove(file_); }

  Scenario load(const std::string& text) const {
    std::ofstream(file_) << text;
    return load_scenario(file_);
  }

  fs::path file_;
};

// Once read and written, nothing may change any more; and what is read the second time must be what
// the user wrote, which the next tests look at field by field.
TEST_F(Resolved, ReadsBackToTheSameText) {
  const std::string once = resolved_yaml(load(kEverything));
  EXPECT_EQ(resolved_yaml(load(once)), once);
}

TEST_F(Resolved, KeepsTheRun) {
  const Scenario scenario = load(resolved_yaml(load(kEverything)));
  const auto& c = scenario.simulation;
  EXPECT_EQ(scenario.name, "everything");
  EXPECT_EQ(c.seed, 9223372036854775807u);
  EXPECT_EQ(c.controller_latency, 1234567ns);
  EXPECT_EQ(c.control_phase, agents::ControlPhase::kAligned);
  EXPECT_EQ(c.control_period, 50ms);
  EXPECT_EQ(c.command_timeout, 400ms);
  EXPECT_EQ(c.lateness_limit, 2ms);
  EXPECT_EQ(c.on_death, agents::OnDeath::kSilence);
  EXPECT_EQ(scenario.reply_timeout, std::nullopt);
  EXPECT_EQ(scenario.wait, 12s);
  EXPECT_EQ(c.link, agents::LinkKind::kUdpLike);
  EXPECT_EQ(scenario.record.frames, Detail::kAll);
  EXPECT_EQ(scenario.record.messages, Detail::kNone);
  EXPECT_EQ(scenario.record.samples, Detail::kAll);
  EXPECT_EQ(scenario.record.pose_period, 250ms);
  EXPECT_EQ(scenario.record.air, "heard.pcapng");
  EXPECT_EQ(scenario.record.air_heard_by, c.agents.at(1).id);
  EXPECT_TRUE(std::isinf(c.localisation.range.value));
}

TEST_F(Resolved, KeepsNetworksAndPrograms) {
  const Scenario scenario = load(resolved_yaml(load(kEverything)));
  const auto network = [&](std::uint16_t id) {
    return std::ranges::find(scenario.simulation.agents, hal::AgentId{id}, &agents::AgentConfig::id)
        ->network;
  };
  EXPECT_EQ(network(7),
            (air::NetworkConfig{0xc0a80709, 24, 1400, air::UnknownWaits::kAllow, 20us}));
  EXPECT_EQ(network(517), (air::NetworkConfig{0x0a4d0205, 16, 1500}));
  EXPECT_EQ(network(518), (air::NetworkConfig{0x0a4d0206, 16, 1500}));
  EXPECT_EQ(network(300), std::nullopt);
  const Group& desk = scenario.groups.at(2);
  EXPECT_EQ(desk.program, "");
  ASSERT_EQ(desk.programs.size(), 2u);
  EXPECT_EQ(desk.programs[0].command,
            (std::vector<std::string>{"sh", "-c", "echo 'a {b}: {agent} # $X' \\"}));
  EXPECT_EQ(desk.programs[0].start, 1500ms);
  EXPECT_EQ(desk.programs[0].environment,
            (std::vector<std::pair<std::string, std::string>>{{"X", "{number}, 5"}, {"Y", ""}}));
  EXPECT_EQ(desk.programs[0].on_exit, OnExit::kEnd);
  EXPECT_EQ(desk.programs[1].on_exit, OnExit::kFail);
  EXPECT_EQ(desk.programs[1].log, "{agent}.early.log");
}

TEST_F(Resolved, KeepsWhichControllersAreInside) {
  const Scenario scenario = load(resolved_yaml(load(kEverything)));
  const auto& agents = scenario.simulation.agents;
  for (const agents::AgentConfig& agent : agents) EXPECT_EQ(agent.inside, agent.id.value == 7);
  for (const ProcessPlan& plan : plan_processes(scenario)) {
    EXPECT_EQ(plan.inside, plan.agents.front().value == 7);
  }
}

TEST_F(Resolved, PlansProgramsByTheirStartWithTheWordsOfTheirAgents) {
  const Scenario scenario = load(kEverything);
  const std::vector<PlannedProgram> planned = plan_programs(scenario);
  ASSERT_EQ(planned.size(), 4u);
  std::vector<std::string> logs;
  for (const PlannedProgram& one : planned) logs.push_back(one.log);
  EXPECT_EQ(logs,
            (std::vector<std::string>{"desk0.early.log", "desk1.early.log", "l0.log", "l1.log"}));
  const ProgramWords words = words_of(planned[3], scenario, "/r");
  EXPECT_EQ(filled_in(planned[3].program->command[2], words), "echo 'a {b}: desk1 # $X' \\");
  EXPECT_EQ(filled_in("{address} {results}/{number}{agent}{", words), "10.77.2.6 /r/1desk1{");
  EXPECT_EQ(plan_processes(scenario).size(), 3u) << "nobody drives the desk";
}

TEST_F(Resolved, KeepsTheWorld) {
  const auto c = load(resolved_yaml(load(kEverything))).simulation;
  EXPECT_EQ(c.world.step, 5ms);
  EXPECT_EQ(c.world.gravity, 1.62);
  EXPECT_EQ(c.world.erp, 0.3);
  EXPECT_EQ(c.world.cfm, 1e-7);
  EXPECT_EQ(c.world.surface_layer, 2e-4);
  EXPECT_EQ(c.world.max_correcting_velocity, 0.2);
  EXPECT_EQ(c.world.ground_friction, 0.4);
  EXPECT_EQ(c.world.jam_contacts, 9);
  ASSERT_EQ(c.walls.size(), 2u);
  EXPECT_EQ(c.walls[0].name, "w");
  EXPECT_EQ(c.walls[0].centre, (hal::Vec3{4, 5, 1.5}));
  EXPECT_EQ(c.walls[0].friction, 0.7);
  EXPECT_DOUBLE_EQ(c.walls[0].yaw, 3.14159265358979323846 / 18);
  EXPECT_EQ(c.walls[1].name, "box0");
  EXPECT_EQ(c.walls[0].radio_loss, (ObstacleLoss{hal::Decibels{15}, 2}));
  EXPECT_EQ(c.walls[1].radio_loss, kBrickWall);
  EXPECT_EQ(c.materials, (std::vector<Material>{{"door", hal::Decibels{2.5}, hal::Decibels{3.5}}}));
  EXPECT_EQ(c.walls[0].material, "door");
  EXPECT_EQ(c.walls[1].material, "brick");
}

TEST_F(Resolved, KeepsTheChainOfPropagation) {
  const auto all = load(resolved_yaml(load(kEverything)));
  const auto& c = waves_of(all.simulation.radio)->propagation;
  EXPECT_EQ(c.antenna_height.value, 1.5);
  EXPECT_EQ(c.antenna_gain.value, 1);
  EXPECT_EQ(waves_of(all.simulation.radio)->phy.channel, 6u);
  const radio::LossConfig& loss = waves_of(all.simulation.radio)->receiver.loss;
  EXPECT_EQ(loss.probability, 0.25);
  const std::vector<radio::LossConfig::Link> links{{"x*", "cart0", 0.5}, {"cart0", "x03", 1}};
  EXPECT_EQ(loss.links, links);
  EXPECT_EQ(c.body_loss, (ObstacleLoss{hal::Decibels{5}, 10}));
  ASSERT_EQ(c.chain.size(), 3u);
  const auto& law = std::get<radio::LogDistanceConfig>(c.chain[0]);
  EXPECT_EQ(law.reference_loss.value, 40);
  EXPECT_EQ(law.reference_distance.value, 2);
  EXPECT_EQ(law.exponent, 2.7);
  const auto& shadowing = std::get<radio::ShadowingConfig>(c.chain[1]);
  EXPECT_EQ(shadowing.sigma.value, 7);
  EXPECT_EQ(shadowing.decorrelation_distance.value, 9);
  const auto& fading = std::get<radio::NakagamiConfig>(c.chain[2]);
  EXPECT_EQ(fading.m_near, 4);
  EXPECT_EQ(fading.m_middle, 3);
  EXPECT_EQ(fading.m_far, 2);
  EXPECT_EQ(fading.middle_from.value, 50);
  EXPECT_EQ(fading.far_from.value, 60);
  EXPECT_EQ(fading.scatterer_speed, 0.5);
}

TEST_F(Resolved, KeepsTheOtherEntriesOfAChain) {
  const auto chain = [this](const std::string& entries) {
    const std::string text =
        "version: 1\nend: [{at: 1 s, result: done}]\n"
        "radio: {profile: ieee80211b, propagation: [" +
        entries +
        "]}\n"
        "agents: {m: {mote: {model: brick, size: [1 cm, 1 cm, 1 cm], mass: 1 g},\n"
        "  poses: [{x: 0 m, y: 0 m}], controller: {program: help_mote}}}\n";
    return waves_of(load(resolved_yaml(load(text))).simulation.radio)->propagation.chain;
  };
  EXPECT_TRUE(std::holds_alternative<radio::FriisConfig>(chain("{model: friis}").at(0)));
  EXPECT_TRUE(
      std::holds_alternative<radio::TwoRayGroundConfig>(chain("{model: two_ray_ground}").at(0)));
  EXPECT_TRUE(std::holds_alternative<radio::PowerLawConfig>(chain("").at(0)));
  const auto rician = chain("{model: power_law}, {model: rician, k: 3 dB, scatterer_speed: 2 m/s}");
  EXPECT_EQ(std::get<radio::RicianConfig>(rician.at(1)).k.value, 3);
  EXPECT_EQ(std::get<radio::RicianConfig>(rician.at(1)).scatterer_speed, 2);
  const auto rayleigh = chain("{model: friis}, {model: rayleigh, scatterer_speed: 2 m/s}");
  EXPECT_EQ(std::get<radio::RayleighConfig>(rayleigh.at(1)).scatterer_speed, 2);
}

TEST_F(Resolved, KeepsTheRadiosAir) {
  const auto all = load(resolved_yaml(load(kEverything)));
  const auto& c = std::get<radio::MobilityFrameworkConfig>(all.simulation.radio);
  EXPECT_DOUBLE_EQ(c.tx_power.value, 1.9952623149688795);  // mW: 10^0.3, computed with bc
  EXPECT_DOUBLE_EQ(c.propagation.wavelength.value, 0.124);
  EXPECT_EQ(c.propagation.path_loss_exponent, 2.5);
  EXPECT_TRUE(c.propagation.propagation_delay && c.propagation.obstacles);
  EXPECT_EQ(c.receiver.sensitivity.value, -84);
  EXPECT_EQ(c.propagation.interference_floor.value, -100);
  EXPECT_EQ(c.receiver.noise_floor.value, -109.5);
  EXPECT_EQ(c.receiver.cca_threshold.value, -83);
  EXPECT_EQ(c.receiver.energy_detection.value, -82);
  EXPECT_EQ(c.phy.data_rate.value, 2e6);
  EXPECT_EQ(c.phy.control_rate.value, 5.5e6);
  EXPECT_EQ(c.phy.broadcast_rate.value, 2e6);
  EXPECT_EQ(c.phy.preamble, radio::Preamble::kShort);
  EXPECT_EQ(c.phy.rounding, radio::Rounding::kMicrosecond);
  EXPECT_EQ(c.receiver.error_model, radio::ErrorModel::kDsss);
  EXPECT_EQ(c.receiver.min_sinr.value, 3);
  EXPECT_EQ(c.receiver.preamble_window, 4us);
  EXPECT_EQ(c.receiver.capture_margin->value, 5);
}

TEST_F(Resolved, KeepsTheRadiosMac) {
  const auto all = load(resolved_yaml(load(kEverything)));
  const auto& c = std::get<radio::MobilityFrameworkConfig>(all.simulation.radio);
  EXPECT_EQ(c.lengths.lengths, radio::Lengths::kBytes);
  EXPECT_EQ(c.lengths.header_bits, 271u);
  EXPECT_EQ(c.lengths.payload_bits, 8u);
  EXPECT_EQ(c.contention.slot, 9us);
  EXPECT_EQ(c.contention.sifs, 16us);
  EXPECT_EQ(c.contention.cw_min, 15u);
  EXPECT_EQ(c.contention.cw_max, 511u);
  EXPECT_EQ(c.cw_broadcast, 63u);
  EXPECT_EQ(c.contention.rts_threshold, 400u);
  EXPECT_EQ(c.contention.short_retry_limit, 6u);
  EXPECT_EQ(c.contention.queue_limit, 13u);
}

TEST_F(Resolved, KeepsTheRouting) {
  const auto c = load(resolved_yaml(load(kEverything))).simulation.routing;
  EXPECT_EQ(c.choice.beta, 3);
  EXPECT_EQ(c.choice.metric.direct_weight, 1e5);
  EXPECT_EQ(c.jitter_max, 90ms);
  EXPECT_EQ(c.retry_period, 4s);
  EXPECT_EQ(c.retry_jitter, 0.3);
  EXPECT_EQ(c.retries, 2);
  EXPECT_EQ(c.acceptance, 1.4);
  EXPECT_TRUE(c.accept_anywhere);
  EXPECT_EQ(c.hop_limit, 29);
  EXPECT_EQ(c.buffer_limit, 63u);
  EXPECT_EQ(c.buffer_age, 9s);
  EXPECT_EQ(c.ack_timeout, 40ms);
  EXPECT_EQ(c.ack_attempts, 3);
  EXPECT_EQ(c.hello_period, 900ms);
  EXPECT_EQ(c.hello_limit, 5u);
  using hal::Priority;
  EXPECT_EQ(c.control_priority, Priority{6});
  EXPECT_EQ(
      c.priorities,
      (std::map<std::string, Priority, std::less<>>{
          {"alarm", Priority::kVoice}, {"cam.1", Priority{7}}, {"images", Priority::kBackground}}));
}

TEST_F(Resolved, KeepsHowRoutesAreChosen) {
  const auto routing_of = [this](const std::string& routing) {
    const std::string text =
        std::string("version: 1\nradio: {profile: ieee80211b}\nrouting: ") + routing +
        "\nagents: {m: {mote: {model: brick, size: [1 cm, 1 cm, 1 cm],"
        " mass: 1 g}, poses: [{x: 0 m, y: 0 m}],"
        " controller: {program: help_mote}}}\nend: [{at: 1 s, result: done}]\n";
    return load(resolved_yaml(load(text))).simulation.routing;
  };
  EXPECT_EQ(routing_of("{metric: delay}").choice.metric,
            hal::path_metric(hal::PathStatistic::kDelay));
  const auto several = routing_of(
      "{metric: {hops: 1, min_snr: 0.5}, direct_weight: 0, classes: {video: {metric: energy},"
      " audio: {beta: 7}}}");
  const hal::PathMetric product{.hops = 1, .min_snr = 0.5, .direct_weight = 0};
  EXPECT_EQ(several.choice.metric, product);
  EXPECT_EQ(several.choice_of("video").metric, hal::path_metric(hal::PathStatistic::kEnergy, 0));
  EXPECT_EQ(several.choice_of("audio").beta, 7);
  EXPECT_EQ(several.choice_of("audio").metric, product);
  EXPECT_EQ(several.choice_of("else").beta, 2);
}

TEST_F(Resolved, KeepsTheOtherProtocols) {
  const auto routing_of = [this](const std::string& routing) {
    const std::string text =
        std::string("version: 1\nradio: {profile: ieee80211b}\nrouting: ") + routing +
        "\nagents: {m: {mote: {model: brick, size: [1 cm, 1 cm, 1 cm],"
        " mass: 1 g}, poses: [{x: 0 m, y: 0 m}],"
        " controller: {program: help_mote}}}\nend: [{at: 1 s, result: done}]\n";
    return load(resolved_yaml(load(text))).simulation.routing;
  };
  using hal::node::routing::Algorithm;
  const auto flooding = routing_of("{algorithm: flooding, jitter_max: 7 ms, hop_limit: 9}");
  EXPECT_EQ(flooding.algorithm, Algorithm::kFlooding);
  EXPECT_EQ(flooding.jitter_max, 7ms);
  EXPECT_EQ(flooding.hop_limit, 9);
  const auto plain = routing_of("{algorithm: aodv}");
  EXPECT_EQ(plain.algorithm, Algorithm::kAodv);
  EXPECT_EQ(plain.jitter_max, 10ms);
  EXPECT_EQ(plain.aodv.active_route_timeout, 3s);
  const auto aodv =
      routing_of(
          "{algorithm: aodv, active_route_timeout: 4 s, allowed_hello_loss: 3,"
          " hello_interval: 2 s, local_add_ttl: 3, net_diameter: 20, node_traversal_time: 30 ms,"
          " rerr_ratelimit: 11, rreq_ratelimit: 12, rreq_retries: 4, timeout_buffer: 5,"
          " ttl_start: 6, ttl_increment: 7, ttl_threshold: 8, hello: false,"
          " destination_only: true, gratuitous_reply: false, local_repair: true,"
          " wait_after_start: true}")
          .aodv;
  EXPECT_EQ(aodv.active_route_timeout, 4s);
  EXPECT_EQ(aodv.allowed_hello_loss, 3);
  EXPECT_EQ(aodv.hello_interval, 2s);
  EXPECT_EQ(aodv.local_add_ttl, 3);
  EXPECT_EQ(aodv.net_diameter, 20);
  EXPECT_EQ(aodv.node_traversal_time, 30ms);
  EXPECT_EQ(aodv.rerr_ratelimit, 11);
  EXPECT_EQ(aodv.rreq_ratelimit, 12);
  EXPECT_EQ(aodv.rreq_retries, 4);
  EXPECT_EQ(aodv.timeout_buffer, 5);
  EXPECT_EQ(aodv.ttl_start, 6);
  EXPECT_EQ(aodv.ttl_increment, 7);
  EXPECT_EQ(aodv.ttl_threshold, 8);
  EXPECT_FALSE(aodv.hello || aodv.gratuitous_reply);
  EXPECT_TRUE(aodv.destination_only && aodv.local_repair && aodv.wait_after_start);
}

TEST_F(Resolved, KeepsEveryBody) {
  const auto first = load(kEverything).simulation.agents;
  const auto again = load(resolved_yaml(load(kEverything))).simulation.agents;
  ASSERT_EQ(again.size(), 7u);
  for (std::size_t i = 0; i < again.size(); ++i) EXPECT_EQ(again[i].body, first[i].body) << i;
  const auto& robot = std::get<hal::node::devices::RobotDescription>(again[0].body);
  EXPECT_EQ(robot.boxes.at(0).size, (hal::Vec3{0.1, 0.2, 0.3}));
  EXPECT_EQ(robot.wheels.at(1).mu, 0.55);
  EXPECT_EQ(robot.wheels.at(2).max_torque, 3);
  EXPECT_EQ(robot.wheels.at(2).max_speed, 9);
  EXPECT_EQ(robot.encoder_steps, 2048);
  EXPECT_EQ(robot.infrared.at(0).curve.points().size(), 2u);
  EXPECT_EQ(robot.infrared.at(1).curve, hal::node::devices::InfraredCurve::gp2d120());
  EXPECT_EQ(robot.infrared.at(0).converter, (hal::node::devices::Converter{12, 3.3}));
}

TEST_F(Resolved, KeepsAgentsAndTheirParameters) {
  const Scenario scenario = load(resolved_yaml(load(kEverything)));
  const auto& all = scenario.simulation.agents;
  ASSERT_EQ(all.size(), 7u);
  EXPECT_EQ(all[0].name, "cart0");
  EXPECT_EQ(all[0].id.value, 7);
  EXPECT_EQ(all[4].name, "x03");
  EXPECT_EQ(all[4].id.value, 303);
  EXPECT_EQ(all[4].radio.tx_power->value, 0.5);
  EXPECT_EQ(all[0].radio, radio::StationConfig{}) << "that of the radio";
  EXPECT_EQ(all[4].radio.antenna_gain->value, 3);
  EXPECT_EQ(all[4].radio.channel, 11u);
  EXPECT_FALSE(all[4].radio.data_rate);
  const radio::StationConfig& other = all[2].radio;
  EXPECT_EQ(other.tx_power->value, 7);
  EXPECT_EQ(other.antenna_gain->value, 3) << "of the group";
  EXPECT_EQ(other.channel, 3u);
  EXPECT_EQ(other.data_rate->value, 1e6);
  EXPECT_EQ(other.control_rate->value, 2e6);
  EXPECT_EQ(other.broadcast_rate->value, 5.5e6);
  EXPECT_EQ(all[4].radio.antenna_height->value, 0.3);
  EXPECT_EQ(all[4].pose.x, 0);
  EXPECT_EQ(all[4].pose.y, 1);
  ASSERT_EQ(scenario.groups.size(), 3u);
  EXPECT_EQ(scenario.groups[0].name, "odd");
  EXPECT_EQ(scenario.groups[0].processes, 2);
  ASSERT_EQ(all[1].parameters.size(), 7u);
  EXPECT_EQ(all[1].parameters[0].value, "3 s");
  EXPECT_EQ(all[1].parameters[1].value, "20 s");
  EXPECT_TRUE(all[1].parameters[2].is_list);
  EXPECT_EQ(all[1].parameters[2].items, (std::vector<std::string>{"r1", "a, b", "-1 m"}));
  EXPECT_TRUE(all[1].parameters[3].is_list);
  EXPECT_TRUE(all[1].parameters[3].items.empty());
  EXPECT_EQ(all[1].parameters[4].name, "deep.size");
  EXPECT_EQ(all[1].parameters[4].value, "4");
  EXPECT_EQ(all[1].parameters[5].name, "deep.more.x");
  EXPECT_EQ(all[1].parameters[5].items, std::vector<std::string>{"1 s"});
  EXPECT_EQ(all[1].parameters[6].value, "true");
  EXPECT_TRUE(all[0].parameters.empty());
}

TEST_F(Resolved, KeepsParametersThatOnlySomeAgentsHave) {
  const Scenario first = load_scenario(std::string(CONFIG_DIR) + "/scenarios/case_study.yaml");
  const Scenario again = load(resolved_yaml(first));
  for (std::size_t i = 0; i < first.simulation.agents.size(); ++i) {
    EXPECT_EQ(again.simulation.agents[i].parameters.size(),
              first.simulation.agents[i].parameters.size());
  }
  EXPECT_EQ(again.simulation.agents[17].parameters.at(0).value, "1 s");
}

TEST_F(Resolved, KeepsEndsAndExpectations) {
  const Scenario scenario = load(resolved_yaml(load(kEverything)));
  ASSERT_EQ(scenario.simulation.ends.size(), 2u);
  EXPECT_EQ(scenario.simulation.ends[0].agent->value, 303);
  EXPECT_EQ(scenario.simulation.ends[0].state, "DONE");
  EXPECT_EQ(scenario.simulation.ends[0].after, 20ms);
  EXPECT_EQ(scenario.simulation.ends[1].after, 99s);
  ASSERT_EQ(scenario.expectations.size(), 3u);
  EXPECT_EQ(std::get<ExpectedResult>(scenario.expectations[0].condition).result, "good");
  const auto& distance = std::get<ExpectedDistance>(scenario.expectations[1].condition);
  EXPECT_EQ(distance.which, std::vector{hal::AgentId{300}});
  EXPECT_EQ(distance.to.value, 7);
  EXPECT_EQ(distance.below.value, 3.5);
  EXPECT_EQ(distance.entered, "");
  const auto& last = std::get<ExpectedDistance>(scenario.expectations[2].condition);
  EXPECT_EQ(last.whose, "x0*");
  EXPECT_GT(last.which.size(), 1u);
  EXPECT_EQ(last.entered, "DONE");
}

TEST_F(Resolved, HoldsForEveryRadioProfile) {
  for (const std::string profile : {"mobility_framework", "ieee80211b", "ieee80211g", "ieee80211n",
                                    "ieee80211ac", "ieee80211ax", "disk", "ideal"}) {
    const auto file = std::string(CONFIG_DIR) + "/scenarios/two_motes.yaml";
    const std::string once = resolved_yaml(load_scenario(file, {"radio.profile=" + profile}));
    EXPECT_EQ(resolved_yaml(load(once)), once) << profile;
  }
}

TEST_F(Resolved, KeepsTheKeysOfTheStandards) {
  const auto file = std::string(CONFIG_DIR) + "/scenarios/two_motes.yaml";
  const Scenario first = load_scenario(
      file,
      {"radio.profile=ieee80211g", "radio.protection=rts_cts", "radio.protection_rate=2 Mb/s",
       "radio.msdu_lifetime=300 ms", "radio.rate_control=minstrel", "radio.aarf_threshold=9",
       "radio.aarf_max_threshold=40", "radio.aarf_timeout=14", "radio.minstrel_interval=50 ms",
       "radio.minstrel_past=0.5", "radio.minstrel_sampling=0.2", "radio.minstrel_ht_wait=30",
       "radio.ideal_loss=0.05", "agents.motes.radio.standard=ieee80211b"});
  const Scenario again = load(resolved_yaml(first));
  const radio::DcfConfig& c = *dcf_of(again.simulation.radio);
  EXPECT_EQ(c.protection, radio::ProtectionKind::kRtsCts);
  EXPECT_EQ(c.protection_rate.value, 2e6);
  EXPECT_EQ(c.msdu_lifetime, 300ms);
  EXPECT_EQ(c.rate_control.kind, radio::RateControlKind::kMinstrel);
  EXPECT_EQ(c.rate_control.aarf_threshold, 9u);
  EXPECT_EQ(c.rate_control.aarf_max_threshold, 40u);
  EXPECT_EQ(c.rate_control.aarf_timeout, 14u);
  EXPECT_EQ(c.rate_control.minstrel_interval, 50ms);
  EXPECT_EQ(c.rate_control.minstrel_past, 0.5);
  EXPECT_EQ(c.rate_control.minstrel_sampling, 0.2);
  EXPECT_EQ(c.rate_control.minstrel_ht_wait, 30u);
  EXPECT_EQ(c.rate_control.ideal_loss, 0.05);
  for (const agents::AgentConfig& agent : again.simulation.agents) {
    EXPECT_EQ(agent.radio.standard, radio::Standard::kIeee80211b);
  }
}

// A radio file spells out what its profile is; whoever copies it to change one key must not change
// others unknowingly.
TEST(RadioFiles, SpellOutTheDefaultsOfTheirProfiles) {
  const std::string config = CONFIG_DIR;
  for (const std::string profile : {"mobility_framework", "ieee80211b", "ieee80211g", "ieee80211n",
                                    "ieee80211ac", "ieee80211ax", "disk", "ideal"}) {
    const std::string scenario = config + "/scenarios/two_motes.yaml";
    const std::string file = config + "/radios/" + profile + ".yaml";
    EXPECT_EQ(resolved_yaml(load_scenario(scenario, {"radio.include=" + file})),
              resolved_yaml(load_scenario(scenario, {"radio.profile=" + profile})));
  }
}

// SIFS is 10 us in 2.4 GHz and 16 us in 5 GHz (IEEE Std 802.11-2020, 19.4.4 and 17.4.4).
TEST(RadioFiles, LeaveSifsToTheBandOfTheChannel) {
  using namespace std::chrono_literals;
  const std::string config = CONFIG_DIR;
  const auto sifs_of = [&](const std::string& profile, const std::string& channel) {
    const Scenario scenario =
        load_scenario(config + "/scenarios/two_motes.yaml",
                      {"radio.include=" + config + "/radios/" + profile + ".yaml",
                       "radio.width=20 MHz", "radio.channel=" + channel});
    return dcf_of(scenario.simulation.radio)->contention.sifs;
  };
  for (const std::string profile : {"ieee80211n", "ieee80211ax"}) {
    EXPECT_EQ(sifs_of(profile, "1"), 10us) << profile;
    EXPECT_EQ(sifs_of(profile, "36"), 16us) << profile;
  }
}

}  // namespace
}  // namespace sim::scenario
