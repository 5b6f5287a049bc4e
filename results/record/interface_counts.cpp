#include "results/record/interface_counts.h"

#include <string>

#include "sim/radio/mac/mac_sap.h"

namespace results::record {

InterfaceCounts::InterfaceCounts(Database& database)
    : put_(database, "REPLACE INTO interfaces VALUES (?, ?, ?, ?)"),
      insert_program_(database, "INSERT INTO programs VALUES (?, ?, ?, ?, ?)") {}

void InterfaceCounts::add(const ProgramRow& program) {
  std::optional<std::int64_t> ended;
  std::optional<int> status;
  if (program.ended) ended = hal::to_ns(*program.ended);
  if (program.ended) status = program.status;
  insert_program_.run(program.agent.value, program.name, hal::to_ns(program.started), ended,
                      status);
}

void InterfaceCounts::on_air_entered(hal::Time, hal::AgentId agent,
                                     const sim::radio::MacRequest& request) {
  add(agent, kEntered, request.payload->size());
}

void InterfaceCounts::on_air_left(hal::Time, hal::AgentId agent,
                                  const sim::radio::MacIndication& indication) {
  add(agent, kLeft, indication.payload->size());
}

void InterfaceCounts::write(hal::Time) {
  if (!changed_) return;
  for (const auto& [agent, counts] : counts_) {
    for (std::size_t kind = 0; kind < kKinds; ++kind) {
      if (counts[kind].frames == 0) continue;
      std::string name = kind == kEntered ? "entered" : "left";
      if (kind >= kFirstRefusal) {
        name = "refused: " +
               std::string(sim::air::name(static_cast<sim::air::Refusal>(kind - kFirstRefusal)));
      }
      put_.run(agent.value, name, counts[kind].frames, counts[kind].bytes);
    }
  }
  changed_ = false;
}

std::vector<Table> InterfaceCounts::tables() {
  return {
      {"interfaces",
       "frames between programs with sockets and the air, for agents that have a network",
       {{"agent", "INTEGER NOT NULL", "", "whose interface"},
        {"what", "TEXT NOT NULL", "",
         "'entered': from a program to the station's queue; 'left': from the air to the programs; "
         "'refused: ...': from a program, not to be sent by a radio, and why"},
        {"frames", "INTEGER NOT NULL", "", "number of frames"},
        {"bytes", "INTEGER NOT NULL", "byte",
         "IP packets or ARP; refused: with the Ethernet header"}},
       "agent, what"},
      {"programs",
       "programs of the scenario that ran inside agents",
       {{"agent", "INTEGER NOT NULL", "", "agent that it ran in"},
        {"name", "TEXT NOT NULL", "", "name in the scenario"},
        {"started_ns", "INTEGER NOT NULL", "ns", "when"},
        {"ended_ns", "INTEGER", "ns", "when it ended; null: it was stopped at the end of the run"},
        {"status", "INTEGER", "",
         "exit status, or 128 + number of the signal that ended it; null: as above"}}},
  };
}

}  // namespace results::record
