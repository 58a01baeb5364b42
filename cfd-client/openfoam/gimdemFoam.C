// SPDX-License-Identifier: GPL-3.0-or-later
/*---------------------------------------------------------------------------*\
    gimdem, client-server CFD-DEM co-simulation

    This program is free software: you can redistribute it and/or modify it
    under the terms of the GNU General Public License as published by the Free
    Software Foundation, either version 3 of the License, or (at your option)
    any later version. It comes without any warranty; LICENSES/ has the text.

Application
    gimdemFoam

Description
    Gas or liquid around moving particles: the volume-averaged Navier-Stokes
    equations (model A) of one incompressible Newtonian fluid. Void fraction
    and drag come from a particle server, the fluid's fields go there.

        d(alpha)/dt + div(alpha U) = 0                                  (F.1)
        d(alpha U)/dt + div(alpha U U)
            = div(alpha tau)/rho - alpha (grad p/rho - g)
              + (M - K U)/rho                                      (F.2, C.5)
        tau = mu (grad U + grad U^T - 2/3 div U I)                      (F.3)

    (numbers of docs/theory.md). alpha, K and M are the server's; -K U is
    implicit. PIMPLE; halfCells.H tells how pressure, drag and body forces meet
    on the faces, README.md what a case needs.

\*---------------------------------------------------------------------------*/

#include "fvCFD.H"
#include "pimpleControl.H"
#include "clockTime.H"
#include "constrainPressure.H"
#include "extrapolatedCalculatedFvPatchFields.H"
#include "fixedFluxPressureFvPatchScalarField.H"
#include "sigFpe.H"

#include "couplingClient.H"
#include "fluidCheckpoint.H"
#include "halfCells.H"

#ifdef __GLIBC__
#include <malloc.h>
#endif

#include <csignal>
#include <memory>
#include <unistd.h>

// * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * * //

//- Fatal unless value is a number up to most
static void requireConvergent
(
    const Time& runTime,
    const char* name,
    const scalar value,
    const scalar most
)
{
    if (!(value <= most))
    {
        FatalErrorInFunction
            << "the fluid diverged: " << name << " is " << value << " at t = "
            << runTime.value() << " s (at most " << most << " is reasonable);"
            << " reduce deltaT of system/controlDict, look at 0/U and 0/p, or"
            << " raise maxVelocity in PIMPLE of system/fvSolution"
            << exit(FatalError);
    }
}


//- The whole simulation. Throws on any fault
static void simulate
(
    const argList& args,
    std::unique_ptr<couplingClient>& server
)
{
    Info<< "Create time\n" << endl;
    resumableTime runTime(args);
    const auto resumed = fluidCheckpoint::resume(runTime, args);

    // Ctrl-C is the server's: it asks for an orderly end
    std::signal(SIGINT, SIG_IGN);

    server.reset(new couplingClient(runTime, args, resumed));
    couplingClient& particles = *server;

    #include "createMesh.H"
    #include "createControl.H"
    #include "createTimeControls.H"
    #include "createFields.H"
    #include "checkCase.H"

    particles.connect(rho, mu);
    runTime.setEndTime(particles.endTime());
    particles.sendMesh(mesh);
    if (!resumed)
    {
        particles.getSolid(alpha, K, M);
    }
    const label fluidSteps = particles.fluidSteps();

    #include "initialFlux.H"
    #include "setFluid.H"
    #include "setTimeStep.H"

    Info<< "Starting time loop\n" << endl;
    Sout.precision(4);

    while (runTime.run() && !particles.stopRequested())
    {
        // A coupling step has fluidSteps equal steps of the fluid. In schedule
        // iterated it has one, which is repeated
        const scalar deltaT = fluidSteps*runTime.deltaTValue();
        try
        {
            particles.beginStep(runTime.value(), deltaT);
        }
        catch (const std::exception&)
        {
            // Keep the fluid where the particles ended
            runTime.writeFields();
            throw;
        }

        clockTime clock;
        scalar compute = 0;
        bool writeDue = false;
        bool repeats = false;
        const volScalarField p0
        (
            IOobject
            (
                "p0",
                runTime.timeName(),
                mesh,
                IOobject::NO_READ,
                IOobject::NO_WRITE,
                false
            ),
            p
        );

        do
        {
            for (label stepsLeft = fluidSteps; stepsLeft > 0; --stepsLeft)
            {
                if (repeats)
                {
                    #include "restoreFluid.H"
                }
                else
                {
                    ++runTime;
                    writeDue = writeDue || runTime.writeTime();
                }

                particles.getSolid(alpha, K, M, stepsLeft);
                #include "updateSolid.H"

                while (pimple.loop())
                {
                    #include "UEqn.H"

                    while (pimple.correct())
                    {
                        #include "pEqn.H"
                    }
                }

                requireConvergent
                (
                    runTime,
                    "velocity in m/s",
                    Foam::sqrt(gMax(magSqr(U.primitiveField()))),
                    pimple.dict().getOrDefault<scalar>("maxVelocity", 340)
                );
            }
            #include "setFluid.H"

            compute += clock.timeIncrement();
            repeats = particles.iterate();
            clock.timeIncrement();  // that of the particles
        } while (repeats);

        if (writeDue)
        {
            // Only here do both solvers stand at the same time
            runTime.writeFields();
        }
        particles.endStep(compute, clock.timeIncrement());
        if (writeDue)
        {
            particles.saveCheckpoint(runTime);
        }

        #include "reportStep.H"

        #include "readTimeControls.H"
        #include "setTimeStep.H"
    }

    if (!runTime.isWritten())
    {
        runTime.writeFields();
        particles.saveCheckpoint(runTime);
    }
    particles.finish
    (
        particles.stopRequested() ? "stopped as asked" : "end time reached"
    );

    Info<< "End\n" << endl;
}


