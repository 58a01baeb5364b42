// Grid E: 7,219 polyhedra, 2.38 particle diameters

layers = 2;
h = 3.84e-3; // [m]
g = 0.4;
d = 1e-3; // [m]

Include "box.geo";

Physical Volume("polyhedra") = {Volume{:}};
