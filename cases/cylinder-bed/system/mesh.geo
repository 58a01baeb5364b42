// A tube of polyhedra: tetrahedra have the size h inside, and are larger at walls, whose points get half a cell

SetFactory("OpenCASCADE");

radius = 0.015; // [m]
height = 0.15;
h = 3.4e-3;
d = 1e-3; // depth of what a wall changes

Cylinder(1) = {0, 0, 0, 0, 0, height, radius};

Field[1] = MathEval;
Field[1].F = Sprintf("%g*(1 + 0.4*(Exp((Sqrt(x*x + y*y) - %g)/%g) + Exp(-z/%g) + Exp((z - %g)/%g)))",
    h, radius, d, d, height, d);
Background Field = 1;
Mesh.MeshSizeFromPoints = 0;
Mesh.MeshSizeExtendFromBoundary = 0;

e = 1e-6;
inlet() = Surface In BoundingBox {-radius - e, -radius - e, -e, radius + e, radius + e, e};
outlet() = Surface In BoundingBox {-radius - e, -radius - e, height - e, radius + e, radius + e, height + e};
walls() = Surface{:};
walls() -= {inlet(), outlet()};

Physical Surface("inlet") = {inlet()};
Physical Surface("outlet") = {outlet()};
Physical Surface("walls") = {walls()};
Physical Volume("polyhedra") = {1};
