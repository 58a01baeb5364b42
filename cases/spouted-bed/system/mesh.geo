// A cone of 60 degrees under a tube, of polyhedra. Tetrahedra have the size h at the inlet, are larger at walls, whose
// points get half a cell, and grow above the bed

SetFactory("OpenCASCADE");

inlet_radius = 0.0075; // [m]
radius = 0.03;
height = 0.2;
cone = (radius - inlet_radius)/Tan(30*Pi/180); // its height
h = 3.5e-3;

Cone(1) = {0, 0, 0, 0, 0, cone, inlet_radius, radius};
Cylinder(2) = {0, 0, cone, 0, 0, height - cone, radius};
BooleanUnion{ Volume{1}; Delete; }{ Volume{2}; Delete; }

// Distance from the cone's wall is half the way up to it: sin 30 degrees
Field[1] = MathEval;
Field[1].F = Sprintf("%g*(1 + 0.4*(Exp((Sqrt(x*x + y*y) - %g)/0.001) + Exp((Sqrt(x*x + y*y)*1.732 - z - %g)/0.002)
    + Exp(-z/0.001) + Exp((z - %g)/0.001)) + 0.5*(1 + Tanh((z - 0.08)/0.02)))",
    h, radius, inlet_radius*Sqrt(3), height);
Background Field = 1;
Mesh.MeshSizeFromPoints = 0;
Mesh.MeshSizeExtendFromBoundary = 0;

e = 1e-6;
r = radius + e;
inlet() = Surface In BoundingBox {-r, -r, -e, r, r, e};
outlet() = Surface In BoundingBox {-r, -r, height - e, r, r, height + e};
walls_of_tube() = Surface{:};
walls_of_cone() = Surface In BoundingBox {-r, -r, -e, r, r, cone + e};
walls_of_cone() -= inlet();
walls_of_tube() -= {inlet(), outlet(), walls_of_cone()};

// Two patches, so that the edge between them stays where it is
Physical Surface("inlet") = {inlet()};
Physical Surface("outlet") = {outlet()};
Physical Surface("walls_of_cone") = {walls_of_cone()};
Physical Surface("walls_of_tube") = {walls_of_tube()};
Physical Volume("polyhedra") = {Volume{:}};
