#pragma once

#include <string>

namespace view::server {

/// A page in the desktop's browser.
class Browser {
 public:
  /// Opens an address if there is a desktop and standard output is a terminal. Every user of a
  /// machine can read the arguments of its processes (proc(5), cmdline); an address with a token is
  /// therefore written to a file that only this user can read, and the browser opens the file,
  /// which redirects to the address.
  explicit Browser(const std::string& address);
  ~Browser();  ///< Removes the file; the page stays open.
  Browser(const Browser&) = delete;
  Browser& operator=(const Browser&) = delete;

 private:
  std::string file_;  ///< Empty: there is no file.
};

}  // namespace view::server
