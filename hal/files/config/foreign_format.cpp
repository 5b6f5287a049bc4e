#include "hal/files/config/foreign_format.h"

#include <filesystem>

namespace hal::files::config {
namespace {

constexpr std::string_view kSpace = " \t\r\n";
constexpr std::string_view kByteOrderMark = "\xef\xbb\xbf";
constexpr std::string_view kDatabase{"SQLite format 3\0", 16};
constexpr const char* kReadResults = "`baraka report` and `baraka view` take a folder of results";

std::string_view without_space(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(kSpace);
  return begin == std::string_view::npos ? std::string_view{} : text.substr(begin);
}

/// The name of the first element, after declarations, `<?…?>`, and comments, `<!--…-->` (Extensible
/// Markup Language 1.0, 5th edition, 2.8).
std::string_view first_element(std::string_view text) {
  for (text = without_space(text); text.starts_with("<?") || text.starts_with("<!");
       text = without_space(text)) {
    const std::string_view closing = text.starts_with("<!--") ? "-->" : ">";
    const std::size_t end = text.find(closing);
    if (end == std::string_view::npos) return {};
    text.remove_prefix(end + closing.size());
  }
  if (!text.starts_with('<')) return {};
  text.remove_prefix(1);
  return text.substr(0, text.find_first_of(" \t\r\n/>"));
}

}  // namespace

std::optional<std::string> foreign_format(std::string_view text) {
  if (text.starts_with(kDatabase)) {
    return std::string("is a database of SQLite, not YAML; ") + kReadResults;
  }
  if (text.find('\0') != std::string_view::npos) return "is binary, not YAML";
  if (text.starts_with(kByteOrderMark)) text.remove_prefix(kByteOrderMark.size());
  if (!without_space(text).starts_with('<')) return std::nullopt;
  const std::string_view element = first_element(text);
  if (element == "robot")
    return "is URDF, which a scenario takes as `robot: {urdf: FILE, drive: {left: JOINT, right: "
           "JOINT}}`";
  if (element == "sdf")
    return "is SDF, which a scenario takes as `robot: {sdf: FILE}` or `world: {sdf: FILE}`";
  return "is XML, not YAML";
}

std::string folder_instead_of_file(const std::string& folder) {
  std::string said = "is a directory, not a file";
  for (const char* database : {"run.sqlite", "campaign.sqlite"}) {
    std::error_code error;
    if (std::filesystem::exists(std::filesystem::path(folder) / database, error)) {
      return said + "; it holds results: " + kReadResults;
    }
  }
  return said;
}

}  // namespace hal::files::config
