#!/usr/bin/env python3
"""start.py DIAMETER REPEAT FILE: spheres on a shaken lattice in the drum, solid share 0.20 of its volume."""
import math, random, sys
d, repeat, name = float(sys.argv[1]), int(sys.argv[2]), sys.argv[3]
R, L, share, density = 0.030, 0.016, 0.20, 1300.0
random.seed(1000 * repeat + round(d * 1e6))
n = round(share * math.pi * R * R * L / (math.pi / 6 * d ** 3))
nz = int((L - 0.04 * d) / (1.03 * d)); hz = L / nz; h = 1.05 * d
sites = []
m = int(R / h) + 1
for k in range(nz):
    for i in range(-m, m + 1):
        for j in range(-m, m + 1):
            x, y = (i + 0.5) * h, (j + 0.5) * h
            if math.hypot(x, y) < R - 0.53 * d: sites.append((y, x, (k + 0.5) * hz))
assert len(sites) >= n, (len(sites), n)
sites.sort(); sites = sites[:n]
s = lambda: random.uniform(-0.012, 0.012) * d
with open(name, "w") as f:
    f.write("spheres\n\n%d atoms\n1 atom types\n-0.032 0.032 xlo xhi\n-0.032 0.032 ylo yhi\n-0.001 0.017 zlo zhi\n\nAtoms\n\n" % n)
    for i, (y, x, z) in enumerate(sites): f.write("%d 1 %g %g %.7g %.7g %.7g\n" % (i + 1, d, density, x + s(), y + s(), z + s()))
