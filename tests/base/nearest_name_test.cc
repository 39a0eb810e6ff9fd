#include "seedflow/base/nearest_name.h"

#include <gtest/gtest.h>

namespace seedflow {
namespace {

TEST(NearestName, Distance) {
  EXPECT_EQ(edit_distance("", "abc"), 3);
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3);  // the textbook example of Levenshtein's distance
  EXPECT_EQ(edit_distance("Seeds", "Sedes"), 1);     // neighbours swapped
  EXPECT_EQ(edit_distance("DRAG", "drag"), 0);
  EXPECT_EQ(edit_distance("ca", "abc"), 3);  // where optimal string alignment differs from full Damerau (2)
}

TEST(NearestName, FindsWhatWasMeant) {
  const std::vector<std::string> names = {"Diameter", "Density", "Number of seeds"};
  EXPECT_EQ(nearest_name("Diametr", names), "Diameter");
  EXPECT_EQ(nearest_name("density", names), "Density");
  EXPECT_EQ(nearest_name("Number of seed", names), "Number of seeds");
  EXPECT_EQ(nearest_name("Viscosity", names), "");
  EXPECT_EQ(nearest_name("x", {"y"}), "");  // nothing in common
  EXPECT_EQ(nearest_name("x", {}), "");
}

TEST(NearestName, SuggestionNamesTheNearestOrAll) {
  EXPECT_EQ(suggestion("Diametr", {"Diameter", "Density"}, "entry"), "Nearest valid entry: \"Diameter\".");
  EXPECT_EQ(suggestion("Mass", {"Diameter", "Density"}, "entry"),
            "Valid entries: \"Diameter\", \"Density\".");
  EXPECT_EQ(suggestion("Mass", {}, "section"), "There are no valid sections here.");
}

}  // namespace
}  // namespace seedflow
