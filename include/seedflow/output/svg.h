#pragma once

#include <string>
#include <vector>

namespace seedflow {

/// Text made safe for XML and HTML, inside elements and attributes: & < > " ' become entities.
std::string escaped(const std::string& text);
/// The inverse of escaped().
std::string unescaped(const std::string& text);

/// A unit as it is printed: "kg/m3" -> "kg/m³", "m s-1" -> "m s⁻¹", "um" -> "µm", "degC" -> "°C".
std::string printed_unit(const std::string& unit);
/// "velocity [m/s]"; the title alone for the unit "1" or "".
std::string with_unit(const std::string& title, const std::string& unit);

/// A number for labels and tables, with so many significant digits and no trailing zeros: "0.1018", "1.5 ×
/// 10⁻⁷".
std::string printed_number(double value, int significant_digits = 4);

/// The same always with a power of ten: "2 × 10⁻³", "10⁴".
std::string printed_power(double value, int significant_digits = 4);

/// Estimated width of UTF-8 text in a common sans-serif typeface [same unit as size], rather too wide than
/// too narrow.
double text_width(const std::string& text, double size);
/// Breaks at spaces so that no line is wider than `width` (a longer word stands alone).
std::vector<std::string> wrapped(const std::string& text, double width, double size);

/// The few SVG elements plots are made of. Coordinates in px, y downwards.
class Svg {
 public:
  struct Stroke {
    std::string colour = "#333";
    double width = 1;
    std::string dash = "";  ///< SVG stroke-dasharray
  };
  static Stroke no_stroke();
  enum class Anchor { start, middle, end };
  struct Font {
    double size = 13;
    std::string colour = "#1f2328";
    Anchor anchor = Anchor::start;
    bool bold = false;
    bool halo = false;    ///< a white rim, for text on lines
    double rotation = 0;  ///< degrees, about the text's own position
  };

  Svg(double width, double height, const std::string& description);

  void line(double x1, double y1, double x2, double y2, const Stroke& stroke);
  void polyline(const std::vector<double>& x, const std::vector<double>& y, const Stroke& stroke);
  void polygon(const std::vector<double>& x, const std::vector<double>& y, const std::string& fill,
               double opacity, const Stroke& stroke = no_stroke());
  void rectangle(double x, double y, double width, double height, const std::string& fill,
                 const Stroke& stroke = no_stroke());
  void circle(double x, double y, double radius, const std::string& fill, const Stroke& stroke);
  void text(double x, double y, const std::string& words, const Font& font);
  /// Everything until end_clip() is drawn inside the rectangle only.
  void begin_clip(double x, double y, double width, double height);
  void end_clip();

  std::string finish() const { return body + "</svg>\n"; }

 private:
  std::string body;
};

}  // namespace seedflow
