#include "seedflow/output/vtu.h"

#include <cstring>

#include "seedflow/output/folder.h"
#include "seedflow/output/svg.h"
#include "testing.h"
#include "xml.h"

namespace seedflow {
namespace {

/// The numbers of an inline binary array: base64 of the byte count (64 bits) and the bytes. Independent of
/// the writer.
template <class T>
std::vector<T> decoded(const XmlElement& array) {
  std::string bytes;
  unsigned bits = 0;
  int n_bits = 0;
  for (const char c : array.text) {
    unsigned digit = 0;
    if (c >= 'A' && c <= 'Z')
      digit = static_cast<unsigned>(c - 'A');
    else if (c >= 'a' && c <= 'z')
      digit = static_cast<unsigned>(c - 'a') + 26;
    else if (c >= '0' && c <= '9')
      digit = static_cast<unsigned>(c - '0') + 52;
    else if (c == '+')
      digit = 62;
    else if (c == '/')
      digit = 63;
    else
      break;
    bits = bits << 6 | digit;
    n_bits += 6;
    if (n_bits >= 8) bytes += static_cast<char>(bits >> (n_bits -= 8) & 255);
  }
  EXPECT_EQ(array.text.size() % 4, 0u);
  std::uint64_t size = 0;
  std::memcpy(&size, bytes.data(), 8);
  EXPECT_EQ(size, bytes.size() - 8);
  std::vector<T> values(size / sizeof(T));
  if (size > 0) std::memcpy(values.data(), bytes.data() + 8, size);
  return values;
}

std::vector<XmlElement> read_file_elements(const std::filesystem::path& file) {
  std::string error;
  auto elements = elements_of(read_file(file), error);
  EXPECT_EQ(error, "");
  return elements;
}

const XmlElement& array(const std::vector<XmlElement>& elements, const std::string& name) {
  for (const XmlElement& e : elements)
    if (e.name == "DataArray" && e.attributes.at("Name") == name) return e;
  throw RunError("no array " + name);
}

TEST(Vtu, PointsHoldTheirData) {
  TemporaryFolder folder;
  PointCloud cloud({{0, 0, 0}, {0.001, 0.002, -0.003}, {1, 2, 3}, {4, 5, 6}});
  cloud.add("radius", std::vector<double>{1e-4, 2e-4, 3e-4, 4e-4});
  cloud.add("velocity <lab>", std::vector<Vec3>{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {7, 8, 9}});
  cloud.add("seed", std::vector<std::int64_t>{0, 0, 1, 5000000000});
  cloud.write(folder / "seeds.vtu");
  const auto elements = read_file_elements(folder / "seeds.vtu");
  EXPECT_EQ(elements[0].attributes.at("type"), "UnstructuredGrid");
  EXPECT_EQ(elements[2].attributes.at("NumberOfPoints"), "4");
  EXPECT_EQ(decoded<float>(array(elements, "Points")),
            (std::vector<float>{0, 0, 0, 0.001f, 0.002f, -0.003f, 1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(decoded<float>(array(elements, "radius")), (std::vector<float>{1e-4f, 2e-4f, 3e-4f, 4e-4f}));
  EXPECT_EQ(array(elements, "velocity &lt;lab&gt;").attributes.at("NumberOfComponents"), "3");
  EXPECT_EQ(decoded<float>(array(elements, "velocity &lt;lab&gt;"))[9], 7);
  EXPECT_EQ(decoded<std::int64_t>(array(elements, "seed")), (std::vector<std::int64_t>{0, 0, 1, 5000000000}));
  EXPECT_EQ(decoded<std::int64_t>(array(elements, "offsets")), (std::vector<std::int64_t>{1, 2, 3, 4}));
  EXPECT_EQ(decoded<std::uint8_t>(array(elements, "types")), (std::vector<std::uint8_t>{1, 1, 1, 1}));
}

TEST(Vtu, ARankWithoutSeedsWritesAValidFile) {
  TemporaryFolder folder;
  PointCloud cloud({});
  cloud.add("radius", std::vector<double>{});
  cloud.write(folder / "empty.vtu");
  const auto elements = read_file_elements(folder / "empty.vtu");
  EXPECT_TRUE(decoded<float>(array(elements, "radius")).empty());
}

TEST(Vtu, WrongLengthsAndNamesTwiceAreErrors) {
  PointCloud cloud({{0, 0, 0}, {1, 1, 1}});
  EXPECT_CONTAINS(message_of<RunError>([&] { cloud.add("radius", std::vector<double>{1}); }), "'radius'");
  cloud.add("radius", std::vector<double>{1, 2});
  EXPECT_CONTAINS(message_of<RunError>([&] { cloud.add("radius", std::vector<double>{1, 2}); }), "twice");
  EXPECT_THROW(Polygons({{0, 0, 0}}, {{0, 1, 2}}), RunError);
}

TEST(Vtu, PolygonsShareVertices) {
  TemporaryFolder folder;
  Polygons walls({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, 0, 1}}, {{0, 1, 2, 3}, {0, 1, 4}});
  walls.add("wall", std::vector<std::int64_t>{7, 8});
  walls.write(folder / "walls.vtp");
  const auto elements = read_file_elements(folder / "walls.vtp");
  EXPECT_EQ(elements[2].attributes.at("NumberOfPolys"), "2");
  EXPECT_EQ(decoded<std::int64_t>(array(elements, "connectivity")),
            (std::vector<std::int64_t>{0, 1, 2, 3, 0, 1, 4}));
  EXPECT_EQ(decoded<std::int64_t>(array(elements, "offsets")), (std::vector<std::int64_t>{4, 7}));
}

TEST(Pvd, ResumeGivesTheFileOfARunWithoutInterruption) {
  TemporaryFolder folder;
  PvdSeries whole(folder / "whole.pvd");
  const auto add = [](PvdSeries& series, int i) {
    const std::string name = "air & seeds_" + std::to_string(i);
    series.add_parts(i * 0.1 / 3, {name + ".0.vtu", name + ".1.vtu"});
  };
  for (int i = 0; i < 12; ++i) add(whole, i);
  {
    PvdSeries cut(folder / "cut.pvd");
    for (int i = 0; i < 9; ++i) add(cut, i);
  }
  PvdSeries resumed(folder / "cut.pvd", 6 * 0.1 / 3);
  EXPECT_EQ(resumed.n_times(), 7);
  for (int i = 7; i < 12; ++i) add(resumed, i);
  EXPECT_EQ(read_file(folder / "cut.pvd"), read_file(folder / "whole.pvd"));
  const auto elements = read_file_elements(folder / "whole.pvd");
  EXPECT_EQ(elements.size(), 2u + 24u);
  EXPECT_EQ(unescaped(elements[3].attributes.at("file")), "air & seeds_0.1.vtu");
  EXPECT_EQ(elements[3].attributes.at("part"), "1");
}

TEST(Pvd, AnIncompleteOrMissingListCannotBeContinued) {
  TemporaryFolder folder;
  EXPECT_THROW(PvdSeries(folder / "none.pvd", 1.0), InputError);
  write_text(folder / "half.pvd", "<VTKFile><Collection>");
  EXPECT_CONTAINS(message_of<InputError>([&] { PvdSeries(folder / "half.pvd", 1.0); }), "half.pvd");
}

}  // namespace
}  // namespace seedflow
