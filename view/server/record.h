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

  /// Before any of what follows. @throws std::runtime_error  as RunReader
  /// @return false: another run than the last time is in the folder; nothing known of that holds.
  bool open();

  /// Leaves the file to its writer, who cannot end its write-ahead log while somebody reads it.
  /// Statements must be gone.
  void close_if_growing();

  results::record::Statement query(std::string_view sql) { return reader_->query(sql); }

  /// Of the table run; "" or none if the key is not there.
  std::string value(std::string_view key) { return reader_->value(key); }
  std::optional<std::int64_t> integer(std::string_view key) { return reader_->integer(key); }
  std::optional<double> real(std::string_view key) { return reader_->real(key); }

  bool is_growing() const { return is_growing_; }

  /// ns: the end of the run; while it goes on, up to where everything is written.
  std::int64_t until() const { return until_; }

  /// Addresses, ascending.
  const std::vector<std::int64_t>& agents() const { return agents_; }

 private:
  void learn();
  std::int64_t latest_row();

  std::filesystem::path folder_;
  std::optional<results::record::RunReader> reader_;
  std::vector<std::int64_t> agents_;
  std::optional<std::string> run_id_;  ///< None: it was never open.
  bool is_growing_ = false;
  std::int64_t until_ = 0;
};

}  // namespace view::server
