// SPDX-License-Identifier: GPL-3.0-or-later
/*---------------------------------------------------------------------------*\
    gimdem, client-server CFD-DEM co-simulation

    This program is free software: you can redistribute it and/or modify it
    under the terms of the GNU General Public License as published by the Free
    Software Foundation, either version 3 of the License, or (at your option)
    any later version. It comes without any warranty; LICENSES/ has the text.
\*---------------------------------------------------------------------------*/

#include "polyMeshArrays.H"
#include "cyclicPolyPatch.H"
#include "emptyPolyPatch.H"
#include "processorCyclicPolyPatch.H"
#include "symmetryPlanePolyPatch.H"
#include "symmetryPolyPatch.H"
#include "wallPolyPatch.H"

using gimdem::coupling::PatchKind;

// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::polyMeshArrays::polyMeshArrays(const polyMesh& mesh)
:
    owner_(mesh.faceOwner().begin(), mesh.faceOwner().end()),
    neighbour_(mesh.faceNeighbour().begin(), mesh.faceNeighbour().end()),
    nCells_(mesh.nCells())
{
    points_.reserve(3*mesh.nPoints());
    for (const point& p : mesh.points())
    {
        points_.insert(points_.end(), {p.x(), p.y(), p.z()});
    }

    faceOffsets_.reserve(mesh.nFaces() + 1);
    faceOffsets_.push_back(0);
    for (const face& f : mesh.faces())
    {
        facePoints_.insert(facePoints_.end(), f.begin(), f.end());
        faceOffsets_.push_back(facePoints_.size());
    }

    for (const polyPatch& patch : mesh.boundaryMesh())
    {
        gimdem::coupling::Patch p;
        p.name = patch.name();
        p.kind = kind(patch);
        p.start_face = patch.start();
        p.face_count = patch.size();
        if (p.kind == PatchKind::processor)
        {
            p.neighbour_rank =
                refCast<const processorPolyPatch>(patch).neighbProcNo();
        }
        patches_.push_back(p);
    }
}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

PatchKind Foam::polyMeshArrays::kind(const polyPatch& patch)
{
    if (isA<wallPolyPatch>(patch))
    {
        return PatchKind::wall;
    }
    if (isA<emptyPolyPatch>(patch))
    {
        return PatchKind::empty;
    }
    if (isA<symmetryPlanePolyPatch>(patch) || isA<symmetryPolyPatch>(patch))
    {
        return PatchKind::symmetry;
    }
    if (isA<cyclicPolyPatch>(patch))
    {
        return PatchKind::cyclic;
    }
    if (isA<processorCyclicPolyPatch>(patch))
    {
        FatalErrorInFunction
            << "patch " << patch.name() << " joins two processors across a"
            << " cyclic patch (particles need both sides of it on one); give"
            << " system/decomposeParDict a constraint preservePatches"
            << exit(FatalError);
    }
    if (isA<processorPolyPatch>(patch))
    {
        return PatchKind::processor;
    }
    if (patch.type() != polyPatch::typeName)
    {
        FatalErrorInFunction
            << "patch " << patch.name() << " is of type " << patch.type()
            << " (particles know patch, wall, symmetryPlane, symmetry, empty"
            << " and cyclic); change its type in constant/polyMesh/boundary"
            << exit(FatalError);
    }

    return PatchKind::open;
}


gimdem::coupling::MeshView Foam::polyMeshArrays::view() const
{
    gimdem::coupling::MeshView v;
    v.points = points_;
    v.face_offsets = faceOffsets_;
    v.face_points = facePoints_;
    v.owner = owner_;
    v.neighbour = neighbour_;
    v.cell_count = nCells_;
    v.patches = patches_;
    return v;
}


// ************************************************************************* //
