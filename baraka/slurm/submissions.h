#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace baraka::slurm {

/// Where what was submitted is noted: keys and values that outlive this process.
struct Notes {
  std::function<std::string(std::string_view key)> value;  ///< "": the key is not there.
  std::function<void(std::string_view key, std::string_view value)> set;
};

/// An array job of a campaign: the task of index i is the run `first + i`.
struct Submission {
  std::string name;  ///< No other job has it: "baraka-4f09c1d2-1".
  std::int64_t first = 0;
  std::optional<std::int64_t> job;  ///< None: this process, or one that was killed, was submitting.
};

/// The array jobs of a campaign, in the order in which they were submitted, as noted: under
/// "slurm.campaign", by which their names differ from those of other campaigns, and "slurm.1",
/// "slurm.2" … "NAME FIRST JOB".
class Submissions {
 public:
  /// @throws std::runtime_error  a note is not as this class writes it.
  explicit Submissions(Notes notes);

  const std::vector<Submission>& all() const { return all_; }
  std::set<std::string> names() const;
  const Submission* named(std::string_view name) const;

  /// About to be submitted: noted, so that whoever comes after this process can look for it.
  const Submission& add(std::int64_t first);
  /// The last one has this number.
  void set_job(std::int64_t job);

 private:
  void note(std::size_t index);

  Notes notes_;
  std::string campaign_;
  std::vector<Submission> all_;
};

}  // namespace baraka::slurm
