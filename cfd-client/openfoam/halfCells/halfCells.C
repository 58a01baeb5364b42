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

template<class Type, class FaceValue>
Foam::tmp<Foam::Field<Type>> Foam::halfCells::sum
(
    const FaceValue& value
) const
{
    auto tresult = tmp<Field<Type>>::New(mesh_.nCells(), Zero);
    Field<Type>& result = tresult.ref();

    const labelUList& own = mesh_.owner();
    const labelUList& nei = mesh_.neighbour();

    forAll(nei, facei)
    {
        const Type v(value(-1, facei));

        result[own[facei]] += v;
        result[nei[facei]] += v;
    }

    forAll(mesh_.boundary(), patchi)
    {
        const labelUList& faceCells = mesh_.boundary()[patchi].faceCells();

        // An empty patch has cells but no values
        for (label i = 0; i < mesh_.boundary()[patchi].size(); ++i)
        {
            result[faceCells[i]] += value(patchi, i);
        }
    }

    return tresult;
}


Foam::tmp<Foam::tensorField> Foam::halfCells::sumSfSf
(
    const surfaceScalarField& C
) const
{
    return sum<tensor>
    (
        [&](const label patchi, const label i)
        {
            return patchi < 0
              ? C[i]*SfHat_[i]*mesh_.Sf()[i]
              : C.boundaryField()[patchi][i]
               *SfHat_.boundaryField()[patchi][i]
               *mesh_.Sf().boundaryField()[patchi][i];
        }
    );
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::halfCells::halfCells(const fvMesh& mesh)
:
    mesh_(mesh),
    weights_("halfCellWeights", scalar(1) - mesh.weights()),
    SfHat_("SfHat", mesh.Sf()/mesh.magSf()),
    invSfSf_()
{
    surfaceScalarField one(mesh.magSf()/mesh.magSf());
    invSfSf_ = inv(sumSfSf(one)());
}


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
    return invSfSf_ & sum<vector>
    (
        [&](const label patchi, const label i)
        {
            return patchi < 0
              ? SfHat_[i]*flux[i]
              : SfHat_.boundaryField()[patchi][i]
               *flux.boundaryField()[patchi][i];
        }
    );
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
    return invSfSf_ & sumSfSf(C);
}


// ************************************************************************* //
