// Grid T: 18,095 tetrahedra, 1.75 particle diameters

layers = 2;
h = 5.62e-3; // [m]
g = 0.1;
d = 1e-3; // [m]

Include "box.geo";

Physical Volume("tetrahedra") = {Volume{:}};
