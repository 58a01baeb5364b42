// SPDX-License-Identifier: GPL-3.0-or-later
/*---------------------------------------------------------------------------*\
    gimdem, client-server CFD-DEM co-simulation

    This program is free software: you can redistribute it and/or modify it
    under the terms of the GNU General Public License as published by the Free
    Software Foundation, either version 3 of the License, or (at your option)
    any later version. It comes without any warranty; LICENSES/ has the text.
\*---------------------------------------------------------------------------*/

#include "fluidCheckpoint.H"
#include "checkpointFiles.H"
#include "argList.H"
#include "IFstream.H"
#include "OStringStream.H"
#include "PstreamReduceOps.H"

#include <algorithm>
#include <vector>

using namespace gimdem::coupling;

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

static const char* const record = "uniform/gimdemCheckpoint";

//- The record of a time folder; empty if it has none
static dictionary recordOf(const fileName& folder)
{
    IFstream is(folder/record);
    dictionary dict;
    if (is.good())
    {
        dict.read(is);
    }
    return dict;
}


//- A time folder with a record
struct Candidate
{
    word folder;
    dictionary dict;

    label index() const
    {
        return dict.subDict("time").get<label>("index");
    }
};


//- Newest first
static std::vector<Candidate> candidates(const fileName& path)
{
    std::vector<Candidate> all;
    for (const fileName& name : readDir(path, fileName::DIRECTORY))
    {
        if (isFile(path/name/record))
        {
            all.push_back({name, recordOf(path/name)});
        }
    }
    std::sort
    (
        all.begin(),
        all.end(),
        [](const Candidate& a, const Candidate& b)
        {
            return a.index() > b.index();
        }
    );
    return all;
}


//- The one that is asked for and is whole
static Candidate choose
(
    const std::vector<Candidate>& all,
    const fileName& path,
    const word& wanted
)
{
    for (const Candidate& one : all)
    {
        if (wanted == "latest" || wanted == one.folder)
        {
            const string fault = checkpointFiles::fault
            (
                path/one.folder,
                one.dict.lookup("files")
            );
            if (fault.empty())
            {
                return one;
            }
            Info<< "Not going on from " << one.folder << ": " << fault << nl
                << endl;
        }
    }

    FatalErrorInFunction
        << "-restart " << wanted << ": " << path << " has no such time folder"
        << " that is whole and belongs to a checkpoint of the particles (the"
        << " file " << record << " in it tells); run the case from its start"
        << exit(FatalError);

    return Candidate();
}

} // End namespace Foam


// * * * * * * * * * * * * * * * * * Functions * * * * * * * * * * * * * * * //

void Foam::fluidCheckpoint::addOptions()
{
    argList::addOption
    (
        "restart",
        "time",
        "go on from the checkpoint in this time folder, or from the latest"
    );
}


std::optional<ResumePoint> Foam::fluidCheckpoint::resume
(
    resumableTime& runTime,
    const argList& args
)
{
    if (!args.found("restart"))
    {
        return std::nullopt;
    }

    const fileName path(runTime.path());
    const std::vector<Candidate> all(candidates(path));
    const Candidate one(choose(all, path, args.opt<word>("restart")));

    if (returnReduce(one.index(), maxOp<label>()) != one.index())
    {
        FatalErrorInFunction
            << "-restart: the newest whole time folder of this processor is "
            << one.folder << ", and another one has a later one; name the folder"
            << " that all have" << exit(FatalError);
    }

    // What comes after it is written again, and is of no pair until then
    for (const Candidate& other : all)
    {
        if (other.index() > one.index())
        {
            rm(path/other.folder/record);
        }
    }

    runTime.resume(one.folder, one.dict.subDict("time"));
    Info<< "Going on from " << one.folder << ", with the particles of "
        << one.dict.get<string>("checkpoint") << nl << endl;

    ResumePoint point;
    point.session = std::stoull(one.dict.get<string>("session"));
    point.step = std::stoll(one.dict.get<string>("step"));
    point.time = runTime.value();
    return point;
}


void Foam::fluidCheckpoint::complete
(
    const resumableTime& runTime,
    const SavedCheckpoint& saved
)
{
    const fileName folder(runTime.timePath());

    OStringStream text;
    text.precision(17);
    text.writeEntry("session", string(std::to_string(saved.session)));
    text.writeEntry("step", string(std::to_string(saved.step)));
    text.writeEntry("checkpoint", string(saved.name));
    runTime.state().writeEntry("time", text);
    text.writeEntry("files", checkpointFiles::syncedList(folder, record));

    checkpointFiles::writeWhole(folder/record, text.str());
}


// ************************************************************************* //
