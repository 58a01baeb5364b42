// Grid T: 18,780 tetrahedra, 1.73 particle diameters

h = 4.6e-3; // [m]
g = 0;
d = 1e-3; // [m]

Include "box.geo";
Mesh.Algorithm3D = 10; // HXT: Delaunay has a fifth more or less with this size

Physical Volume("tetrahedra") = {1};
