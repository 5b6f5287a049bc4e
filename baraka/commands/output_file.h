#pragma once

#include <cstdio>
#include <memory>
#include <string>
#include <string_view>

namespace baraka::commands {

/// A file that a command writes, or standard output. The new content is written to a file beside
/// the old one and then renamed, so that the old file stays until the new one is complete, also on
/// a full disk. Devices and pipes (/dev/stdout) are written directly.
///
///   OutputFile output("report.html");
///   output.write(text);
///   output.finish();
///
/// Errors of every call: std::runtime_error, for example "report.html: No space left on device".
class OutputFile {
 public:
  /// @param file  empty: standard output.
  explicit OutputFile(const std::string& file);
  ~OutputFile();  ///< Without finish(), the written data are removed.
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  void write(std::string_view text);
  void finish();  ///< To be called once, last.

 private:
  struct Closed {
    void operator()(std::FILE* file) const { std::fclose(file); }
  };
  std::FILE* stream() { return file_ ? file_.get() : stdout; }
  [[noreturn]] void fail() const;

  std::string name_;     ///< Name for error messages.
  std::string target_;   ///< Final name of the file; empty: it is written in place.
  std::string written_;  ///< Name of the file that is written, beside target_.
  std::unique_ptr<std::FILE, Closed> file_;
};

/// Writes a whole file in one call.
void write_output(const std::string& file, std::string_view text);

}  // namespace baraka::commands
