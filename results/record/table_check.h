#pragma once

#include <memory>
#include <string>
#include <vector>

#include "results/record/schema.h"

struct sqlite3;
struct sqlite3_stmt;

namespace results::record {

using PreparedSql = std::unique_ptr<sqlite3_stmt, int (*)(sqlite3_stmt*)>;

/// A statement that nothing checks: null if SQLite refuses it.
PreparedSql prepared(sqlite3* handle, const std::string& sql);

/// Of the current row; "" for a null.
std::string text_at(sqlite3_stmt* statement, int column);

/// @param file  for messages.
/// @throws std::runtime_error  a table or view is not there, or is not as create_tables() makes it:
///   a view by the name could be endless, a computed column be of any size.
void require_tables(sqlite3* handle, const std::string& file, const std::vector<Table>& tables);

}  // namespace results::record
