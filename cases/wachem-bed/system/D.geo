// Grid D: 17,994 polyhedra, 1.76 particle diameters

layers = 1;
h = 2.39e-3; // [m]
g = 0.6;
d = 7.5e-4; // [m]

Include "box.geo";

Physical Volume("polyhedra") = {Volume{:}};
