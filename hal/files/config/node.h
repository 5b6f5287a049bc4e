#pragma once

#include <compare>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace hal::files::config {

/// Whose word counts when two places set the same key: the higher one's.
enum class Layer : std::uint8_t {
  kFile,                ///< Written in a file.
  kCommandLineInclude,  ///< In a file that the command line includes.
  kCommandLine,         ///< Written on the command line.
};

/// Where something stands.
struct Place {
  int order = 0;     ///< Of its file among those read; the command line comes first.
  std::string file;  ///< As the user would name it; "--set a.b" for the command line.
  int line = 0;      ///< 1, 2, …; 0: the command line, which has no lines.
  int column = 0;
  Layer layer = Layer::kFile;

  /// "file:line:column", or "--set a.b".
  std::string text() const;
};

struct Entry;

/// One value of a document, with its place. Scalars stay text until somebody asks for a kind.
struct Node {
  enum class Kind : std::uint8_t { kNull, kScalar, kList, kMapping };
  Kind kind = Kind::kNull;
  Place place;
  std::string text;            ///< kScalar.
  bool quoted = false;         ///< kScalar in quotation marks.
  bool whole = false;          ///< A mapping that replaces what lies below instead of adding to it.
  std::vector<Node> items;     ///< kList.
  std::vector<Entry> entries;  ///< kMapping, in order of the file. kList: changes to no item of it.

  const Entry* find(const std::string& key) const;
  Entry* find(const std::string& key);
};

struct Entry {
  std::string key;
  Place place;  ///< Of the key.
  Node value;
};

/// "a mapping", "a list of 2", "'text'", "nothing".
std::string kind_name(const Node& node);

/// The union of two mappings, key by key and level by level. Where both set a value, the higher
/// layer's counts and, within one layer, `own`. Keys of `below` come first. Of a list, the command
/// line can set items by their number, from 0; `own` can change one by {add: […], remove: […]}
/// (list_edit.h).
Node merged(Node below, Node own);

}  // namespace hal::files::config
