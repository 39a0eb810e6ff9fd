#include "seedflow/output/svg.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <cstring>

namespace seedflow {

namespace {

struct Entity {
  char character;
  const char* name;
};
constexpr Entity entities[] = {
    {'&', "&amp;"}, {'<', "&lt;"}, {'>', "&gt;"}, {'"', "&quot;"}, {'\'', "&#39;"}};

const char* const superscripts[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};

std::string superscript(const std::string& integer) {
  std::string text;
  for (const char c : integer)
    if (c == '-')
      text += "⁻";
    else if (std::isdigit(static_cast<unsigned char>(c)))
      text += superscripts[c - '0'];
  return text;
}

std::string without_zeros(std::string number) {
  if (number.find('.') == std::string::npos) return number;
  number.erase(number.find_last_not_of('0') + 1);
  if (number.back() == '.') number.pop_back();
  return number;
}

/// With the minus sign of print, which is as wide as a plus.
std::string with_minus(const std::string& number) {
  return number[0] == '-' ? "−" + number.substr(1) : number;
}

/// A coordinate with a hundredth of a pixel.
std::string px(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.2f", value);
  const std::string s = without_zeros(text);
  return s == "-0" ? "0" : s;
}

std::string attribute(const char* name, const std::string& value) {
  return std::string(" ") + name + "=\"" + value + "\"";
}

std::string stroked(const Svg::Stroke& stroke) {
  if (stroke.width <= 0 || stroke.colour == "none") return "";
  return attribute("stroke", stroke.colour) + attribute("stroke-width", px(stroke.width)) +
         (stroke.dash.empty() ? "" : attribute("stroke-dasharray", stroke.dash));
}

std::string points(const std::vector<double>& x, const std::vector<double>& y) {
  std::string text;
  for (std::size_t i = 0; i < x.size(); ++i) text += (i > 0 ? " " : "") + px(x[i]) + "," + px(y[i]);
  return text;
}

}  // namespace

std::string escaped(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    const auto entity = std::find_if(std::begin(entities), std::end(entities),
                                     [c](const Entity& e) { return e.character == c; });
    if (entity != std::end(entities))
      safe += entity->name;
    else if (static_cast<unsigned char>(c) >= 0x20 || c == '\n' || c == '\t')
      safe += c;  // XML 1.0 forbids the other control characters
  }
  return safe;
}

std::string unescaped(const std::string& text) {
  std::string plain;
  for (std::size_t i = 0; i < text.size();) {
    const auto entity = std::find_if(std::begin(entities), std::end(entities), [&](const Entity& e) {
      return text.compare(i, std::strlen(e.name), e.name) == 0;
    });
    plain += entity != std::end(entities) ? entity->character : text[i];
    i += entity != std::end(entities) ? std::strlen(entity->name) : 1;
  }
  return plain;
}

std::string printed_unit(const std::string& unit) {
  std::string text;
  for (std::size_t i = 0; i < unit.size();) {
    const bool after_letter = i > 0 && std::isalpha(static_cast<unsigned char>(unit[i - 1]));
    std::size_t end = i + (unit[i] == '-' ? 1 : 0);
    while (end < unit.size() && std::isdigit(static_cast<unsigned char>(unit[end]))) ++end;
    if (after_letter && end > i && std::isdigit(static_cast<unsigned char>(unit[end - 1]))) {
      text += superscript(unit.substr(i, end - i));
      i = end;
    } else if (unit.compare(i, 4, "degC") == 0) {
      text += "°C";
      i += 4;
    } else if (unit[i] == 'u' && !after_letter && i + 1 < unit.size() && std::strchr("mgsNPW", unit[i + 1])) {
      text += "µ";
      ++i;
    } else {
      text += unit[i++];
    }
  }
  return text;
}

std::string with_unit(const std::string& title, const std::string& unit) {
  return unit.empty() || unit == "1" ? title : title + " [" + printed_unit(unit) + "]";
}

std::string printed_power(double value, int significant_digits) {
  char text[64];
  std::snprintf(text, sizeof text, "%.*e", significant_digits - 1, value);
  const std::string scientific = text;
  const auto e = scientific.find('e');
  const std::string mantissa = without_zeros(scientific.substr(0, e));
  const std::string power = "10" + superscript(std::to_string(std::stoi(scientific.substr(e + 1))));
  return with_minus(mantissa == "1" ? power : mantissa == "-1" ? "-" + power : mantissa + " × " + power);
}

std::string printed_number(double value, int significant_digits) {
  if (std::isnan(value)) return "n/a";
  if (std::isinf(value)) return value > 0 ? "∞" : "−∞";
  if (value == 0) return "0";
  char text[64];
  // The exponent after rounding to the wanted digits: 9.9996 has one digit more before the point.
  std::snprintf(text, sizeof text, "%.*e", significant_digits - 1, value);
  const int exponent = std::stoi(std::strchr(text, 'e') + 1);
  if (exponent < -4 || exponent >= 6) return printed_power(value, significant_digits);
  std::snprintf(text, sizeof text, "%.*f", std::max(0, significant_digits - 1 - exponent), value);
  return with_minus(without_zeros(text));
}

