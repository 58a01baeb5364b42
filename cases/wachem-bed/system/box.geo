// The bed's box, 0.09 x 0.008 x 0.5 m, filled with tetrahedra for gmsh. Their size is h inside, (1 + g) h at a wall and
// yet larger where walls meet, and changes over the depth d: a cell of polyhedra is what is nearest to one point
// of the tetrahedra, so the points of walls get half a cell, those of edges a quarter

SetFactory("OpenCASCADE");

Box(1) = {0, 0, 0, 0.09, 0.008, 0.5};

Field[1] = MathEval;
Field[1].F = Sprintf("%g*(1 + %g*(Exp(-x/%g) + Exp((x - 0.09)/%g)
    + Exp(-y/%g) + Exp((y - 0.008)/%g) + Exp(-z/%g) + Exp((z - 0.5)/%g)))", h, g, d, d, d, d, d, d);
Background Field = 1;
Mesh.MeshSizeFromPoints = 0;
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.Algorithm3D = 1; // Delaunay

Physical Surface("inlet") = {5};
Physical Surface("outlet") = {6};
Physical Surface("walls") = {1:4};
