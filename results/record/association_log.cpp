#include "results/record/association_log.h"

namespace results::record {

AssociationLog::AssociationLog(Database& database, Commits& commits)
    : insert_(database, "INSERT INTO associations VALUES (?, ?, ?)"), commits_(commits) {}

void AssociationLog::on_association(hal::Time at, hal::AgentId station,
                                    std::optional<hal::AgentId> access_point) {
  std::optional<int> with;
  if (access_point) with = access_point->value;
  insert_.run(hal::to_ns(at), station.value, with);
  commits_.on_rows(at, 1);
}

std::vector<Table> AssociationLog::tables() {
  return {
      {"associations",
       "with radio: {bss: ...}: the access point that each station was associated with",
       {{"at_ns", "INTEGER NOT NULL", "ns", "start of the association"},
        {"station", "INTEGER NOT NULL", "", "agent"},
        {"access_point", "INTEGER", "", "agent; null: none"}}},
  };
}

}  // namespace results::record
