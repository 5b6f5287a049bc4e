#include "sim/record/database.h"

#include <fmt/format.h>
#include <sqlite3.h>

#include <stdexcept>
#include <utility>

namespace sim::record {
namespace {

constexpr int kBetweenTriesMs = 100, kShortWaitMs = 5000;

}  // namespace

Database::Database(const std::filesystem::path& file, Mode mode, WhileBusy while_busy)
    : name_(file.string()), while_busy_(std::move(while_busy)) {
  if (mode == Mode::kCreate) {
    for (const char* part : {"", "-journal", "-wal", "-shm"}) {
      std::filesystem::remove(name_ + part);
    }
  }
  // Not read-only: a file whose writer was killed may need its journal rolled back first.
  // Without a lock of its own: one thread at a time uses it.
  const int create = mode == Mode::kRead ? 0 : SQLITE_OPEN_CREATE;
  const int how = SQLITE_OPEN_READWRITE | SQLITE_OPEN_NOMUTEX | create;
  int result = sqlite3_open_v2(name_.c_str(), &handle_, how, nullptr);
  if (result == SQLITE_CANTOPEN && mode == Mode::kRead) {
    sqlite3_close(handle_);
    result = sqlite3_open_v2(name_.c_str(), &handle_, SQLITE_OPEN_READONLY | SQLITE_OPEN_NOMUTEX,
                             nullptr);
  }
  if (result != SQLITE_OK) {
    const std::string reason = handle_ == nullptr ? "no memory" : sqlite3_errmsg(handle_);
    sqlite3_close(handle_);
    throw std::runtime_error(fmt::format("{}: cannot be opened: {}", name_, reason));
  }
  set_waiting();
}

void Database::set_waiting() {
  if (!while_busy_) {
    sqlite3_busy_timeout(handle_, kShortWaitMs);
    return;
  }
  // A member of an object that is not moved: it outlives the handle.
  const auto ask = [](void* while_busy, int tries) -> int {
    if (!(*static_cast<WhileBusy*>(while_busy))(tries * kBetweenTriesMs / 1e3)) return 0;
    sqlite3_sleep(kBetweenTriesMs);
    return 1;
  };
  sqlite3_busy_handler(handle_, ask, &while_busy_);
}

Database::~Database() { sqlite3_close(handle_); }

void Database::execute(const std::string& sql) {
  if (sqlite3_exec(handle_, sql.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK) fail("execute");
}

void Database::roll_back() {
  // Errors like a full disk may have done it already.
  if (sqlite3_get_autocommit(handle_) == 0) execute("ROLLBACK");
}

void Database::fail(std::string_view doing) const {
  throw std::runtime_error(fmt::format("{}: {}: {}", name_, doing, sqlite3_errmsg(handle_)));
}

Statement::Statement(Database& database, std::string_view sql) : database_(database) {
  const int size = static_cast<int>(sql.size());
  if (sqlite3_prepare_v2(database.handle_, sql.data(), size, &handle_, nullptr) != SQLITE_OK) {
    database.fail(sql);
  }
}

Statement::~Statement() { sqlite3_finalize(handle_); }

bool Statement::next() {
  const int result = sqlite3_step(handle_);
  if (result == SQLITE_ROW) return true;
  if (result != SQLITE_DONE) {
    // The reason outlives the reset: SQLite gives it again.
    sqlite3_reset(handle_);
    database_.fail("step");
  }
  sqlite3_reset(handle_);
  return false;
}

std::int64_t Statement::integer(int column) const { return sqlite3_column_int64(handle_, column); }
double Statement::real(int column) const { return sqlite3_column_double(handle_, column); }
bool Statement::is_null(int column) const {
  return sqlite3_column_type(handle_, column) == SQLITE_NULL;
}
bool Statement::is_real(int column) const {
  return sqlite3_column_type(handle_, column) == SQLITE_FLOAT;
}

std::string Statement::text(int column) const {
  const auto* text = reinterpret_cast<const char*>(sqlite3_column_text(handle_, column));
  return text == nullptr ? std::string() : std::string(text);
}

void Statement::bind(int place, std::int64_t value) {
  if (sqlite3_bind_int64(handle_, place, value) != SQLITE_OK) database_.fail("bind");
}

void Statement::bind(int place, double value) {
  if (sqlite3_bind_double(handle_, place, value) != SQLITE_OK) database_.fail("bind");
}

void Statement::bind(int place, std::string_view value) {
  const int size = static_cast<int>(value.size());
  if (sqlite3_bind_text(handle_, place, value.data(), size, SQLITE_TRANSIENT) != SQLITE_OK) {
    database_.fail("bind");
  }
}

void Statement::bind(int place, std::nullopt_t) {
  if (sqlite3_bind_null(handle_, place) != SQLITE_OK) database_.fail("bind");
}

}  // namespace sim::record
