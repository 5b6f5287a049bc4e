#pragma once

#include <memory>
#include <string>
#include <vector>

#include "results/record/schema.h"

struct sqlite3;
struct sqlite3_stmt;

namespace results::record {

using PreparedSql = std::unique_ptr<sqlite3_stmt, int (*)(sqlite3_stmt*)>;

/// Prepares a statement whose cells are not checked. @return null if SQLite refuses it.
PreparedSql prepared(sqlite3* handle, const std::string& sql);

/// Text of a cell of the current row; "" if it is null.
std::string text_at(sqlite3_stmt* statement, int column);

/// @param file  for messages.
/// @throws std::runtime_error  a table or view is missing, or differs from what create_tables()
/// makes. Otherwise a view with the name of a table could be endless, or a computed column could
/// have any size.
void require_tables(sqlite3* handle, const std::string& file, const std::vector<Table>& tables);

}  // namespace results::record
