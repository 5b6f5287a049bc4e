#include "results/record/database.h"

#include <fmt/format.h>
#include <sqlite3.h>

#include <fstream>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "results/record/cell_check.h"

namespace results::record {
namespace {

using Kind = CellRule::Kind;

constexpr int kBetweenTriesMs = 100, kShortWaitMs = 5000;

bool has_content(const std::string& file) {
  std::error_code none;
  const auto size = std::filesystem::file_size(file, none);
  return !none && size > 0;
}

/// Whether a journal belongs to a transaction over several files, which ours never do. To roll such
/// a journal back, SQLite would read the file that it names as a list of journals, and delete that
/// file (sqlite.org/atomiccommit.html).
bool names_another_file(const std::string& journal) {
  constexpr std::string_view kMagic = "\xd9\xd5\x05\xf9\x20\xa1\x63\xd7";
  std::ifstream file(journal, std::ios::binary);
  file.seekg(-static_cast<std::streamoff>(kMagic.size()), std::ios::end);
  std::string end(kMagic.size(), '\0');
  return file.read(end.data(), static_cast<std::streamsize>(end.size())) && end == kMagic;
}

}  // namespace

Database::Database(const std::filesystem::path& file, Mode mode, WhileBusy while_busy)
    : name_(file.string()), while_busy_(std::move(while_busy)) {
  if (mode == Mode::kCreate) {
    for (const char* part : {"", "-journal", "-wal", "-shm"}) {
      std::filesystem::remove(name_ + part);
    }
  }
  // Without SQLite's own mutex: only one thread at a time uses the connection.
  constexpr int kWrite = SQLITE_OPEN_READWRITE | SQLITE_OPEN_NOMUTEX;
  if (mode == Mode::kRead) {
    // A journal or write-ahead log of a writer that was killed, or is running, has to be processed,
    // which needs write access.
    const std::string journal = name_ + "-journal";
    if (has_content(journal) && names_another_file(journal)) {
      throw std::runtime_error(
          fmt::format("{}: its journal {} names another file: not left by baraka", name_, journal));
    }
    open(has_content(journal) || has_content(name_ + "-wal") ? kWrite : SQLITE_OPEN_READONLY);
  } else {
    open(kWrite | SQLITE_OPEN_CREATE);
  }
  set_waiting();
}

void Database::open(int how) {
  constexpr int kReadOnly = SQLITE_OPEN_READONLY | SQLITE_OPEN_NOMUTEX;
  // Without counting all memory, for which each allocation would lock a mutex.
  [[maybe_unused]] static const int uncounted = sqlite3_config(SQLITE_CONFIG_MEMSTATUS, 0);
  int result = sqlite3_open_v2(name_.c_str(), &handle_, how | SQLITE_OPEN_NOMUTEX, nullptr);
  if (result == SQLITE_CANTOPEN && (how & SQLITE_OPEN_CREATE) == 0) {
    sqlite3_close(handle_);
    result = sqlite3_open_v2(name_.c_str(), &handle_, kReadOnly, nullptr);
  }
  if (result == SQLITE_OK) return;
  const std::string reason = handle_ == nullptr ? "no memory" : sqlite3_errmsg(handle_);
  sqlite3_close(handle_);
  throw std::runtime_error(fmt::format("{}: cannot be opened: {}", name_, reason));
}

void Database::set_waiting() {
  if (!while_busy_) {
    sqlite3_busy_timeout(handle_, kShortWaitMs);
    return;
  }
  // The address of a member stays valid as long as the handle: this object is never moved.
  const auto ask = [](void* while_busy, int tries) -> int {
    if (!(*static_cast<WhileBusy*>(while_busy))(tries * kBetweenTriesMs / 1e3)) return 0;
    sqlite3_sleep(kBetweenTriesMs);
    return 1;
  };
  sqlite3_busy_handler(handle_, ask, &while_busy_);
}

Database::~Database() {
  check_.reset();
  sqlite3_close(handle_);
}

void Database::read_only_sound(const std::vector<Table>& tables) {
  check_ = std::make_unique<CellCheck>(handle_, name_, tables);
}

void Database::know(const std::vector<std::int64_t>& agents, std::int64_t end) {
  check_->learn(agents, end);
}

void Database::execute(const std::string& sql) {
  if (sqlite3_exec(handle_, sql.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK) fail("execute");
}

void Database::roll_back() {
  // An error such as a full disk may have rolled back already.
  if (sqlite3_get_autocommit(handle_) == 0) execute("ROLLBACK");
}

void Database::fail(std::string_view doing) const {
  throw std::runtime_error(fmt::format("{}: {}: {}", name_, doing, sqlite3_errmsg(handle_)));
}

Statement::Statement(Database& database, std::string_view sql) : database_(database) {
  const int size = static_cast<int>(sql.size());
  if (database_.check_) database_.check_->begin();
  if (sqlite3_prepare_v2(database.handle_, sql.data(), size, &handle_, nullptr) != SQLITE_OK) {
    database.fail(sql);
  }
  if (!database_.check_) return;
  reading_ = std::make_unique<ColumnsRead>(database_.check_->take(handle_));
}

Statement::~Statement() { sqlite3_finalize(handle_); }

bool Statement::next() {
  const int result = sqlite3_step(handle_);
  if (result == SQLITE_ROW) return true;
  if (result != SQLITE_DONE) {
    // SQLite still knows the reason after the reset.
    sqlite3_reset(handle_);
    if (reading_) database_.check_->fail(*reading_);
    database_.fail("step");
  }
  sqlite3_reset(handle_);
  return false;
}

std::int64_t Statement::integer(int column) const {
  if (reading_) database_.check_->check(handle_, column, Kind::kInteger, *reading_);
  return sqlite3_column_int64(handle_, column);
}

double Statement::real(int column) const {
  if (reading_) database_.check_->check(handle_, column, Kind::kReal, *reading_);
  return sqlite3_column_double(handle_, column);
}

bool Statement::is_null(int column) const {
  if (sqlite3_column_type(handle_, column) != SQLITE_NULL) return false;  // read, then checked
  if (reading_) database_.check_->check(handle_, column, Kind::kAny, *reading_);
  return true;
}

bool Statement::is_real(int column) const {
  return sqlite3_column_type(handle_, column) == SQLITE_FLOAT;
}

std::string Statement::text(int column) const {
  if (reading_) database_.check_->check(handle_, column, Kind::kText, *reading_);
  const auto* text = reinterpret_cast<const char*>(sqlite3_column_text(handle_, column));
  return text == nullptr ? std::string() : std::string(text);
}

void Statement::refuse(int column, std::string_view why) const {
  if (reading_) database_.check_->refuse(handle_, column, *reading_, why);
  database_.fail(why);
}

void Statement::bind(int place, std::int64_t value) {
  if (sqlite3_bind_int64(handle_, place, value) != SQLITE_OK) database_.fail("bind");
}

void Statement::bind(int place, double value) {
  if (sqlite3_bind_double(handle_, place, value) != SQLITE_OK) database_.fail("bind");
}

void Statement::bind(int place, std::string_view value) {
  const int size = static_cast<int>(value.size());
  const auto how = copies_ ? SQLITE_TRANSIENT : SQLITE_STATIC;
  if (sqlite3_bind_text(handle_, place, value.data(), size, how) != SQLITE_OK) {
    database_.fail("bind");
  }
}

void Statement::bind(int place, std::nullopt_t) {
  if (sqlite3_bind_null(handle_, place) != SQLITE_OK) database_.fail("bind");
}

}  // namespace results::record
