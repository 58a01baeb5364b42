// Grid E: 7,325 polyhedra, 2.37 particle diameters

layers = 2;
h = 3.84e-3; // [m]
g = 0.4;
d = 1e-3; // [m]

Include "box.geo";

Physical Volume("polyhedra") = {Volume{:}};
