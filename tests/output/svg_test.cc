#include "seedflow/output/svg.h"

#include "testing.h"
#include "xml.h"

namespace seedflow {
namespace {

TEST(Svg, EscapingIsSafeAndReversible) {
  const std::string nasty = "<a href=\"x\">'R&D'</a> µ";
  EXPECT_EQ(escaped(nasty), "&lt;a href=&quot;x&quot;&gt;&#39;R&amp;D&#39;&lt;/a&gt; µ");
  EXPECT_EQ(unescaped(escaped(nasty)), nasty);
  EXPECT_EQ(escaped(std::string("a\x01z\n")), "az\n") << "control characters are not allowed in XML";
}

TEST(Svg, NumbersReadAsInPrint) {
  EXPECT_EQ(printed_number(0.10184, 4), "0.1018");
  EXPECT_EQ(printed_number(0.1), "0.1");
  EXPECT_EQ(printed_number(9.99996, 4), "10");
  EXPECT_EQ(printed_number(1234.5, 4), "1234");
  EXPECT_EQ(printed_number(123456, 3), "123456");
  EXPECT_EQ(printed_number(-2.5), "−2.5");
  EXPECT_EQ(printed_number(1.5e-7), "1.5 × 10⁻⁷");
  EXPECT_EQ(printed_number(-1e12), "−10¹²");
  EXPECT_EQ(printed_number(0), "0");
  EXPECT_EQ(printed_power(0.002, 1), "2 × 10⁻³");
}

TEST(Svg, UnitsReadAsInPrint) {
  EXPECT_EQ(printed_unit("kg/m3"), "kg/m³");
  EXPECT_EQ(printed_unit("m s-2"), "m s⁻²");
  EXPECT_EQ(printed_unit("Pa s"), "Pa s");
  EXPECT_EQ(printed_unit("um"), "µm");
  EXPECT_EQ(printed_unit("degC"), "°C");
  EXPECT_EQ(printed_unit("1/s"), "1/s");
  EXPECT_EQ(with_unit("velocity", "m/s"), "velocity [m/s]");
  EXPECT_EQ(with_unit("void fraction", "1"), "void fraction");
}

TEST(Svg, WrappingKeepsEveryWordAndTheWidth) {
  const std::string text = "force balance of a sphere with the drag law of Schiller and Naumann";
  const auto lines = wrapped(text, 100, 12);
  std::string joined;
  for (const std::string& line : lines) {
    EXPECT_LE(text_width(line, 12), 100);
    joined += (joined.empty() ? "" : " ") + line;
  }
  EXPECT_EQ(joined, text);
  EXPECT_GT(lines.size(), 3u);
  EXPECT_EQ(wrapped("incompressible", 5, 12).size(), 1u);
  EXPECT_EQ(text_width("µµ", 10), text_width("aa", 10)) << "characters are counted, not bytes";
}

TEST(Svg, DrawingIsWellFormed) {
  Svg svg(100, 50, "a <drawing> & more");
  svg.begin_clip(0, 0, 10, 10);
  svg.polyline({0, 1, 2}, {3, 4, 5.123456}, {"#123456", 2, "3 2"});
  svg.end_clip();
  Svg::Font font;
  font.halo = font.bold = true;
  font.rotation = -90;
  svg.text(1, 2, "a < b & c", font);
  std::string error;
  const auto elements = elements_of(svg.finish(), error);
  EXPECT_EQ(error, "");
  EXPECT_EQ(elements.back().text, "a &lt; b &amp; c");
  EXPECT_EQ(elements[2].attributes.at("points"), "0,3 1,4 2,5.12");
}

TEST(Svg, TheCheckItselfFindsErrors) {
  std::vector<XmlElement> e;
  EXPECT_EQ(read_xml("<a b=\"1\"><c/>&lt;</a>", e), "");
  for (const char* bad :
       {"<a><b></a></b>", "<a>", "<a b=1/>", "<a>R&D</a>", "<a b=\"<\"/>", "<a b=\"1\" b=\"2\"/>", "</a>"})
    EXPECT_NE(read_xml(bad, e), "") << bad;
}

}  // namespace
}  // namespace seedflow
