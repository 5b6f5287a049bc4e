#pragma once

#include <string>

namespace view::server {

/// A page in the desktop's browser.
class Browser {
 public:
  /// Opens an address if there is a desktop and somebody sits at a terminal. Every user of a
  /// machine may read the arguments of its processes (proc(5), cmdline), so that an address with a
  /// token stands in a file that leads there, and that only this user may read.
  explicit Browser(const std::string& address);
  ~Browser();  ///< Removes the file; the page stays.
  Browser(const Browser&) = delete;
  Browser& operator=(const Browser&) = delete;

 private:
  std::string file_;  ///< Empty: none.
};

}  // namespace view::server
