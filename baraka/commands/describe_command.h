#pragma once

#include <string>

namespace baraka::commands {

/// `baraka describe`: prints the meaning of files, their keys and controllers' parameters.
/// @param what  a kind of file; a key, as a dotted path or the end of one; a controller; empty:
/// lists
///   the kinds of files.
/// @return exit status. @throws UsageError if nothing has that name.
int describe(const std::string& what);

/// The page docs/keys.md, with all kinds of files and their keys.
std::string keys_page();

}  // namespace baraka::commands
