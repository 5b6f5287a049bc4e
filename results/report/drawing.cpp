#include "results/report/drawing.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>

namespace results::report {
namespace {

constexpr std::array kColours = {"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                                 "#E69F00", "#56B4E9", "#000000", "#8A6D00"};
constexpr std::array kDashes = {"none", "6 3", "2 2", "8 3 2 3"};
constexpr std::array<std::string_view, 5> kSymbols = {
    "M-4,0a4,4 0 1,0 8,0a4,4 0 1,0 -8,0Z", "M-3.5,-3.5h7v7h-7Z", "M0,-4.8L4.4,3.4H-4.4Z",
    "M0,-5L5,0L0,5L-5,0Z", "M0,4.8L4.4,-3.4H-4.4Z"};
constexpr double kPerLetter = 6.6;  // px, of the 12 px letters of common sans-serif fonts

template <class... Values>
void append(std::string& to, fmt::format_string<Values...> format, Values&&... values) {
  fmt::format_to(std::back_inserter(to), format, std::forward<Values>(values)...);
}

std::string opacity_attribute(double opacity) {
  return opacity < 1 ? fmt::format(" opacity=\"{:g}\"", opacity) : "";
}

std::string paint_of(const Symbol& symbol) {
  return symbol.is_filled ? "fill=\"currentColor\""
                          : "fill=\"none\" stroke=\"currentColor\" stroke-width=\"1.5\"";
}

}  // namespace

const char* colour_of(int curve) {
  if (curve < 0) return "#666666";
  return kColours.at(static_cast<std::size_t>(curve) % kColours.size());
}

const char* dash_of(int curve) {
  if (curve < 0) return kDashes[0];
  return kDashes.at(static_cast<std::size_t>(curve) / kColours.size() % kDashes.size());
}

Symbol symbol_of(std::size_t curve) { return {kSymbols.at(curve % kSymbols.size())}; }

std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '<':
        result += "&lt;";
        break;
      case '>':
        result += "&gt;";
        break;
      case '&':
        result += "&amp;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
    }
  }
  return result;
}

double width_of(const std::string& text) {
  const auto is_first = [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; };
  return kPerLetter * static_cast<double>(std::count_if(text.begin(), text.end(), is_first));
}

void Drawing::axes(const Frame& frame) {
  append(text_,
         "<g class=\"axis\" stroke=\"#444\" fill=\"none\">\n"
         "<path d=\"M{0},{1}V{2}H{3}\"/>\n</g>\n",
         frame.left(), frame.top(), frame.bottom(), frame.right());
}

void Drawing::x_tick(const Frame& frame, double value, const std::string& text, bool is_slanted) {
  const double x = frame.x.at(value);
  const double y = frame.bottom() + 19;
  append(text_, "<path class=\"axis\" d=\"M{:.2f},{:.2f}v5\" stroke=\"#444\"/>", x, frame.bottom());
  if (is_slanted) {
    append(text_,
           "<text class=\"tick\" text-anchor=\"end\" "
           "transform=\"translate({:.2f},{:.2f}) rotate(-45)\">{}</text>\n",
           x + 4, y - 5, escaped(text));
    return;
  }
  append(text_, "<text class=\"tick\" text-anchor=\"middle\" x=\"{:.2f}\" y=\"{:.2f}\">{}</text>\n",
         x, y, escaped(text));
}

void Drawing::y_tick(const Frame& frame, double value, const std::string& text) {
  const double y = frame.y.at(value);
  append(text_, "<path class=\"grid\" d=\"M{:.2f},{:.2f}H{:.2f}\" stroke=\"#ddd\"/>", frame.left(),
         y, frame.right());
  append(text_, "<text class=\"tick\" text-anchor=\"end\" x=\"{:.2f}\" y=\"{:.2f}\">{}</text>\n",
         frame.left() - 6, y + 4, escaped(text));
}

void Drawing::axis_labels(const Frame& frame, const std::string& x, double below,
                          const std::string& y, double beside) {
  append(text_, "<text class=\"label\" text-anchor=\"middle\" x=\"{}\" y=\"{}\">{}</text>\n",
         (frame.left() + frame.right()) / 2, frame.bottom() + below, escaped(x));
  append(text_,
         "<text class=\"label\" text-anchor=\"middle\" "
         "transform=\"translate({},{}) rotate(-90)\">{}</text>\n",
         frame.left() - beside, (frame.top() + frame.bottom()) / 2, escaped(y));
}

void Drawing::open_curve(int curve) {
  append(text_, "<g class=\"curve {}\" color=\"{}\">\n",
         curve < 0 ? "neutral" : fmt::format("curve-{}", curve), colour_of(curve));
}

