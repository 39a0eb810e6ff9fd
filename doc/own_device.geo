// The air of the metering device of prm/metering_sector.prm as a start for your own, for Gmsh 4 (doc/own_device.md):
//   gmsh -3 doc/own_device.geo -o own.msh
// Lengths in mm. The disc's front is z = 0, its back z = thickness; sharp-edged holes.
places = 60; drilled = 12; first = -165 * Pi / 180;
pitch = 90; hole = 1; thickness = 2;                    // radii of the holes' circle and of a hole
inner = 50; outer = 96; depth = 10;                     // seed chamber
from = -130 * Pi / 180; to = Pi;                        // vacuum chamber: its arc,
vacuum_inner = 82; vacuum_outer = 98; vacuum_depth = 15;

Mesh.RecombineAll = 1;
Mesh.RecombinationAlgorithm = 2;                        // quadrilaterals only; halves the sizes
Mesh.MeshSizeExtendFromBoundary = 1;
fine = 0.8; coarse = 12;                              // 0.8: holes of 16 sides; 0.35: of 24

// A circle of four arcs in the plane z = 0.
Macro Circle4
  middle = newp; Point(middle) = {x, y, 0};
  p = newp;
  For q In {0:3}
    Point(p + q) = {x + r * Cos(turn + q * Pi / 2), y + r * Sin(turn + q * Pi / 2), 0, size};
  EndFor
  c = newc;
  For q In {0:3}
    Circle(c + q) = {p + q, middle, p + (q + 1) % 4};
  EndFor
  loop = newll; Curve Loop(loop) = {c:c+3};
Return

// Turning: the seed chamber with the holes.
x = 0; y = 0; turn = 0; size = coarse;
r = outer;
Call Circle4;
loops[] = {loop};
r = inner;
Call Circle4;
loops[] += {loop};
size = fine; r = hole;
For k In {0:drilled-1}
  turn = first + k * 2 * Pi / places;
  x = pitch * Cos(turn); y = pitch * Sin(turn);

  Call Circle4;
  loops[] += {loop};
  mouth = news; Plane Surface(mouth) = {loop}; mouths[] += {mouth};
EndFor
disc = news; Plane Surface(disc) = {loops[]};
layers[] = {1, 1, 1, 1, 2, 2}; ends[] = {0.03, 0.08, 0.16, 0.3, 0.6, 1};
a[] = Extrude {0, 0, -depth} { Surface{disc}; Layers{layers[], ends[]}; Recombine; };
ambient[] = {a[0]}; turning[] = {a[1]}; housing[] = {a[{2:9}]};
For k In {0:drilled-1}
  a[] = Extrude {0, 0, -depth} { Surface{mouths[k]}; Layers{layers[], ends[]}; Recombine; };
  ambient[] += {a[0]}; turning[] += {a[1]};
  b[] = Extrude {0, 0, thickness} { Surface{mouths[k]}; Layers{4}; Recombine; };
  hole_ends[] += {b[0]}; turning[] += {b[1]}; holes[] += {b[{2:5}]};
EndFor

// Standing: the vacuum chamber, with points of its own in the plane of the disc's back.
n = 4; middle = newp; Point(middle) = {0, 0, thickness};
p = newp;
For i In {0:n}
  angle = from + (to - from) * i / n;
  Point(p + 2 * i) = {vacuum_inner * Cos(angle), vacuum_inner * Sin(angle), thickness};
  Point(p + 2 * i + 1) = {vacuum_outer * Cos(angle), vacuum_outer * Sin(angle), thickness};
EndFor
ray = newc;
For i In {0:n}
  Line(ray + i) = {p + 2 * i, p + 2 * i + 1};
EndFor
Transfinite Curve {ray:ray+n} = 9;
arc = newc;
For i In {0:n-1}
  Circle(arc + 2 * i) = {p + 2 * i, middle, p + 2 * i + 2};
  Circle(arc + 2 * i + 1) = {p + 2 * i + 1, middle, p + 2 * i + 3};
EndFor
Transfinite Curve {arc:arc+2*n-1} = 61;
For i In {0:n-1}
  loop = newll; Curve Loop(loop) = {ray + i, arc + 2 * i + 1, -(ray + i + 1), -(arc + 2 * i)};
  face = news; Plane Surface(face) = {loop};
  Transfinite Surface {face};
  a[] = Extrude {0, 0, vacuum_depth} { Surface{face}; Layers{{1, 2, 2}, {0.13, 0.4, 1}}; Recombine; };
  vacuum_face[] += {face}; suction[] += {a[0]}; standing[] += {a[1]};
  vacuum_wall[] += {a[3], a[5]};
  If (i == 0)
    vacuum_wall[] += {a[2]};
  EndIf
  If (i == n - 1)
    vacuum_wall[] += {a[4]};
  EndIf
EndFor

Physical Volume("turning") = {turning[]};
Physical Volume("standing") = {standing[]};
Physical Surface("ambient") = {ambient[]};
Physical Surface("housing") = {housing[]};
Physical Surface("disc") = {disc};
Physical Surface("hole") = {holes[]};
Physical Surface("hole end") = {hole_ends[]};
Physical Surface("vacuum face") = {vacuum_face[]};
Physical Surface("suction") = {suction[]};
Physical Surface("vacuum wall") = {vacuum_wall[]};
