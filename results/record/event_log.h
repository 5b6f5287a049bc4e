#pragma once

#include <vector>

#include "results/record/commits.h"
#include "results/record/database.h"
#include "results/record/schema.h"
#include "results/record/topic_writer.h"

namespace results::record {

/// Writes the tables events, turns and arrivals: interventions in the run by the scenario or from
/// outside.
class EventLog final : public TopicWriter {
 public:
  EventLog(Database& database, bool has_inputs, Commits& commits);

  static std::vector<Table> scripted_tables();
  static std::vector<Table> tables();

  void on_scripted(const sim::agents::ScriptedDone& done) override;
  void on_turn(const sim::agents::Turn& turn) override;
  void on_arrival(const sim::OutsideArrival& arrival) override;

 private:
  Statement insert_scripted_, insert_turn_, insert_arrival_;
  bool has_inputs_;
  Commits& commits_;
};

}  // namespace results::record