void Drawing::open_shifted(double right) {
  append(text_, "<g transform=\"translate({:.1f},0)\">\n", right);
}

void Drawing::open_clip(const Frame& frame) {
  append(text_,
         "<svg class=\"clip\" x=\"{0}\" y=\"{1}\" width=\"{2}\" height=\"{3}\" "
         "viewBox=\"{0} {1} {2} {3}\" overflow=\"hidden\">\n",
         frame.left(), frame.top(), frame.right() - frame.left(), frame.bottom() - frame.top());
}

void Drawing::line(const std::string& path, const Stroke& stroke) {
  append(text_,
         "<path class=\"line\" fill=\"none\" stroke=\"currentColor\" stroke-width=\"{}\" "
         "stroke-dasharray=\"{}\"{} d=\"{}\"/>\n",
         stroke.width, stroke.dash, opacity_attribute(stroke.opacity), path);
}

void Drawing::area(const std::string& path, double opacity) {
  append(text_, "<path class=\"band\" fill=\"currentColor\" opacity=\"{}\" d=\"{}\"/>\n", opacity,
         path);
}

void Drawing::bin(const Box& box, double opacity, const Tip& tip) {
  append(text_,
         "<rect class=\"bin\"{} x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" "
         "height=\"{:.2f}\" fill=\"currentColor\" fill-opacity=\"{}\" stroke=\"currentColor\">"
         "<title>{}</title></rect>\n",
         tip.attributes, box.left, box.top, box.width, box.height, opacity, escaped(tip.title));
}

void Drawing::point(double x, double y, const Symbol& symbol, const Tip& tip, const Look& look) {
  append(text_, "<path class=\"point\"{} {}{} transform=\"translate({:.2f},{:.2f}){}\" d=\"{}\"",
         tip.attributes, paint_of(symbol), opacity_attribute(look.opacity), x, y,
         look.scale == 1 ? "" : fmt::format(" scale({:g})", look.scale), symbol.path);
  if (tip.title.empty()) {
    text_ += "/>\n";
  } else {
    append(text_, "><title>{}</title></path>\n", escaped(tip.title));
  }
}

void Drawing::interval(double x, double low, double high, bool low_cap, bool high_cap) {
  append(text_,
         "<path class=\"interval\" stroke=\"currentColor\" fill=\"none\" "
         "d=\"M{:.2f},{:.2f}{}V{:.2f}{}\"/>\n",
         low_cap ? x - 4 : x, low, low_cap ? "h8m-4,0" : "", high, high_cap ? "m-4,0h8" : "");
}

void Drawing::legend_entry(double x, double y, const Entry& entry) {
  append(text_, "<g class=\"{}\" color=\"{}\">",
         entry.curve < 0 ? "neutral" : fmt::format("curve-{}", entry.curve),
         colour_of(entry.curve));
  if (entry.box_opacity > 0) {
    append(text_,
           "<rect x=\"{}\" y=\"{}\" width=\"14\" height=\"10\" fill=\"currentColor\" "
           "fill-opacity=\"{}\"/>",
           x + 2, y - 9, entry.box_opacity);
  }
  if (entry.has_line) {
    append(text_,
           "<path d=\"M{},{}h18\" stroke=\"currentColor\" stroke-width=\"{}\" "
           "stroke-dasharray=\"{}\"/>",
           x, y - 4, entry.stroke.width, entry.stroke.dash);
  }
  if (!entry.symbol.path.empty()) {
    append(text_, "<path {} transform=\"translate({},{})\" d=\"{}\"/>", paint_of(entry.symbol),
           x + 9, y - 4, entry.symbol.path);
  }
  append(text_, "</g><text x=\"{}\" y=\"{}\">{}</text>\n", x + 24, y, escaped(entry.label));
}

void Drawing::words(const std::string& text, const std::string& attributes) {
  append(text_, "<text{}>{}</text>\n", attributes, escaped(text));
}

void Drawing::background(double width, double height) {
  append(text_,
         "<rect class=\"background\" width=\"{:.0f}\" height=\"{:.0f}\" fill=\"#ffffff\"/>\n",
         width, height);
}

std::string Drawing::document(double width, double height, const std::string& title) const {
  return fmt::format(
             "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.0f} {1:.0f}\" "
             "width=\"{0:.0f}\" height=\"{1:.0f}\" role=\"img\" aria-label=\"{2}\" "
             "font-family=\"Helvetica, Arial, 'Liberation Sans', sans-serif\" font-size=\"12\">\n"
             "<title>{2}</title>\n",
             width, height, escaped(title)) +
         text_ + "</svg>\n";
}

}  // namespace results::report