//- The words of a fatal error, without the frame that OpenFOAM prints round them
static string reasonOf(const error& e)
{
    string reason(e.message());

    if (const auto* ioe = dynamic_cast<const IOerror*>(&e))
    {
        reason += " [" + ioe->ioFileName() + ", line "
          + Foam::name(ioe->ioStartLineNumber()) + ']';
    }

    return reason;
}


//- Wait until every processor has come here, so many seconds at most: the first
//  to exit ends them all, and others may still be writing
static void waitForProcessors(const scalar seconds)
{
    const int tag = UPstream::msgType() + 1517;
    const label first = UPstream::nRequests();
    const char sent = 0;
    List<char> received(Pstream::nProcs());

    for (label proci = 0; proci < Pstream::nProcs(); ++proci)
    {
        if (proci != Pstream::myProcNo())
        {
            const auto nonBlocking = UPstream::commsTypes::nonBlocking;
            UIPstream::read(nonBlocking, proci, &received[proci], 1, tag);
            UOPstream::write(nonBlocking, proci, &sent, 1, tag);
        }
    }

    const clockTime clock;
    for (label i = first; i < UPstream::nRequests(); ++i)
    {
        while (!UPstream::finishedRequest(i) && clock.elapsedTime() < seconds)
        {
            usleep(10000);
        }
    }
    UPstream::resetRequests(first);
}


//- Keep freed memory: OpenFOAM makes and drops large fields all the time, and
//  each one fresh from the system costs its page faults (a tenth of a step)
static void keepFreedMemory()
{
    #ifdef __GLIBC__
    mallopt(M_MMAP_THRESHOLD, 1 << 30);
    mallopt(M_TRIM_THRESHOLD, 1 << 30);
    mallopt(M_TOP_PAD, 1 << 26);
    #endif
}


int main(int argc, char *argv[])
{
    keepFreedMemory();

    // A limit of file sizes is an error of writing, as a full disk is
    std::signal(SIGXFSZ, SIG_IGN);

    argList::addNote
    (
        "The fluid of a coupled run: volume-averaged Navier-Stokes equations,"
        " particles by a gimdem server."
    );
    argList::addBoolOption("verbose", "print each linear solver's residuals");
    couplingClient::addOptions();
    fluidCheckpoint::addOptions();

    #include "setRootCase.H"

    // Every fault is told in words, here and to the server, without a stack trace;
    // a NaN ends in requireConvergent
    sigFpe::unset();
    FatalError.throwExceptions();
    FatalIOError.throwExceptions();
    SolverPerformance<scalar>::debug = args.found("verbose");
    SolverPerformance<vector>::debug = args.found("verbose");

    std::unique_ptr<couplingClient> server;
    string reason;

    try
    {
        simulate(args, server);
        return 0;
    }
    catch (const error& e)
    {
        reason = reasonOf(e);
    }
    catch (const std::exception& e)
    {
        reason = e.what();
    }

    if (server)
    {
        server->abort(reason);
        server.reset();
    }
    Info<< flush;
    std::cerr << "gimdemFoam: " << reason << std::endl;
    waitForProcessors(2);

    // Not return: the end of args makes the exit code 0, whatever is returned
    UPstream::exit(1);
}


// ************************************************************************* //
