#include "seedflow/output/json.h"

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "seedflow/output/folder.h"
#include "testing.h"

namespace seedflow {
namespace {

TEST(Json, KeepsOrderTextAndEveryBitOfANumber) {
  TemporaryFolder folder;
  Json json;
  json["zeta"] = 0.1 + 0.2;
  json["alpha"] = {std::nextafter(1.0, 2.0), 5e-324, -1.7976931348623157e308};
  json["words \"quoted\"\n"] = "a\tb \\ µ";
  write_json(folder / "x.json", json);
  const std::string text = read_file(folder / "x.json");
  EXPECT_LT(text.find("zeta"), text.find("alpha"));
  const Json back = read_json(folder / "x.json");
  EXPECT_EQ(back, json);
  EXPECT_EQ(back["zeta"].get<double>(), 0.30000000000000004);
}

TEST(Json, NotANumberIsAnErrorThatSaysWhere) {
  TemporaryFolder folder;
  Json json;
  json["observables"]["velocity"]["value"] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_CONTAINS(message_of<RunError>([&] { write_json(folder / "x.json", json); }),
                  "/observables/velocity/value");
  json["observables"]["velocity"]["value"] = -std::numeric_limits<double>::infinity();
  EXPECT_THROW(write_json(folder / "x.json", json), RunError);
  EXPECT_FALSE(std::filesystem::exists(folder / "x.json"));
}

TEST(Json, MalformedTextIsBadInputWithItsLine) {
  TemporaryFolder folder;
  write_text(folder / "x.json", "{\n  \"a\": 1,\n  \"b\": }\n");
  const std::string message = message_of<InputError>([&] { read_json(folder / "x.json"); });
  EXPECT_CONTAINS(message, "x.json");
  EXPECT_CONTAINS(message, "line 3");
}

}  // namespace
}  // namespace seedflow
