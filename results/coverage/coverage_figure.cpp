#include "results/coverage/coverage_figure.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "hal/types/math.h"
#include "results/report/axis.h"
#include "results/report/drawing.h"

namespace results::coverage {
namespace {

using report::Axis;
using report::escaped;
using sim::physics::StaticBox;

constexpr double kWidth = 640, kLegend = 170, kLeft = 52, kTop = 28, kBottom = 44;  // px
constexpr double kMostHeight = 900;                                                 // px
constexpr const char* kUncovered = "#d9d9d9";

/// From m to px; both axes have the same scale.
struct Sheet {
  explicit Sheet(const Coverage& map) {
    const hal::Vec2 high = map.area.low + hal::Vec2{static_cast<double>(map.columns) * map.step,
                                                    static_cast<double>(map.rows) * map.step};
    const hal::Vec2 size = high - map.area.low;
    const double scale = std::min(kWidth / size.x, kMostHeight / size.y);  // px/m
    x = {map.area.low.x, high.x, kLeft, kLeft + scale * size.x};
    y = {map.area.low.y, high.y, kTop + scale * size.y, kTop};
  }
  double width() const { return x.to + kLegend; }
  double height() const { return std::max(y.from + kBottom, kTop + 320); }
  Axis x, y;
};

std::string cells(const Coverage& map, const Classes& classes, const Sheet& sheet) {
  std::string text = "<g class=\"cells\" shape-rendering=\"crispEdges\">\n";
  const double side = std::abs(sheet.x.at(map.step) - sheet.x.at(0));
  for (std::size_t row = 0; row < map.rows; ++row) {
    for (std::size_t first = 0; first < map.columns;) {
      const std::size_t one = classes.of(map.at(first, row));
      std::size_t end = first + 1;  // of a run of cells of one class
      while (end < map.columns && classes.of(map.at(end, row)) == one) ++end;
      const hal::Vec2 centre = map.centre(first, row);
      fmt::format_to(std::back_inserter(text),
                     "<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\" "
                     "fill=\"{}\"/>\n",
                     sheet.x.at(centre.x - map.step / 2), sheet.y.at(centre.y + map.step / 2),
                     side * static_cast<double>(end - first), side,
                     one < classes.all.size() ? classes.all[one].colour : kUncovered);
      first = end;
    }
  }
  return text + "</g>\n";
}

std::string outline(const StaticBox& wall, const Sheet& sheet) {
  const double c = hal::math::cos(wall.yaw), s = hal::math::sin(wall.yaw);
  std::string points;
  constexpr double kCorners[4][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
  for (const auto& corner : kCorners) {
    const double x = corner[0] * wall.size.x / 2, y = corner[1] * wall.size.y / 2;
    fmt::format_to(std::back_inserter(points), "{:.2f},{:.2f} ",
                   sheet.x.at(wall.centre.x + c * x - s * y),
                   sheet.y.at(wall.centre.y + s * x + c * y));
  }
  return fmt::format("<polygon class=\"wall\" points=\"{}\"><title>{}, {}</title></polygon>\n",
                     points, escaped(wall.name), escaped(wall.material));
}

/// Walls that begin below the receivers' height; those of upper floors are not drawn.
std::string walls_of(const Coverage& map, const Sheet& sheet, std::span<const StaticBox> walls) {
  std::string text = fmt::format(
      "<svg x=\"{0:.2f}\" y=\"{1:.2f}\" width=\"{2:.2f}\" height=\"{3:.2f}\" viewBox=\"{0:.2f} "
      "{1:.2f} {2:.2f} {3:.2f}\"><g fill=\"#222\" stroke=\"#222\" stroke-width=\"0.5\">\n",
      sheet.x.from, sheet.y.to, sheet.x.to - sheet.x.from, sheet.y.from - sheet.y.to);
  for (const StaticBox& wall : walls) {
    const double foot = wall.centre.z - wall.size.z / 2, top = wall.centre.z + wall.size.z / 2;
    if (foot <= map.height && top >= map.height) text += outline(wall, sheet);
  }
  return text + "</g></svg>\n";
}

std::string transmitters_of(const Coverage& map, const Sheet& sheet) {
  std::string text = "<g fill=\"#fff\" stroke=\"#000\" stroke-width=\"1.5\">\n";
  for (const Transmitter& one : map.transmitters) {
    fmt::format_to(std::back_inserter(text),
                   "<circle class=\"transmitter\" cx=\"{0:.2f}\" cy=\"{1:.2f}\" "
                   "r=\"5\"><title>{2}</title></circle>\n<text x=\"{3:.2f}\" y=\"{4:.2f}\" "
                   "stroke=\"#fff\" stroke-width=\"3\" fill=\"#000\" "
                   "paint-order=\"stroke\">{2}</text>\n",
                   sheet.x.at(one.antenna.x), sheet.y.at(one.antenna.y), escaped(one.name),
                   sheet.x.at(one.antenna.x) + 8, sheet.y.at(one.antenna.y) + 4);
  }
  return text + "</g>\n";
}

std::string legend(const Classes& classes, const Sheet& sheet) {
  std::string text = "<g class=\"legend\">\n";
  double y = kTop;
  const auto entry = [&](const std::string& colour, const std::string& label) {
    fmt::format_to(std::back_inserter(text),
                   "<rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"14\" height=\"14\" fill=\"{}\"/>"
                   "<text x=\"{:.2f}\" y=\"{:.2f}\">{}</text>\n",
                   sheet.x.to + 14, y, colour, sheet.x.to + 34, y + 11, escaped(label));
    y += 18;
  };
  for (auto one = classes.all.rbegin(); one != classes.all.rend(); ++one)
    entry(one->colour, one->label);
  entry(kUncovered, "not covered");
  return text + "</g>\n";
}

std::string axes(const Coverage& map, const Sheet& sheet, const std::string& title) {
  report::Drawing drawing;
  const report::Frame frame{sheet.x, sheet.y};
  drawing.axes(frame);
  for (const double at : report::ticks(sheet.x.low, sheet.x.high, 8))
    drawing.x_tick(frame, at, fmt::format("{:g}", at));
  for (const double at : report::ticks(sheet.y.low, sheet.y.high, 8))
    drawing.y_tick(frame, at, fmt::format("{:g}", at));
  drawing.axis_labels(frame, "x, m", 36, "y, m", 40);
  drawing.words(fmt::format("{}, {:g} m above the ground", title, map.height),
                fmt::format(" x=\"{:.2f}\" y=\"16\" font-weight=\"bold\"", sheet.x.from));
  return drawing.document(sheet.width(), sheet.height(), title);
}

/// What stands below the axes goes before them, after the document's head and background.
std::string with_below(std::string document, const std::string& below) {
  const std::size_t head = document.find("</title>");
  document.insert(head + std::string("</title>").size(), "\n" + below);
  return document;
}

std::string share_table(const Coverage& map, Layer layer) {
  const Classes classes = classes_of(map, layer);
  const std::vector<double> shares = shares_of(map, classes);
  std::string text =
      fmt::format("<table>\n<tr><th>{}</th><th>floor</th></tr>\n", escaped(classes.title));
  const auto row = [&text](const std::string& label, double share) {
    text += fmt::format("<tr><td>{}</td><td>{:.1f} %</td></tr>\n", escaped(label), 100 * share);
  };
  for (std::size_t i = classes.all.size(); i-- > 0;)
    if (shares[i] > 0) row(classes.all[i].label, shares[i]);
  row("not covered", shares.back());
  return text + "</table>\n";
}

constexpr const char* kStyle =
    "body{font:15px/1.45 sans-serif;max-width:72rem;margin:2rem auto;padding:0 1rem;color:#222}"
    "table{border-collapse:collapse;margin:.8rem 2rem .8rem 0;display:inline-table}"
    "th,td{padding:.2rem .6rem;text-align:right;border-bottom:1px solid #ddd}"
    "th:first-child,td:first-child{text-align:left}"
    "figure{margin:1rem 0}";

}  // namespace

std::string coverage_svg(const Coverage& map, Layer layer, std::span<const StaticBox> walls) {
  const Classes classes = classes_of(map, layer);
  const Sheet sheet(map);
  return with_below(axes(map, sheet, classes.title),
                    cells(map, classes, sheet) + walls_of(map, sheet, walls) +
                        transmitters_of(map, sheet) + legend(classes, sheet));
}

std::string coverage_page(const Coverage& map, const std::string& title,
                          std::span<const StaticBox> walls) {
  std::string text = fmt::format(
      "<!doctype html>\n<html lang=\"en\">\n<meta charset=\"utf-8\">\n<title>{0}: "
      "coverage</title>\n<style>{1}</style>\n<h1>{0}: coverage</h1>\n<p>Mean power, without "
      "shadowing, fading and interference, {2:g} m above the ground, every {3:g} m. Expected "
      "rate: the highest at which at most {4:g} % of frames of {5} bytes are lost.</p>\n",
      escaped(title), kStyle, map.height, map.step, 100 * kUsableLoss, map.bytes);
  for (const Layer layer : {Layer::kRate, Layer::kBest, Layer::kRssi, Layer::kSnr})
    text += share_table(map, layer);
  for (const NamedLayer& one : kLayers) {
    text += fmt::format("<figure id=\"{}\">\n{}</figure>\n", one.name,
                        coverage_svg(map, one.layer, walls));
  }
  return text + "</html>\n";
}

std::string coverage_text(const Coverage& map) {
  std::string text =
      fmt::format("{} points, {:g} m apart, {:g} m above the ground; mean power, no interference\n",
                  map.spots.size(), map.step, map.height);
  for (const Layer layer : {Layer::kRate, Layer::kBest}) {
    const Classes classes = classes_of(map, layer);
    const std::vector<double> shares = shares_of(map, classes);
    text += fmt::format("\n{:<32} {:>8}\n", classes.title, "floor");
    for (std::size_t i = classes.all.size(); i-- > 0;) {
      if (shares[i] > 0)
        text += fmt::format("{:<32} {:>6.1f} %\n", classes.all[i].label, 100 * shares[i]);
    }
    text += fmt::format("{:<32} {:>6.1f} %\n", "not covered", 100 * shares.back());
  }
  return text;
}

}  // namespace results::coverage
