#include "results/record/interface_counts.h"

#include <string>

namespace results::record {

InterfaceCounts::InterfaceCounts(Database& database)
    : put_(database, "REPLACE INTO interfaces VALUES (?, ?, ?, ?)") {}

void InterfaceCounts::write() {
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

}  // namespace results::record
