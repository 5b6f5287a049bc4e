#include <fmt/format.h>

#include "results/report/report_format.h"
#include "results/report/report_sections.h"
#include "results/report/text_table.h"

namespace results::report {
namespace {

std::vector<std::string> head_of(const RunResult& run) {
  return {run.folder, run.value("profile"), run.value("seed"), run.ending(),
          number(run.number("simulated_s"), 1)};
}

std::vector<std::string> row(const RunResult& run, const RobotDrive& drive) {
  std::vector<std::string> cells = head_of(run);
  for (const std::string& cell :
       {drive.robot, number(drive.path, 1), number(drive.straight, 1), number(drive.ratio(), 2),
        number(drive.clearance, 2), number(drive.wall_steps, 0), number(drive.object_steps, 0)}) {
    cells.push_back(cell);
  }
  return cells;
}

}  // namespace

std::string runs_section(const std::vector<RunResult>& runs) {
  TextTable table({"run", "profile", "seed", "result", "time s", "robot", "path m", "straight m",
                   "ratio", "clearance m", "wall contacts", "other contacts"});
  for (const RunResult& run : runs) {
    const std::vector<RobotDrive> robots = drives(run);
    for (const RobotDrive& drive : robots) table.add_row(row(run, drive));
    if (robots.empty()) table.add_row(head_of(run));
  }
  return "Runs (straight: from its start to the goal, else to its end; ratio: path / straight, - "
         "if "
         "it came back; clearance: robot's centre to the nearest wall's surface; contacts: physics "
         "steps in touch, at rest too)\n" +
         table.text();
}

}  // namespace results::report
