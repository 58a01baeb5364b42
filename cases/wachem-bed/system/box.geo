// The bed's box in tetrahedra for gmsh, of the size h inside, (1 + g) h at a wall and yet larger where walls meet,
// changing over the depth d. A polyhedron is what is nearest to one point of the tetrahedra: points of walls get half
// a cell, those of edges a quarter, so they have to be farther from each other. With layers = 2 or more, points lie on
// planes that divide the thickness, and all cells have about one volume

SetFactory("OpenCASCADE");

width = 0.09; // [m]
thickness = 0.008;
height = 0.5;

For layer In {1 : layers}
    Box(layer) = {0, (layer - 1)*thickness/layers, 0, width, thickness/layers, height};
EndFor
If (layers > 1)
    BooleanFragments{ Volume{1 : layers}; Delete; }{}
EndIf

Field[1] = MathEval;
Field[1].F = Sprintf("%g*(1 + %g*(Exp(-x/%g) + Exp((x - %g)/%g)
    + Exp(-y/%g) + Exp((y - %g)/%g) + Exp(-z/%g) + Exp((z - %g)/%g)))",
    h, g, d, width, d, d, thickness, d, d, height, d);
Background Field = 1;
Mesh.MeshSizeFromPoints = 0;
Mesh.MeshSizeExtendFromBoundary = 0;
Mesh.Algorithm3D = 1; // Delaunay

e = 1e-6;
If (layers > 1)
    // The narrow sides in pairs of triangles from plane to plane
    s = (1 + 2*g)*h;
    For side In {0 : 1}
        x = side*width;
        z = side*height;
        For plane In {0 : layers}
            y = plane*thickness/layers;
            up() = Curve In BoundingBox {x - e, y - e, -e, x + e, y + e, height + e};
            along() = Curve In BoundingBox {-e, y - e, z - e, width + e, y + e, z + e};
            Transfinite Curve {up()} = Round(height/s) + 1;
            Transfinite Curve {along()} = Round(width/s) + 1;
        EndFor
        left() = Curve In BoundingBox {-e, -e, z - e, e, thickness + e, z + e};
        right() = Curve In BoundingBox {width - e, -e, z - e, width + e, thickness + e, z + e};
        Transfinite Curve {left(), right()} = 2;
        side_wall() = Surface In BoundingBox {x - e, -e, -e, x + e, thickness + e, height + e};
        end() = Surface In BoundingBox {-e, -e, z - e, width + e, thickness + e, z + e};
        Transfinite Surface {side_wall(), end()} Alternate;
    EndFor
EndIf

inlet() = Surface In BoundingBox {-e, -e, -e, width + e, thickness + e, e};
outlet() = Surface In BoundingBox {-e, -e, height - e, width + e, thickness + e, height + e};
walls() = Abs(CombinedBoundary { Volume{:}; });
walls() -= {inlet(), outlet()};

Physical Surface("inlet") = {inlet()};
Physical Surface("outlet") = {outlet()};
Physical Surface("walls") = {walls()};
