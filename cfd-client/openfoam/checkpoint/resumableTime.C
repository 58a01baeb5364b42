// SPDX-License-Identifier: GPL-3.0-or-later
/*---------------------------------------------------------------------------*\
    gimdem, client-server CFD-DEM co-simulation

    This program is free software: you can redistribute it and/or modify it
    under the terms of the GNU General Public License as published by the Free
    Software Foundation, either version 3 of the License, or (at your option)
    any later version. It comes without any warranty; LICENSES/ has the text.
\*---------------------------------------------------------------------------*/

#include "resumableTime.H"
#include "argList.H"
#include "OSspecific.H"

// * * * * * * * * * * * * * * * * Constructors  * * * * * * * * * * * * * * //

Foam::resumableTime::resumableTime(const argList& args)
:
    Time(Time::controlDictName, args),
    writtenIndex_(timeIndex())
{}


// * * * * * * * * * * * * * * * Member Functions  * * * * * * * * * * * * * //

Foam::dictionary Foam::resumableTime::state() const
{
    dictionary dict;
    dict.add("value", value());
    dict.add("index", timeIndex_);
    dict.add("deltaT", deltaT_);
    dict.add("deltaT0", deltaT0_);
    dict.add("deltaTSave", deltaTSave_);
    dict.add("startTime", startTime_);
    dict.add("startIndex", startTimeIndex_);
    dict.add("writeIndex", writeTimeIndex_);
    dict.add("timePrecision", Time::precision_);
    dict.add("controlDeltaT", controlDict().get<scalar>("deltaT"));
    return dict;
}


void Foam::resumableTime::resume(const word& folder, const dictionary& state)
{
    const scalar deltaT = controlDict().get<scalar>("deltaT");
    const bool deltaTHolds = deltaT != state.get<scalar>("controlDeltaT");

    setTime
    (
        instant(state.get<scalar>("value"), folder),
        state.get<label>("index")
    );
    deltaT_ = deltaTHolds ? deltaT : state.get<scalar>("deltaT");
    deltaT0_ = state.get<scalar>("deltaT0");
    deltaTSave_ = state.get<scalar>("deltaTSave");
    deltaTchanged_ = true;
    startTime_ = state.get<scalar>("startTime");
    startTimeIndex_ = state.get<label>("startIndex");
    writeTimeIndex_ = state.get<label>("writeIndex");
    Time::precision_ = state.get<int>("timePrecision");
    writtenIndex_ = timeIndex_;
}


void Foam::resumableTime::writeFields()
{
    if (isWritten())
    {
        return;
    }

    const label wanted = purgeWrite_;
    const unsigned int digits = IOstream::defaultPrecision();

    purgeWrite_ = 0;
    IOstream::defaultPrecision(17);
    const bool good = writeNow();
    IOstream::defaultPrecision(digits);
    purgeWrite_ = wanted;

    if (!good)
    {
        FatalErrorInFunction
            << "the fields of t = " << timeName() << " s could not be written"
            << " to " << timePath() << " (is the disk full?); make room and"
            << " restart from the last checkpoint" << exit(FatalError);
    }
    writtenIndex_ = timeIndex_;
}


void Foam::resumableTime::purge()
{
    completeTimes_.push(timeName());

    while (purgeWrite_ > 0 && completeTimes_.size() > purgeWrite_)
    {
        rmDir(path()/completeTimes_.pop());
    }
}


// ************************************************************************* //
