#pragma once

#include "tiny_run.h"

namespace seedflow {

namespace fs = std::filesystem;

/// A metering device with a few soft spheres and four holes: seconds of computing.
inline const char* const tiny_device = R"(
set Experiment = metering
subsection Run
  set End time = 1.05 s
  set Series interval = 5 ms
  set Field interval = 0
end
subsection Seeds
  set Sub-spheres = 1
end
subsection Materials
  set Shear modulus factor = 0.001
end
subsection Seeds motion
  set Gravity = 0, -9.81, 0
  set Time step = 4e-5 s
end
subsection Filling
  set Mass = 2.7 g
end
subsection Device
  set Drilled = 4
  set First angle = -112 deg
  set Chamber depth = 6.5 mm
  set Chamber outer radius = 96 mm
end
subsection Metering
  set Speed = 60 rpm
  set Chamber from = -112 deg
  set Pictures at = 0.3
end
)";

// Cells of half a hole: enough to see it work.
inline const std::vector<std::string> computed_air = {"Air/Model=resolved",
                                                      "Air/Step=1 ms",
                                                      "Device mesh/Hole sides=2",
                                                      "Device mesh/Hole rings=1",
                                                      "Device mesh/Mouth rings=2",
                                                      "Device mesh/Hole layers=2",
                                                      "Device mesh/Face cell=0.6 mm",
                                                      "Device mesh/Vacuum cell=4 mm",
                                                      "Device mesh/Largest cell=15 mm",
                                                      "Device mesh/Growth=2"};

class MeteringRuns : public TinyRun {
 protected:
  void SetUp() override {
    TinyRun::SetUp();
    write("device.prm", tiny_device);
  }
  std::vector<std::string> with(const std::vector<std::string>& set = {}, const std::string& name = "out",
                                const std::vector<std::string>& more = {}) const {
    std::vector<std::string> all = arguments(set, name, more);
    all[0] = (folder / "device.prm").string();
    return all;
  }
  std::vector<std::string> with_computed_air(const std::vector<std::string>& set,
                                             const std::string& name = "out",
                                             const std::vector<std::string>& more = {}) const {
    std::vector<std::string> all = computed_air;
    all.insert(all.end(), set.begin(), set.end());
    return with(all, name, more);
  }
  void refused(const std::vector<std::string>& set, const std::string& message) {
    const RunOutcome result = run_here(with(set));
    EXPECT_EQ(result.status, exit_bad_input) << message;
    expect_contains(result.message, message);
    EXPECT_FALSE(fs::exists(out() / "summary.json"));
  }
};

}  // namespace seedflow
