#include "results/capsule/capsule.h"

#include <fmt/format.h>
#include <link.h>

#include <nlohmann/json.hpp>
#include <set>
#include <system_error>

#include "results/capsule/archive.h"
#include "results/capsule/sha256.h"
#include "results/capsule/slim_database.h"

namespace results::capsule {
namespace {

namespace fs = std::filesystem;
using ManifestJson = nlohmann::ordered_json;

/// Files of the libraries in this process: "libode.so.8.1.0", with the version that their maker
/// gave them.
std::set<std::string> libraries() {
  std::set<std::string> names;
  dl_iterate_phdr(
      [](dl_phdr_info* info, std::size_t, void* found) {
        std::error_code unreadable;
        const fs::path file = fs::canonical(info->dlpi_name, unreadable);
        if (!unreadable)
          static_cast<std::set<std::string>*>(found)->insert(file.filename().string());
        return 0;
      },
      &names);
  return names;
}

std::string shell_quoted(const std::string& word) {
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

std::string play_script(const Study& content) {
  std::string runs;
  for (const Played& one : content.played) {
    std::string options;
    for (const std::string& word : one.options) options += " " + shell_quoted(word);
    runs += fmt::format("play {} {} {}{}\n", shell_quoted(one.label), one.fingerprint,
                        shell_quoted(one.scenario), options);
  }
  return fmt::format(R"sh(#!/bin/sh
# Plays every run of this capsule again and compares fingerprints: ./play.sh [BARAKA]
# Status 0: all are equal; 1: at least one is not.
baraka=${{1:-baraka}}
case $baraka in /*) ;; */*) baraka=$PWD/$baraka ;; esac
cd "$(dirname "$0")" || exit 1
export BARAKA_CONTROLLER_PATH="$PWD/controllers${{BARAKA_CONTROLLER_PATH:+:$BARAKA_CONTROLLER_PATH}}"
results=$(mktemp -d) || exit 1
trap 'rm -rf "$results"' EXIT
status=0 number=0

play() {{  # LABEL FINGERPRINT SCENARIO OPTION...
  label=$1 wanted=$2 scenario=$3
  shift 3
  number=$((number + 1))
  found=$("$baraka" run "$scenario" "$@" --controllers in-process --out "$results/$number" 2>"$results/$number.err" |
    sed -n 's/^fingerprint: //p')
  if [ "$found" = "$wanted" ]; then
    echo "equal: $label: $found"
  else
    echo "DIFFERS: $label: ${{found:-no fingerprint}}, not $wanted"
    cat "$results/$number.err"
    status=1
  fi
  rm -rf "${{results:?}}/$number"
}}

{}exit $status
)sh",
                     runs);
}

std::string readme(const Study& content) {
  return fmt::format(R"(# {}

A capsule of BARAKA: {} and what is needed to play {} again.

    ./play.sh            with `baraka` on the path, version {}

`capsule.json` lists what is in here with digests, the versions of the libraries, and the tables of the database that
were left out. `scenarios/` has the scenarios with all values resolved, `controllers/` the controllers that are text.
To cite: authors and title of the study, this file with its SHA-256, and BARAKA by its CITATION.cff.
)",
                     content.name, content.played.size() == 1 ? "a run" : "runs",
                     content.played.size() == 1 ? "it" : "them", content.version);
}

ManifestJson manifest(const Study& content, const std::map<std::string, std::int64_t>& emptied) {
  ManifestJson json = {{"capsule", 1},
                       {"name", content.name},
                       {"baraka", content.version},
                       {"libraries", libraries()},
                       {"runs", ManifestJson::array()},
                       {"files", ManifestJson::array()},
                       {"tables_left_out", emptied}};
  for (const Played& one : content.played) {
    json["runs"].push_back({{"label", one.label},
                            {"scenario", one.scenario},
                            {"options", one.options},
                            {"fingerprint", one.fingerprint}});
  }
  for (const CapsulePart& part : content.parts) {
    json["files"].push_back(
        {{"name", part.name}, {"sha256", sha256_of(part.file)}, {"is_here", part.whole}});
  }
  return json;
}

/// A file that is removed when this object ends.
struct Temporary {
  explicit Temporary(fs::path path) : file(std::move(path)) {}
  ~Temporary() {
    std::error_code ignored;
    fs::remove(file, ignored);
  }
  Temporary(const Temporary&) = delete;
  Temporary& operator=(const Temporary&) = delete;
  fs::path file;
};

}  // namespace

void write_capsule(const Study& content, const fs::path& file, std::int64_t most_rows) {
  const Temporary slim(file.string() + ".database");
  const auto emptied = copy_without_bulk(content.database, slim.file, most_rows);
  const Temporary unfinished(file.string() + ".part");
  Archive archive(unfinished.file);
  archive.add("README.md", readme(content));
  archive.add("capsule.json", manifest(content, emptied).dump(2) + "\n");
  archive.add("play.sh", play_script(content), true);
  for (const auto& [name, text] : content.scenarios) archive.add(name, text);
  for (const CapsulePart& part : content.parts) {
    if (part.whole) archive.add_file(part.name, part.file);
  }
  archive.add_file("results/" + content.database.filename().string(), slim.file);
  if (!content.report.empty()) archive.add("results/report.html", content.report);
  archive.close();
  fs::rename(unfinished.file, file);
}

}  // namespace results::capsule
