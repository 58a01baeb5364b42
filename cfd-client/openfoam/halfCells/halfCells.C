// SPDX-License-Identifier: GPL-3.0-or-later
/*---------------------------------------------------------------------------*\
    gimdem, client-server CFD-DEM co-simulation

    This program is free software: you can redistribute it and/or modify it
    under the terms of the GNU General Public License as published by the Free
    Software Foundation, either version 3 of the License, or (at your option)
    any later version. It comes without any warranty; LICENSES/ has the text.
\*---------------------------------------------------------------------------*/

#include "halfCells.H"
#include "surfaceInterpolationScheme.H"

// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

template<class Type>
Foam::tmp<Foam::Field<Type>> Foam::halfCells::sum
(
    const GeometricField<Type, fvsPatchField, surfaceMesh>& sf
) const
{
    auto tresult = tmp<Field<Type>>::New(mesh_.nCells(), Zero);
    Field<Type>& result = tresult.ref();

    const labelUList& own = mesh_.owner();
    const labelUList& nei = mesh_.neighbour();

    forAll(nei, facei)
    {
        result[own[facei]] += sf[facei];
        result[nei[facei]] += sf[facei];
    }

    forAll(sf.boundaryField(), patchi)
    {
        const labelUList& faceCells = mesh_.boundary()[patchi].faceCells();
        const Field<Type>& psf = sf.boundaryField()[patchi];

        forAll(psf, i)
        {
            result[faceCells[i]] += psf[i];
        }
    }

    return tresult;
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::halfCells::halfCells(const fvMesh& mesh)
:
    mesh_(mesh),
    weights_("halfCellWeights", scalar(1) - mesh.weights()),
    SfHat_("SfHat", mesh.Sf()/mesh.magSf()),
    invSfSf_(inv(sum<tensor>(mesh.Sf()*SfHat_)()))
{}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::tmp<Foam::surfaceScalarField> Foam::halfCells::mean
(
    const volScalarField& vf
) const
{
    return surfaceInterpolationScheme<scalar>::interpolate(vf, weights_);
}


Foam::tmp<Foam::surfaceScalarField> Foam::halfCells::flux
(
    const volVectorField& vf
) const
{
    return surfaceInterpolationScheme<vector>::dotInterpolate
    (
        mesh_.Sf(),
        vf,
        weights_
    );
}


Foam::tmp<Foam::vectorField> Foam::halfCells::reconstruct
(
    const surfaceScalarField& flux
) const
{
    return invSfSf_ & sum<vector>(SfHat_*flux);
}


Foam::tmp<Foam::volVectorField> Foam::halfCells::reconstruct
(
    const word& name,
    const surfaceScalarField& flux
) const
{
    auto tresult = tmp<volVectorField>::New
    (
        IOobject(name, mesh_.time().timeName(), mesh_),
        mesh_,
        dimensionedVector(flux.dimensions()/dimArea, Zero)
    );
    tresult.ref().primitiveFieldRef() = reconstruct(flux);
    tresult.ref().correctBoundaryConditions();

    return tresult;
}


Foam::tmp<Foam::tensorField> Foam::halfCells::share
(
    const surfaceScalarField& C
) const
{
    return invSfSf_ & sum<tensor>(C*SfHat_*mesh_.Sf());
}


// ************************************************************************* //
