// Grid T: 17,991 tetrahedra, 1.76 particle diameters

layers = 2;
h = 6.15e-3; // [m]
g = 0;
d = 1e-3; // [m]

Include "box.geo";

Physical Volume("tetrahedra") = {Volume{:}};
