#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace baraka::slurm {

/// Persistent notes about submissions: keys and values that outlive this process.
struct Notes {
  std::function<std::string(std::string_view key)> value;  ///< "": the key is not there.
  std::function<void(std::string_view key, std::string_view value)> set;
};

/// An array job of a campaign: the task with index i is the run `first + i`.
struct Submission {
  std::string name;  ///< Unique name: "baraka-4f09c1d2-1".
  std::int64_t first = 0;
  /// Number of the job; none: it is being submitted by this process, or was by one that was killed.
  std::optional<std::int64_t> job;
};

/// The noted array jobs of a campaign, in the order of submission. Notes: "slurm.campaign" holds
/// the part of the names that distinguishes the campaign from others; "slurm.1", "slurm.2", … hold
/// "NAME FIRST JOB".
class Submissions {
 public:
  /// @throws std::runtime_error  a note is malformed.
  explicit Submissions(Notes notes);

  const std::vector<Submission>& all() const { return all_; }
  std::set<std::string> names() const;
  const Submission* named(std::string_view name) const;

  /// Notes a job that is about to be submitted, so that a later process can look for it.
  const Submission& add(std::int64_t first);
  /// Notes the number of the last job.
  void set_job(std::int64_t job);

 private:
  void note(std::size_t index);

  Notes notes_;
  std::string campaign_;
  std::vector<Submission> all_;
};

}  // namespace baraka::slurm
