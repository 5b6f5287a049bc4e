#pragma once

#include <optional>
#include <vector>

#include "results/record/commits.h"
#include "results/record/database.h"
#include "results/record/schema.h"
#include "results/record/topic_writer.h"

namespace results::record {

/// Writes the table associations.
class AssociationLog final : public TopicWriter {
 public:
  AssociationLog(Database& database, Commits& commits);

  static std::vector<Table> tables();

  void on_association(hal::Time at, hal::AgentId station,
                      std::optional<hal::AgentId> access_point) override;

 private:
  Statement insert_;
  Commits& commits_;
};

}  // namespace results::record
