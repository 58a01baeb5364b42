// SPDX-License-Identifier: GPL-3.0-or-later
/*---------------------------------------------------------------------------*\
    gimdem, client-server CFD-DEM co-simulation

    This program is free software: you can redistribute it and/or modify it
    under the terms of the GNU General Public License as published by the Free
    Software Foundation, either version 3 of the License, or (at your option)
    any later version. It comes without any warranty; LICENSES/ has the text.
\*---------------------------------------------------------------------------*/

#include "couplingClient.H"
#include "polyMeshArrays.H"
#include "fluidCheckpoint.H"
#include "fvc.H"
#include "StringStream.H"
#include "Pstream.H"

#include <random>

using namespace gimdem::coupling;

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

//- The components of a field, one after the other
template<class Type>
static Span<double const> components(const Field<Type>& f)
{
    static_assert(std::is_same<scalar, double>::value, "needs WM_DP");

    return
    {
        reinterpret_cast<double const*>(f.cdata()),
        std::size_t(f.size())*pTraits<Type>::nComponents
    };
}

//- Which processor this is, of a run whose number the master draws
static Rank thisRank()
{
    Rank rank;

    if (Pstream::parRun())
    {
        string run;
        if (Pstream::master())
        {
            std::random_device random;
            run = std::to_string
            (
                (std::uint64_t(random()) << 32 | random()) | 1
            );
        }
        Pstream::scatter(run);

        rank.number = Pstream::myProcNo();
        rank.count = Pstream::nProcs();
        rank.run = std::stoull(run);
    }

    return rank;
}

} // End namespace Foam


// * * * * * * * * * * * * * Private Member Functions  * * * * * * * * * * * //

ClientOptions Foam::couplingClient::options
(
    const Time& runTime,
    const argList& args,
    const std::optional<ResumePoint>& resumed
)
{
    const IOdictionary dict
    (
        IOobject
        (
            "couplingProperties",
            runTime.constant(),
            runTime,
            args.found("endpoint")
          ? IOobject::READ_IF_PRESENT
          : IOobject::MUST_READ,
            IOobject::NO_WRITE,
            false
        )
    );

    ClientOptions o;
    o.name = "gimdemFoam";
    o.resume = resumed;
    o.endpoint =
        args.found("endpoint")
      ? args.opt<string>("endpoint")
      : dict.get<string>("endpoint");
    o.keys =
        args.found("keys")
      ? args.opt<string>("keys")
      : dict.getOrDefault<string>("keys", "");
    o.timeout = dict.getOrDefault<scalar>("timeout", o.timeout);
    o.connect_time = dict.getOrDefault<scalar>("connectTime", o.connect_time);
    o.step_time = dict.getOrDefault<scalar>("stepTime", o.step_time);
    o.shared_memory =
        dict.getOrDefault<bool>("sharedMemory", o.shared_memory);

    o.iterates = true;
    o.rank = thisRank();

    const word schedule =
        args.found("schedule")
      ? args.opt<word>("schedule")
      : dict.getOrDefault<word>("schedule", "server");

    if (schedule == "serial")
    {
        o.schedule = Schedule::serial;
    }
    else if (schedule == "overlapped")
    {
        o.schedule = Schedule::overlapped;
    }
    else if (schedule == "iterated")
    {
        o.schedule = Schedule::iterated;
    }
    else if (schedule != "server")
    {
        FatalErrorInFunction
            << "schedule " << schedule << " of constant/couplingProperties"
            << " or the command line is unknown; say server, serial, overlapped"
            << " or iterated"
            << exit(FatalError);
    }

    return o;
}


// * * * * * * * * * * * * * Static Member Functions * * * * * * * * * * * * //

void Foam::couplingClient::addOptions()
{
    argList::addOption
    (
        "endpoint",
        "address",
        "of the server, e.g. tcp://127.0.0.1:5570"
        " (overrides constant/couplingProperties)"
    );
    argList::addOption
    (
        "keys",
        "folder",
        "of keys that the server knows (overrides constant/couplingProperties)"
    );
    argList::addOption
    (
        "schedule",
        "word",
        "server, serial, overlapped or iterated"
        " (overrides constant/couplingProperties)"
    );
}


// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::couplingClient::couplingClient
(
    const Time& runTime,
    const argList& args,
    const std::optional<ResumePoint>& resumed
)
:
    options_(options(runTime, args, resumed)),
    client_(options_),
    completeStep_(resumed ? resumed->step : 0)
{}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

void Foam::couplingClient::connect
(
    const dimensionedScalar& rho,
    const dimensionedScalar& mu
)
{
    FluidProperties fluid;
    fluid.density = rho.value();
    fluid.viscosity = mu.value();

    // The master comes first and learns where the others are to connect
    List<string> endpoints(Pstream::nProcs());
    if (Pstream::master())
    {
        const Welcome& welcome = client_.connect(fluid);
        for (std::size_t i = 0; i < welcome.rank_endpoints.size(); ++i)
        {
            endpoints[i + 1] = welcome.rank_endpoints[i];
        }
    }
    Pstream::scatter(endpoints);
    if (!Pstream::master())
    {
        ClientOptions own(options_);
        own.endpoint = endpoints[Pstream::myProcNo()];
        client_ = Client(own);
        client_.connect(fluid);
    }

    const Welcome& welcome = client_.welcome();

    Info<< "Connected to " << welcome.server.c_str() << ": "
        << welcome.title.c_str() << nl
        << "    schedule " << name_of(welcome.schedule)
        << ", end time " << welcome.end_time << " s";
    if (welcome.fluid_steps > 1)
    {
        Info<< ", " << welcome.fluid_steps << " fluid steps to a coupling step";
    }
    Info<< nl << endl;

    if (welcome.schedule != Schedule::iterated)
    {
        return;
    }
    if (welcome.fluid_steps > 1)
    {
        FatalErrorInFunction
            << "schedule iterated with " << welcome.fluid_steps << " fluid steps"
            << " to a coupling step (this solver can repeat one step only);"
            << " leave out fluid_steps, or choose another schedule"
            << exit(FatalError);
    }
    fixedPoint_.reset
    (
        new FluidFixedPoint
        (
            welcome.iteration,
            [](Span<double> numbers)
            {
                for (double& number : numbers)
                {
                    reduce(number, sumOp<scalar>());
                }
            }
        )
    );
}


Foam::scalar Foam::couplingClient::endTime() const
{
    return client_.welcome().end_time;
}


Foam::label Foam::couplingClient::fluidSteps() const
{
    return client_.welcome().fluid_steps;
}


void Foam::couplingClient::sendMesh(const polyMesh& mesh)
{
    client_.send_mesh(polyMeshArrays(mesh).view());

    if (!client_.shared_memory_note().empty())
    {
        Info<< "Note: " << client_.shared_memory_note().c_str() << nl << endl;
    }
}


void Foam::couplingClient::setFluid
(
    const volVectorField& U,
    const volScalarField& p,
    const volScalarField& alpha
)
{
    const Welcome& welcome = client_.welcome();

    fluid_ = FluidFields();

    if (welcome.needs_field(field::velocity))
    {
        fluid_.velocity = components(U.primitiveField());
    }
    if (welcome.needs_field(field::velocity_gradient))
    {
        gradU_ = fvc::grad(U)().primitiveField();
        fluid_.velocity_gradient = components(gradU_);
    }
    if (welcome.needs_field(field::pressure))
    {
        fluid_.pressure = components(p.primitiveField());
    }
    if (welcome.needs_field(field::pressure_gradient))
    {
        gradP_ = fvc::grad(p)().primitiveField();
        fluid_.pressure_gradient = components(gradP_);
    }
    if (welcome.needs_field(field::void_fraction_gradient))
    {
        // Eqs. 23-25 of the paper: the gradient of alpha as a fluid scalar
        gradAlpha_ = fvc::grad(alpha)().primitiveField();
        fluid_.void_fraction_gradient = components(gradAlpha_);
    }

    monitors_.clear();
}


void Foam::couplingClient::monitor
(
    const char* name,
    const scalar value,
    const char* unit
)
{
    monitors_.push_back({name, value, unit});
}


