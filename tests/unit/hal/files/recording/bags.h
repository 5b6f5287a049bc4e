#pragma once

#include <sqlite3.h>
#include <stdlib.h>  // mkdtemp

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>
#include <vector>

#include "hal/files/recording/recording.h"

namespace hal::files::recording {

/// A file that other people's programs wrote: see bags/README.md.
inline std::filesystem::path bag(const std::string& name) {
  return std::filesystem::path(TESTS_DIR "/unit/hal/files/recording/bags") / name;
}

inline std::string content_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error("no file " + path.string());
  return {std::istreambuf_iterator<char>(file), {}};
}

/// A folder that goes with this object.
class Scratch {
 public:
  Scratch() {
    std::string path = std::filesystem::temp_directory_path() / "baraka_bags_XXXXXX";
    path_ = ::mkdtemp(path.data());
  }
  ~Scratch() { std::filesystem::remove_all(path_); }
  Scratch(const Scratch&) = delete;
  Scratch& operator=(const Scratch&) = delete;

  std::filesystem::path write(const std::string& name, const std::string& content) const {
    std::filesystem::create_directories((path_ / name).parent_path());
    std::filesystem::remove(path_ / name);
    std::ofstream(path_ / name, std::ios::binary) << content;
    return path_ / name;
  }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// What read_recording() says of a file that it refuses; "" if it reads it.
inline std::string refusal(const std::filesystem::path& path) {
  try {
    read_recording(path);
  } catch (const std::runtime_error& e) {
    return e.what();
  }
  return {};
}

inline const RecordedTopic& topic_of(const Recording& recording, const std::string& name) {
  for (const RecordedTopic& topic : recording.topics) {
    if (topic.name == name) return topic;
  }
  throw std::runtime_error("no topic " + name);
}

/// A message as rosbag2 stores it.
struct StoredMessage {
  int topic = 1;
  std::int64_t at = 0;  ///< ns
  std::string data;
};

/// Runs SQL on a database, which it creates.
inline void execute(const std::filesystem::path& file, const std::string& sql) {
  sqlite3* handle = nullptr;
  sqlite3_open(file.c_str(), &handle);
  char* error = nullptr;
  const int result = sqlite3_exec(handle, sql.c_str(), nullptr, nullptr, &error);
  const std::string what = error == nullptr ? "" : error;
  sqlite3_free(error);
  sqlite3_close(handle);
  if (result != SQLITE_OK) throw std::runtime_error(what);
}

/// The tables of rosbag2_storage_sqlite3 in Humble.
inline constexpr const char* kTables =
    "PRAGMA page_size = 512;"  // small, so that each byte can be tried
    "CREATE TABLE schema(schema_version INTEGER PRIMARY KEY, ros_distro TEXT NOT NULL);"
    "CREATE TABLE metadata(id INTEGER PRIMARY KEY, metadata_version INTEGER NOT NULL, metadata "
    "TEXT NOT NULL);"
    "CREATE TABLE topics(id INTEGER PRIMARY KEY,name TEXT NOT NULL,type TEXT NOT NULL,"
    "serialization_format TEXT NOT NULL,offered_qos_profiles TEXT NOT NULL);"
    "CREATE TABLE messages(id INTEGER PRIMARY KEY,topic_id INTEGER NOT NULL,timestamp INTEGER NOT "
    "NULL, data BLOB NOT NULL);"
    "CREATE INDEX timestamp_idx ON messages (timestamp ASC);";

inline std::string hex(const std::string& data) {
  std::string text;
  for (const char c : data) {
    constexpr char kDigits[] = "0123456789abcdef";
    text += kDigits[static_cast<unsigned char>(c) >> 4];
    text += kDigits[static_cast<unsigned char>(c) & 15];
  }
  return text;
}

/// A .db3 with the topics 1 /scan (best effort) and 2 /tf_static (no QoS).
inline void write_db3(const std::filesystem::path& file,
                      const std::vector<StoredMessage>& messages) {
  std::string sql = std::string(kTables) +
                    "BEGIN; INSERT INTO topics VALUES(1, '/scan', 'sensor_msgs/msg/LaserScan', "
                    "'cdr', '- history: 1\n  depth: 5\n  reliability: 2\n  durability: 2');"
                    "INSERT INTO topics VALUES(2, '/tf_static', 'tf2_msgs/msg/TFMessage', 'cdr', "
                    "'');";
  for (const StoredMessage& one : messages) {
    sql += "INSERT INTO messages(topic_id, timestamp, data) VALUES(" + std::to_string(one.topic) +
           ", " + std::to_string(one.at) + ", x'" + hex(one.data) + "');";
  }
  execute(file, sql + "COMMIT;");
}

}  // namespace hal::files::recording
