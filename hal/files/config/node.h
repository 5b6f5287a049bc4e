#pragma once

#include <compare>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace hal::files::config {

/// Precedence when two places set the same key: the higher layer's value counts.
enum class Layer : std::uint8_t {
  kFile,                ///< Written in a file.
  kCommandLineInclude,  ///< In a file that the command line includes.
  kCommandLine,         ///< Written on the command line.
};

/// Position of a value.
struct Place {
  int order = 0;     ///< Index of its file in the order of reading; the command line is first.
  std::string file;  ///< As the user would name it; "--set a.b" for the command line.
  int line = 0;      ///< 1, 2, …; 0: the command line, which has no lines.
  int column = 0;
  Layer layer = Layer::kFile;

  /// "file:line:column", or "--set a.b".
  std::string text() const;
};

struct Entry;

/// One value of a document, with its place. Scalars remain text until they are read as some kind.
struct Node {
  enum class Kind : std::uint8_t { kNull, kScalar, kList, kMapping };
  Kind kind = Kind::kNull;
  Place place;
  std::string text;     ///< kScalar.
  bool quoted = false;  ///< kScalar in quotation marks.
  bool whole = false;   ///< A mapping that replaces the one below instead of being united with it.
  std::vector<Node> items;  ///< kList.
  /// kMapping, in the file's order. kList: changes that match no item.
  std::vector<Entry> entries;

  const Entry* find(const std::string& key) const;
  Entry* find(const std::string& key);
};

struct Entry {
  std::string key;
  Place place;  ///< Place of the key.
  Node value;
};

/// "a mapping", "a list of 2", "'text'", "nothing".
std::string kind_name(const Node& node);

/// The union of two mappings, key by key and level by level. If both set a value, that of the
/// higher layer counts; within one layer, that of `own`. Keys of `below` come first. The command
/// line can set items of a list by their index, from 0; `own` can change a list by {add: […],
/// remove: […]} (list_edit.h).
Node merged(Node below, Node own);

}  // namespace hal::files::config
