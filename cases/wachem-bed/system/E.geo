// Grid E: 7,160 polyhedra, 2.39 particle diameters

h = 2.8e-3; // [m]
g = 0.72;
d = 1e-3; // [m]

Include "box.geo";

Physical Volume("polyhedra") = {1};
