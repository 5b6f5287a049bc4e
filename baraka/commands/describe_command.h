#pragma once

#include <string>

namespace baraka::commands {

/// `baraka describe`: what files, their keys and controllers' parameters mean.
/// @param what  a kind of file; a key, as a dotted path or its end; a controller; empty: the kinds.
/// @return exit status. @throws UsageError if nothing is called that.
int describe(const std::string& what);

/// All kinds and keys as the page docs/keys.md.
std::string keys_page();

}  // namespace baraka::commands
