#include "seedflow/output/progress.h"

#include <algorithm>
#include <sstream>

#include "testing.h"

namespace seedflow {
namespace {

struct Watched {
  std::ostringstream text;
  double clock = 0;
  int columns = 0;
  Progress::Sink sink(bool terminal) {
    return {&text, terminal, [this] { return clock; }, [this] { return columns; }};
  }
  int lines() const {
    const std::string all = text.str();
    return static_cast<int>(std::count(all.begin(), all.end(), '\n'));
  }
};

TEST(Progress, TimeLeftIsThatOfAUniformComputation) {
  Watched w;
  Progress progress("Settling", 0.2, 0.0, w.sink(true));
  w.clock = 30;
  progress.update(0.05, "v = 0.1 m/s");
  // A quarter took 30 s, so three quarters take 90 s.
  EXPECT_CONTAINS(w.text.str(), " 25 %  1 min 30 s left  v = 0.1 m/s");
}

TEST(Progress, AfterAResumeOnlyTheWorkDoneHereCounts) {
  Watched w;
  Progress progress("Settling", 1.0, 0.5, w.sink(true));
  w.clock = 10;
  progress.update(0.6);
  EXPECT_CONTAINS(w.text.str(), " 60 %  40 s left");
}

TEST(Progress, OnATerminalOneLineIsRedrawnAFewTimesASecond) {
  Watched w;
  {
    Progress progress("Settling", 1.0, 0.0, w.sink(true));
    for (int i = 1; i <= 1000; ++i) {
      w.clock = 0.001 * i;
      progress.update(0.0005 * i);
    }
    const std::string all = w.text.str();
    EXPECT_EQ(std::count(all.begin(), all.end(), '\r'), 4);
    EXPECT_EQ(w.lines(), 0);
  }
  // An error message that follows stands on its own line.
  EXPECT_EQ(w.text.str().back(), '\n');
}

TEST(Progress, ALineIsCutToTheWidthOfTheTerminal) {
  Watched w;
  w.columns = 20;
  Progress progress("Fläche", 1.0, 0.0, w.sink(true));
  w.clock = 10;
  progress.update(0.5, "a note that does not fit");
  EXPECT_EQ(w.text.str(), "\r\033[KFläche  50 %  10 s ") << "19 characters, one for the cursor";
}

TEST(Progress, ElsewherePlainLinesComeEveryFewSecondsAndThenLessOften) {
  Watched w;
  Progress progress("Settling", 1.0, 0.0, w.sink(false));
  for (int i = 1; i <= 36000; ++i) {
    w.clock = 0.1 * i;
    progress.update(i / 36000.0);
    if (w.clock < 5) {
      EXPECT_EQ(w.lines(), 0);
    }
  }
  EXPECT_GE(w.lines(), 10);
  EXPECT_LE(w.lines(), 25) << "an hour does not fill the log";
  EXPECT_EQ(w.text.str().find('\r'), std::string::npos);
  progress.finish();
  EXPECT_CONTAINS(w.text.str(), "100 %  took 1 h 00 min");
}

TEST(Progress, OtherRanksAreQuiet) {
  ::testing::internal::CaptureStderr();
  {
    Progress progress("Settling", 1.0, 0.0, 1);
    progress.update(0.5);
    progress.finish();
  }
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
}

TEST(Progress, DurationsReadNaturally) {
  EXPECT_EQ(Progress::duration(0.3), "< 1 s");
  EXPECT_EQ(Progress::duration(59.4), "59 s");
  EXPECT_EQ(Progress::duration(200), "3 min 20 s");
  EXPECT_EQ(Progress::duration(7500), "2 h 05 min");
  EXPECT_EQ(Progress::duration(500000), "5 days 18 h");
}

}  // namespace
}  // namespace seedflow
