#pragma once

#include <cstdio>
#include <memory>
#include <string>
#include <string_view>

namespace baraka::commands {

/// A file that a command writes, or standard output. What stood there stays until the new one is
/// whole: it is written beside it and renamed, so that a full disk leaves nothing cut under the
/// name that was asked for. Devices and pipes (/dev/stdout) are written as they are.
///
///   OutputFile output("report.html");
///   output.write(text);
///   output.finish();
///
/// Every call throws std::runtime_error "report.html: No space left on device".
class OutputFile {
 public:
  /// @param file  empty: standard output.
  explicit OutputFile(const std::string& file);
  ~OutputFile();  ///< Not finished: what was written is removed.
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  void write(std::string_view text);
  void finish();  ///< Once, after everything.

 private:
  struct Closed {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::FILE* stream() { return file_ ? file_.get() : stdout; }
  [[noreturn]] void fail() const;

  std::string name_;     ///< As it is called in errors.
  std::string target_;   ///< What the finished file is renamed to; empty: it is written in place.
  std::string written_;  ///< Beside it.
  std::unique_ptr<std::FILE, Closed> file_;
};

/// The whole file in one call.
void write_output(const std::string& file, std::string_view text);

}  // namespace baraka::commands
