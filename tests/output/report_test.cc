#include "seedflow/output/report.h"

#include "demo_report.h"
#include "seedflow/output/folder.h"
#include "testing.h"
#include "xml.h"

namespace seedflow {
namespace {

TEST(Report, IsOneWellFormedPageThatLoadsNothing) {
  TemporaryFolder folder;
  demo_report().write(folder / "report.html");
  const std::string html = read_file(folder / "report.html");
  std::string error;
  const auto elements = elements_of(html, error);
  EXPECT_EQ(error, "");
  for (const XmlElement& e : elements) {
    for (const char* loads : {"script", "link", "img", "iframe", "object", "image", "use"})
      EXPECT_NE(e.name, loads);
    EXPECT_EQ(e.attributes.count("src") + e.attributes.count("href") + e.attributes.count("id"), 0u);
  }
  EXPECT_EQ(html.find("@import"), std::string::npos);
  EXPECT_EQ(html.find("url("), std::string::npos);
}

TEST(Report, SaysTheVerdictBeforeEverythingElseAndTheCommandAtTheEnd) {
  Report report("Title", "./seedflow prm/a.prm --set \"A/B=1\"", "version 1 & more");
  report.heading("Details");
  report.paragraph("Text.");
  report.verdict(Report::Verdict::agrees, "It agrees.");
  report.lead("Lead.");
  const std::string html = report.html();
  const auto at = [&](const std::string& part) {
    EXPECT_CONTAINS(html, part);
    return html.find(part);
  };
  EXPECT_LT(at("<h1>Title</h1>"), at("Lead."));
  EXPECT_LT(at("Lead."), at("It agrees."));
  EXPECT_LT(at("It agrees."), at("Details"));
  EXPECT_LT(at("Text."), at("<code>./seedflow prm/a.prm --set &quot;A/B=1&quot;</code>"));
  at("version 1 &amp; more");
}

TEST(Report, TextIsEscapedAndMarked) {
  Report report("a < b", "", "");
  report.paragraph("`x<y` and **b&b**, 3 ** 4, a lone ` mark, 4 mm long");
  const std::string html = report.html();
  EXPECT_CONTAINS(html, "<code>x&lt;y</code> and <strong>b&amp;b</strong>, 3");
  EXPECT_CONTAINS(html, "** 4, a lone ` mark, 4\u00a0mm long");
  EXPECT_CONTAINS(html, "<title>a &lt; b</title>");
}

TEST(Report, TablesSetNumbersFlushRight) {
  Report report("", "", "");
  Table table{"Values", {"name", "v [m/s]", "error"}};
  table.rows = {{"36", Table::number(0.10184), "−1.2 × 10⁻⁷"}, {"b", Table::number(nan("")), "3 %"}};
  report.add(table);
  const std::string html = report.html();
  EXPECT_CONTAINS(html, "<th>name</th><th class=\"n\">v [m/s]</th><th class=\"n\">error</th>");
  EXPECT_CONTAINS(html, "<td>36</td><td class=\"n\">0.1018</td><td class=\"n\">−1.2\u00a0× 10⁻⁷</td>");
  EXPECT_CONTAINS(html, "<td class=\"n\">–</td>");
  table.rows.push_back({"too", "short"});
  EXPECT_CONTAINS(message_of<RunError>([&] { report.add(table); }), "2 cells for 3 columns");
}

}  // namespace
}  // namespace seedflow
