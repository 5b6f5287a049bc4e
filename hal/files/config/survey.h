#pragma once

#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "hal/files/config/key.h"
#include "hal/files/config/key_table.h"
#include "hal/files/config/mapping.h"
#include "hal/files/config/problems.h"

namespace hal::files::config {

/// A point where a reader goes one way or another: the value of a choice, or whether a key is
/// there.
struct Decision {
  std::string path;                  ///< Dotted, of the key.
  bool presence = false;             ///< Whether it is there: the options are "there", "absent".
  std::vector<std::string> options;  ///< All values.
  std::size_t taken = 0;

  /// Of the same point in another reading.
  std::string id() const { return presence ? path + "?" : path; }
};

/// Options that a reading is made to take, by Decision::id().
using Taken = std::map<std::string, std::size_t>;

/// One reading of a file in which nothing stands, by the very function that reads files. The
/// mapping tells the survey of each key that the function reads, and takes the decisions it is told
/// to.
class Survey {
 public:
  struct Read {
    std::string path;  ///< "agents.NAME.poses[].x".
    std::string meaning, example;
    Form form;
    std::string otherwise;  ///< Value when absent; empty: it must be given.
  };

  /// @param known  paths that are not to be noted again; must outlive the reading; nullptr: none.
  explicit Survey(Taken taken, const std::unordered_set<std::string>* known = nullptr)
      : taken_(std::move(taken)), known_(known) {}

  Mapping root();

  const std::vector<Read>& read() const { return read_; }
  const Read* at(const std::string& path) const;  ///< nullptr: it was not read.
  const std::vector<Decision>& decisions() const { return decisions_; }
  const std::set<std::string>& mentioned() const { return mentioned_; }

 private:
  friend class Mapping;

  void note(const std::string& path, const Key& key, Form form, std::string otherwise);
  /// A key that is looked for, but not read here.
  void mention(const std::string& path) { mentioned_.insert(path); }
  /// @return the option to take. @param otherwise  taken unless another one is wanted.
  std::size_t decide(Decision decision);

  Taken taken_;
  const std::unordered_set<std::string>* known_;
  Problems problems_;
  std::vector<Read> read_;
  std::unordered_map<std::string, std::size_t> places_;  ///< In read_, by path.
  std::set<std::string> mentioned_;
  std::vector<Decision> decisions_;
  std::unordered_map<std::string, std::size_t> met_;  ///< Places in decisions_, by Decision::id().
};

/// Every key that `read` can read, found by calling it with nothing on every way there is: each
/// choice with each value, each key there and absent, with what they lead to; and two of them at a
/// time, where one stands in the mapping of the other or in one inside it. What a key hangs on is
/// looked for among the decisions in the mappings around it, and those that decide about keys
/// outside their own mapping on the way on which they are first met. `read` must only depend on
/// what it reads from the mapping.
KeyTable survey(const std::function<void(Mapping)>& read);

/// The keys of the top level that `read` can read, on every way with one choice or key other than
/// by default: what a kind of file is recognised by, at a hundredth of the cost of survey().
std::set<std::string> top_level_keys(const std::function<void(Mapping)>& read);

}  // namespace hal::files::config
