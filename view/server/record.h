#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "results/record/run_reader.h"

namespace view::server {

/// `run.sqlite` of one run, which may still be growing. One thread at a time.
///
///   record.open();
///   auto states = record.query("SELECT agent, at_ns, state FROM states");
///   …
///   record.close_if_growing();
class Record {
 public:
  explicit Record(std::filesystem::path folder) : folder_(std::move(folder)) {}

  const std::filesystem::path& folder() const { return folder_; }

  /// Call before everything that follows. @throws std::runtime_error  as RunReader.
  /// @return false if the folder has another run than at the last call, so that nothing known about
  /// that one is valid.
  bool open();

  /// Closes the file for its writer, which cannot finish its write-ahead log while it is being
  /// read. There must be no statements.
  void close_if_growing();

  results::record::Statement query(std::string_view sql) { return reader_->query(sql); }

  /// Values of the table run; "" or none if the key is not there.
  std::string value(std::string_view key) { return reader_->value(key); }
  std::optional<std::int64_t> integer(std::string_view key) { return reader_->integer(key); }
  std::optional<double> real(std::string_view key) { return reader_->real(key); }

  bool is_growing() const { return is_growing_; }

  /// ns: the end of the run; while it goes on, the time up to which the record is complete.
  std::int64_t until() const { return until_; }

  /// Addresses in ascending order.
  const std::vector<std::int64_t>& agents() const { return agents_; }

 private:
  void learn();
  std::int64_t latest_row();

  std::filesystem::path folder_;
  std::optional<results::record::RunReader> reader_;
  std::vector<std::int64_t> agents_;
  std::optional<std::string> run_id_;  ///< None: it has never been open.
  bool is_growing_ = false;
  std::int64_t until_ = 0;
};

}  // namespace view::server