double text_width(const std::string& text, double size) {
  double width = 0;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if ((byte & 0xC0) == 0x80) continue;  // the inner bytes of a UTF-8 character
    if (std::strchr(" iljtfrI.,;:'|!()[]/-", c))
      width += 0.33;
    else if (std::strchr("mwMW@%", c))
      width += 0.92;
    else
      width += std::isupper(byte) ? 0.69 : 0.57;
  }
  return width * size;
}

std::vector<std::string> wrapped(const std::string& text, double width, double size) {
  std::vector<std::string> lines = {""};
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find(' ', begin), text.size());
    const std::string word = text.substr(begin, end - begin);
    begin = end + 1;
    if (word.empty()) continue;
    std::string& line = lines.back();
    if (line.empty())
      line = word;
    else if (text_width(line + " " + word, size) <= width)
      line += " " + word;
    else
      lines.push_back(word);
  }
  return lines;
}

Svg::Svg(double width, double height, const std::string& description)
    : body("<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " + px(width) + " " + px(height) + "\"" +
           attribute("width", px(width)) + attribute("height", px(height)) +
           " role=\"img\" font-family=\"'Segoe UI', Roboto, 'Helvetica Neue', Arial, 'Liberation Sans', "
           "'DejaVu "
           "Sans', sans-serif\"" +
           attribute("aria-label", escaped(description)) + ">\n") {}

Svg::Stroke Svg::no_stroke() {
  return {"none", 0, ""};
}

void Svg::line(double x1, double y1, double x2, double y2, const Stroke& stroke) {
  body += "<line" + attribute("x1", px(x1)) + attribute("y1", px(y1)) + attribute("x2", px(x2)) +
          attribute("y2", px(y2)) + stroked(stroke) + "/>\n";
}

void Svg::polyline(const std::vector<double>& x, const std::vector<double>& y, const Stroke& stroke) {
  body += "<polyline fill=\"none\" stroke-linejoin=\"round\"" + stroked(stroke) +
          attribute("points", points(x, y)) + "/>\n";
}

void Svg::polygon(const std::vector<double>& x, const std::vector<double>& y, const std::string& fill,
                  double opacity, const Stroke& stroke) {
  body += "<polygon" + attribute("fill", fill) + (opacity < 1 ? attribute("fill-opacity", px(opacity)) : "") +
          stroked(stroke) + attribute("points", points(x, y)) + "/>\n";
}

void Svg::rectangle(double x, double y, double width, double height, const std::string& fill,
                    const Stroke& stroke) {
  // Sharp edges: neighbouring cells of a map would show seams.
  body += "<rect shape-rendering=\"crispEdges\"" + attribute("x", px(x)) + attribute("y", px(y)) +
          attribute("width", px(width)) + attribute("height", px(height)) + attribute("fill", fill) +
          stroked(stroke) + "/>\n";
}

void Svg::circle(double x, double y, double radius, const std::string& fill, const Stroke& stroke) {
  body += "<circle" + attribute("cx", px(x)) + attribute("cy", px(y)) + attribute("r", px(radius)) +
          attribute("fill", fill) + stroked(stroke) + "/>\n";
}

void Svg::text(double x, double y, const std::string& words, const Font& font) {
  static const char* const anchors[] = {"start", "middle", "end"};
  body +=
      "<text" + attribute("x", px(x)) + attribute("y", px(y)) + attribute("font-size", px(font.size)) +
      attribute("fill", font.colour) +
      (font.anchor == Anchor::start ? "" : attribute("text-anchor", anchors[static_cast<int>(font.anchor)])) +
      (font.bold ? " font-weight=\"600\"" : "") +
      (font.halo ? " stroke=\"#fff\" stroke-width=\"3\" stroke-linejoin=\"round\" paint-order=\"stroke\""
                 : "") +
      (font.rotation == 0
           ? ""
           : attribute("transform", "rotate(" + px(font.rotation) + " " + px(x) + " " + px(y) + ")")) +
      ">" + escaped(words) + "</text>\n";
}

void Svg::begin_clip(double x, double y, double width, double height) {
  // A nested svg clips without an id, which would have to be unique in the whole page.
  body += "<svg" + attribute("x", px(x)) + attribute("y", px(y)) + attribute("width", px(width)) +
          attribute("height", px(height)) + " overflow=\"hidden\"" +
          attribute("viewBox", px(x) + " " + px(y) + " " + px(width) + " " + px(height)) + ">\n";
}

void Svg::end_clip() {
  body += "</svg>\n";
}

}  // namespace seedflow
