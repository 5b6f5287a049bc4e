// AODV of ns-3 between ad hoc stations, with flows of constant rate. Reads from standard input a
// line for each flow, `flow SOURCE DESTINATION START` (numbers of stations from 0; s), and one for
// each station that moves, `path T X Y T X Y ...` (s, m; straight on between), in the order of
// their numbers; without such lines the stations stand in a grid, row by row. Prints one line of
// CSV: seed, packets sent, delivered, delivered per sent, the median and the 95 % quantile of their
// delays (ms); then transmissions of all stations: hellos, RREQ by their originators, RREQ relayed,
// RREP, RERR, packets of data (each hop counts), and frames that the MAC gave up (retry limit).
#include <iostream>
#include <sstream>

#include "aodv_stations.h"
#include "wifi.h"

using namespace ns3;

namespace {

struct Options {
  peer::Radio radio;
  peer::Stack stack;
  peer::Load load;
  unsigned seed = 1, side = 5;
  double spacing = 40;
  bool per_flow = false;
};

Options options_of(int argc, char** argv) {
  Options options;
  options.stack.my_route = 6;
  options.stack.addresses = "permanent";
  CommandLine line;
  options.radio.add_to(line);
  options.stack.add_to(line);
  line.AddValue("size", "payload of UDP, bytes, a multiple of 4", options.load.size);
  line.AddValue("rate", "packets per second of a flow", options.load.rate);
  line.AddValue("stop", "end of the flows, s", options.load.stop);
  line.AddValue("side", "stations of a row, and rows", options.side);
  line.AddValue("spacing", "m", options.spacing);
  line.AddValue("per_flow", "print what each flow delivered, too", options.per_flow);
  line.AddValue("seed", "run number", options.seed);
  line.Parse(argc, argv);
  return options;
}

struct Input {
  std::vector<peer::Flow> flows;
  std::vector<std::vector<Waypoint>> paths;
};

Input read_input() {
  Input input;
  for (std::string text; std::getline(std::cin, text);) {
    std::istringstream line(text);
    std::string word;
    line >> word;
    if (word == "flow") {
      peer::Flow& flow = input.flows.emplace_back();
      line >> flow.source >> flow.destination >> flow.start;
    } else if (word == "path") {
      auto& path = input.paths.emplace_back();
      for (double t = 0, x = 0, y = 0; line >> t >> x >> y;)
        path.emplace_back(Seconds(t), Vector(x, y, 1.5));
    }
  }
  return input;
}

NetDeviceContainer grid(const Options& options) {
  std::vector<Vector> places;
  for (unsigned i = 0; i < options.side * options.side; ++i) {
    places.emplace_back(options.spacing * (i % options.side), options.spacing * (i / options.side),
                        1.5);
  }
  return peer::stations(options.radio, places, peer::log_distance());
}

NetDeviceContainer moving(const Options& options, const std::vector<std::vector<Waypoint>>& paths) {
  NodeContainer nodes;
  nodes.Create(paths.size());
  for (uint32_t i = 0; i < paths.size(); ++i) {
    const auto mobility = CreateObject<WaypointMobilityModel>();
    nodes.Get(i)->AggregateObject(mobility);
    for (const Waypoint& point : paths[i]) mobility->AddWaypoint(point);
  }
  return peer::radios(options.radio, nodes, peer::log_distance());
}

void print(const Options& options, const std::vector<peer::Flow>& flows) {
  peer::Tally& tally = peer::tally();
  const peer::Counts& counts = tally.counts;
  const auto total = static_cast<double>(tally.sent());
  std::cout << options.seed << ',' << tally.sent() << ',' << tally.delays.size() << ','
            << static_cast<double>(tally.delays.size()) / total << ',' << tally.quantile(0.5) << ','
            << tally.quantile(0.95) << ',' << counts.hellos << ',' << counts.rreq << ','
            << counts.rreq_relayed << ',' << counts.rrep << ',' << counts.rerr << ',' << counts.data
            << ',' << counts.given_up << std::endl;
  for (std::size_t i = 0; options.per_flow && i < flows.size(); ++i) {
    const auto& messages = tally.messages[i];
    std::cout << "# " << flows[i].source << " to " << flows[i].destination << ": "
              << std::count_if(messages.begin(), messages.end(),
                               [](const peer::Message& one) { return one.arrived; })
              << " of " << messages.size() << std::endl;
  }
}

}  // namespace

int main(int argc, char** argv) {
  const Options options = options_of(argc, argv);
  const Input input = read_input();
  RngSeedManager::SetRun(options.seed);
  const auto devices = input.paths.empty() ? grid(options) : moving(options, input.paths);
  const auto interfaces = peer::install(options.stack, devices);
  peer::listen(devices, options.load.size);
  peer::start(options.load, input.flows, devices, interfaces);
  Simulator::Stop(Seconds(options.load.stop + 15));
  Simulator::Run();
  print(options, input.flows);
  Simulator::Destroy();
}
