#include "view/server/browser.h"

#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>

namespace view::server {
namespace {

/// Writes a file that redirects to the address. @return its path; empty if it cannot be written.
std::string file_that_leads_to(const std::string& address) {
  std::error_code error;
  const auto folder = std::filesystem::temp_directory_path(error);
  if (error) return "";
  std::string path = (folder / "baraka-view-XXXXXX.html").string();
  const int file = ::mkstemps(path.data(), 5);
  if (file < 0) return "";
  const std::string page = fmt::format(
      "<!doctype html><meta charset=\"utf-8\"><meta name=\"referrer\" content=\"no-referrer\">"
      "<meta http-equiv=\"refresh\" content=\"0; url={}\">\n",
      address);
  const bool is_written =
      ::write(file, page.data(), page.size()) == static_cast<ssize_t>(page.size());
  ::close(file);
  if (is_written) return path;
  ::unlink(path.c_str());
  return "";
}

void start(const std::string& what) {
  const pid_t child = ::fork();
  if (child == 0) {
    // Forks again, so that the browser is not our child, and discards its output.
    if (::fork() != 0) ::_exit(0);
    ::setsid();
    if (::freopen("/dev/null", "r+", stdout) == nullptr) ::_exit(1);
    ::dup2(STDOUT_FILENO, STDERR_FILENO);
    ::execlp("xdg-open", "xdg-open", what.c_str(), nullptr);
    ::_exit(127);
  }
  if (child > 0) ::waitpid(child, nullptr, 0);
}

}  // namespace

Browser::Browser(const std::string& address) {
  const bool has_desktop =
      std::getenv("DISPLAY") != nullptr || std::getenv("WAYLAND_DISPLAY") != nullptr;
  if (!has_desktop || ::isatty(STDOUT_FILENO) == 0) return;
  const bool is_secret = address.find('#') != std::string::npos;
  if (is_secret) file_ = file_that_leads_to(address);
  if (!is_secret) {
    start(address);
  } else if (!file_.empty()) {
    start(file_);
  }
}

Browser::~Browser() {
  if (!file_.empty()) ::unlink(file_.c_str());
}

}  // namespace view::server
