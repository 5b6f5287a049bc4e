#pragma once

#include <list>
#include <string>
#include <vector>

#include "baraka/campaign/engine.h"
#include "gateway/process/spawn.h"

namespace baraka::campaign {

/// Runs tasks as processes on this computer, `jobs` at a time. They end with this process, so there
/// are never any to adopt.
class LocalEngine final : public Engine {
 public:
  struct Settings {
    int jobs = 1;
    /// DDS domains, one for each job; empty: each run takes a free domain.
    std::vector<int> domains;
  };

  /// @pre settings.domains is empty or has at least `jobs` elements.
  explicit LocalEngine(Settings settings);

  std::string_view name() const override { return "local"; }
  std::vector<std::int64_t> adopt(std::span<const CampaignTask> started) override;
  std::size_t room() const override { return slots() - running_.size(); }
  void start(std::span<const CampaignTask> tasks) override;
  std::size_t running() const override { return running_.size(); }
  std::size_t slots() const override { return static_cast<std::size_t>(jobs_); }
  std::vector<TaskEnd> poll(hal::Duration longest) override;
  void stop() override;

 private:
  struct Job {
    std::int64_t run = 0;
    std::optional<int> domain;
    hal::Time started{};
    gateway::process::Spawner process;
  };

  void start(const CampaignTask& task);
  TaskEnd end_of(Job& job);

  int jobs_;
  std::vector<int> free_domains_;
  std::string host_;
  std::list<Job> running_;
};

/// Number of processors that this process may use: the default number of parallel runs.
int usable_processors();

/// Name of this computer. @throws std::runtime_error
std::string host_name();

}  // namespace baraka::campaign
