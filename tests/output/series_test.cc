#include "seedflow/output/series.h"

#include <cmath>
#include <limits>

#include "seedflow/output/folder.h"
#include "testing.h"

namespace seedflow {
namespace {

const std::vector<Column> columns = {{"time", "s"}, {"velocity z", "m/s"}, {"contacts", "1"}};

TEST(Series, HasNamesAndUnitsInTheHeaderAndIsReadableWhileItGrows) {
  TemporaryFolder folder;
  SeriesWriter writer(folder / "v.csv", columns);
  writer.row({0.1, -0.25, 3});
  EXPECT_EQ(read_file(folder / "v.csv"), "time [s],velocity z [m/s],contacts [1]\n0.1,-0.25,3\n");
}

TEST(Series, ReadsBackEveryBit) {
  TemporaryFolder folder;
  SeriesWriter writer(folder / "v.csv", columns);
  std::vector<std::vector<double>> rows;
  for (int i = 0; i < 100; ++i) {
    rows.push_back({i * 1e-5 / 3, std::sin(i) * std::pow(10.0, i % 40 - 20), std::nextafter(i, 1000)});
    writer.row(rows.back());
  }
  const Series series = read_series(folder / "v.csv");
  ASSERT_EQ(series.n_rows(), 100u);
  EXPECT_EQ(series.columns[1].name, "velocity z");
  EXPECT_EQ(series.columns[1].unit, "m/s");
  for (std::size_t i = 0; i < 100; ++i)
    for (std::size_t c = 0; c < 3; ++c) EXPECT_EQ(series.values[c][i], rows[i][c]);
  EXPECT_EQ(&series["contacts"], &series.values[2]);
  EXPECT_CONTAINS(message_of<InputError>([&] { series["speed"]; }), "'velocity z'");
}

TEST(Series, ResumeGivesTheFileOfARunWithoutInterruption) {
  TemporaryFolder folder;
  const auto row = [](int i) { return std::vector<double>{i * 0.1 / 3, 1.0 / (i + 1), double(i)}; };
  {
    SeriesWriter whole(folder / "whole.csv", columns);
    for (int i = 0; i < 20; ++i) whole.row(row(i));
    SeriesWriter cut(folder / "cut.csv", columns);
    for (int i = 0; i < 15; ++i) cut.row(row(i));
  }
  // Killed while writing a row: a number cut short would even look like an earlier time.
  write_text(folder / "cut.csv", read_file(folder / "cut.csv") + "0.0");
  {
    SeriesWriter resumed(folder / "cut.csv", columns, row(10)[0]);
    for (int i = 11; i < 20; ++i) resumed.row(row(i));
  }
  EXPECT_EQ(read_file(folder / "cut.csv"), read_file(folder / "whole.csv"));
}

TEST(Series, ResumeWithOtherColumnsOrWithoutFileIsBadInput) {
  TemporaryFolder folder;
  { SeriesWriter writer(folder / "v.csv", {{"time", "s"}, {"force", "N"}}); }
  EXPECT_CONTAINS(message_of<InputError>([&] { SeriesWriter(folder / "v.csv", columns, 1.0); }), "force [N]");
  EXPECT_THROW(SeriesWriter(folder / "missing.csv", columns, 1.0), InputError);
}

TEST(Series, NotANumberWrongCountAndFullDiskStopTheRun) {
  TemporaryFolder folder;
  SeriesWriter writer(folder / "v.csv", columns);
  const std::string message = message_of<RunError>([&] {
    writer.row({0.5, std::numeric_limits<double>::quiet_NaN(), 0});
  });
  EXPECT_CONTAINS(message, "velocity z is nan at time 0.5 s");
  EXPECT_CONTAINS(message_of<RunError>([&] { writer.row({1, 2}); }), "2 values for 3 columns");
  // A device that is always full.
  EXPECT_CONTAINS(message_of<RunError>([&] { SeriesWriter("/dev/full", columns); }), "No space left");
  EXPECT_THROW(SeriesWriter(folder / "nowhere/v.csv", columns), RunError);
}

TEST(Series, MalformedFilesAreNamedWithTheirLine) {
  TemporaryFolder folder;
  write_text(folder / "a.csv", "# measured\ntime [s], speed\n0, 1\n1, fast\n");
  const std::string message = message_of<InputError>([&] { read_series(folder / "a.csv"); });
  EXPECT_CONTAINS(message, "line 4");
  EXPECT_CONTAINS(message, "'speed'");
  EXPECT_CONTAINS(message, "'fast'");
  write_text(folder / "b.csv", "time [s],speed [m/s]\n0,1\n1\n");
  EXPECT_CONTAINS(message_of<InputError>([&] { read_series(folder / "b.csv"); }), "line 3");
  write_text(folder / "c.csv", "\n");
  EXPECT_CONTAINS(message_of<InputError>([&] { read_series(folder / "c.csv"); }), "empty");
}

TEST(Series, ForeignFilesMayHaveSpacesCommentsAndDosLineEnds) {
  TemporaryFolder folder;
  write_text(folder / "a.csv", "# source\r\ntime [s] , speed\r\n 0 , +1.5e-3\r\n\r\n1,2\r\n");
  const Series series = read_series(folder / "a.csv");
  EXPECT_EQ(series["speed"], (std::vector<double>{1.5e-3, 2}));
  EXPECT_EQ(series.columns[0].unit, "s");
  EXPECT_EQ(series.columns[1].unit, "1");
  write_series(folder / "b.csv", series);
  EXPECT_EQ(read_file(folder / "b.csv"), "time [s],speed [1]\n0,0.0015\n1,2\n");
}

}  // namespace
}  // namespace seedflow
