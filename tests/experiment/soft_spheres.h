#pragma once

namespace seedflow {

/// 4 mm spheres with a shear modulus of 1.5e5 Pa: overlaps of a few per cent, steps of 5e-5 s.
inline const char* const soft_spheres = R"(
subsection Seeds
  set Sub-spheres = 1
end
subsection Materials
  set Shear modulus factor = 0.001
end
subsection Seeds motion
  set Time step = 4e-5 s
end
)";

/// Rough enough for a few spheres to form a heap.
inline const char* const rough_contacts = R"(
subsection Contact pairs
  subsection seed - seed
    set Rolling friction = 0.3
    set Static friction  = 0.6
  end
  subsection seed - photosensitive resin
    set Rolling friction = 0.3
    set Static friction  = 0.6
  end
end
)";

}  // namespace seedflow