void Foam::couplingClient::beginStep(const scalar t, const scalar deltaT)
{
    ++step_.number;
    step_.time = t;
    step_.dt = deltaT;

    client_.begin_step(step_, fluid_, monitors_);

    if (fixedPoint_)
    {
        fixedPoint_->start(fluid_);
    }
}


void Foam::couplingClient::getSolid
(
    volScalarField& alpha,
    volScalarField& K,
    volVectorField& M,
    const label stepsLeft
) const
{
    const SolidFields& solid = client_.solid();

    scalarField& a = alpha.primitiveFieldRef();
    scalarField& k = K.primitiveFieldRef();
    vectorField& m = M.primitiveFieldRef();

    forAll(a, celli)
    {
        const scalar end = solid.void_fraction[celli];

        if (!(end > 0 && end < 1 + 1e-6))
        {
            FatalErrorInFunction
                << "the server sent void fraction " << end << " for cell "
                << celli << " at " << alpha.mesh().C()[celli] << " m (the fluid"
                << " needs 0 < alpha <= 1); check the server's mapping"
                << exit(FatalError);
        }

        a[celli] = stepsLeft > 1 ? a[celli] + (end - a[celli])/stepsLeft : end;
    }

    if (solid.drag_coefficient.empty())
    {
        k = 0;
        m = Zero;
    }
    else
    {
        forAll(k, celli)
        {
            k[celli] = solid.drag_coefficient[celli];
            for (direction d = 0; d < vector::nComponents; ++d)
            {
                m[celli][d] = solid.drag_momentum[3*celli + d];
            }
        }
    }

    alpha.correctBoundaryConditions();
    K.correctBoundaryConditions();
    M.correctBoundaryConditions();
}


void Foam::couplingClient::endStep(const scalar compute, const scalar output)
{
    Timings timings;
    timings.compute = compute;
    timings.output = output;

    client_.end_step(timings, fixedPoint_ ? fixedPoint_->residual() : 0);
}


bool Foam::couplingClient::iterate()
{
    if (!fixedPoint_)
    {
        return false;
    }
    if (fixedPoint_->improve(fluid_))
    {
        client_.iterate_step(fixedPoint_->guess(), fixedPoint_->residual());
        return true;
    }
    if (fixedPoint_->converged())
    {
        return false;
    }

    OStringStream what;
    what<< "fluid and particles did not agree in " << fixedPoint_->passes()
        << " passes of step " << label(step_.number) << " at " << step_.time
        << " s: residual " << fixedPoint_->residual() << ", tolerance "
        << client_.welcome().iteration.tolerance;

    if (client_.welcome().iteration.must_converge)
    {
        FatalErrorInFunction
            << what.str().c_str() << "; allow more passes, a larger tolerance"
            << " or a shorter time step" << exit(FatalError);
    }
    Info<< "Note: " << what.str().c_str() << endl;

    return false;
}


void Foam::couplingClient::saveCheckpoint(resumableTime& runTime)
{
    // Of several processors the master is told, and asks for all
    bool saves = client_.welcome().saves_checkpoints;
    Pstream::scatter(saves);

    if (saves)
    {
        stringList told(3);
        if (Pstream::master())
        {
            const SavedCheckpoint saved
            (
                client_.save_checkpoint(runTime.value(), completeStep_)
            );
            told[0] = std::to_string(saved.session);
            told[1] = std::to_string(saved.step);
            told[2] = saved.name;
        }
        Pstream::scatter(told);

        SavedCheckpoint saved;
        saved.session = std::stoull(told[0]);
        saved.step = std::stoll(told[1]);
        saved.name = told[2];
        fluidCheckpoint::complete(runTime, saved);
        completeStep_ = saved.step;
    }
    runTime.purge();
}


bool Foam::couplingClient::stopRequested() const
{
    if (client_.stop_request())
    {
        Info<< "The server asks for an end: " << *client_.stop_request()
            << nl << endl;
    }

    return bool(client_.stop_request());
}


void Foam::couplingClient::finish(const string& reason)
{
    client_.finish(reason);
}


void Foam::couplingClient::abort(const string& reason)
{
    client_.abort(reason);
}


// ************************************************************************* //
