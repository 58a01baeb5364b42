// Grid C: 25,840 polyhedra, 1.56 particle diameters

layers = 1;
h = 2.07e-3; // [m]
g = 0.6;
d = 7.5e-4; // [m]

Include "box.geo";

Physical Volume("polyhedra") = {Volume{:}};
