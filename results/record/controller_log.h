#pragma once

#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "results/record/commits.h"
#include "results/record/database.h"
#include "results/record/schema.h"
#include "results/record/topic_writer.h"

namespace results::record {

/// Writes the tables states, recorded and recorded_units: what controllers report about themselves.
class ControllerLog final : public TopicWriter {
 public:
  ControllerLog(Database& database, Commits& commits);

  static std::vector<Table> state_tables();
  static std::vector<Table> value_tables();

  /// @param units  by controller and name of the value.
  void add_units(const std::map<std::pair<std::string, std::string>, std::string>& units);

  void on_state(hal::Time at, hal::AgentId agent, std::string_view state) override;
  void on_record(hal::Time at, hal::AgentId agent, std::string_view name, double value) override;

 private:
  Statement insert_state_, insert_value_, put_unit_;
  Commits& commits_;
};

}  // namespace results::record
