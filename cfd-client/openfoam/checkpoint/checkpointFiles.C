// SPDX-License-Identifier: GPL-3.0-or-later
/*---------------------------------------------------------------------------*\
    gimdem, client-server CFD-DEM co-simulation

    This program is free software: you can redistribute it and/or modify it
    under the terms of the GNU General Public License as published by the Free
    Software Foundation, either version 3 of the License, or (at your option)
    any later version. It comes without any warranty; LICENSES/ has the text.
\*---------------------------------------------------------------------------*/

#include "checkpointFiles.H"
#include "SHA1.H"
#include "error.H"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <vector>

// * * * * * * * * * * * * * * * Local Functions * * * * * * * * * * * * * * //

namespace Foam
{

namespace fs = std::filesystem;

//- Have what was written to a file or folder survive a power cut
static bool sync(const fs::path& path)
{
    const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (descriptor < 0)
    {
        return false;
    }
    const bool good = ::fsync(descriptor) == 0;
    const int error = errno;
    ::close(descriptor);
    // Some file systems cannot sync a folder
    return good || error == EINVAL;
}


static void failToWrite(const fs::path& file, const std::string& why)
{
    FatalErrorInFunction
        << file.c_str() << " could not be written (" << why.c_str()
        << "); make room or give write permission, and restart from the last"
        << " checkpoint" << exit(FatalError);
}


static std::string contentOf(const fs::path& file)
{
    std::ifstream is(file, std::ios::binary);
    return
    {
        std::istreambuf_iterator<char>(is),
        std::istreambuf_iterator<char>()
    };
}


//- OpenFOAM does not notice when the last of a file cannot be written, but
//  what it writes ends with a divider
static bool endsAsItShould(const fs::path& file, const std::string& content)
{
    const std::string end(content.substr(content.size() - std::min<std::size_t>
    (
        content.size(), 8
    )));

    return file.extension() == ".gz" || end.find("* //") != std::string::npos;
}

} // End namespace Foam


// * * * * * * * * * * * * * * * * * Functions * * * * * * * * * * * * * * * //

Foam::List<Foam::stringList> Foam::checkpointFiles::syncedList
(
    const fileName& folder,
    const fileName& but
)
{
    std::vector<stringList> files;
    std::vector<fs::path> paths;
    const fs::path root(folder.c_str());
    sync(root);

    for (const auto& entry : fs::recursive_directory_iterator(root))
    {
        const std::string name(fs::relative(entry.path(), root).string());

        if (entry.is_directory())
        {
            sync(entry.path());
        }
        else if (name != but)
        {
            const std::string content(contentOf(entry.path()));
            if (!sync(entry.path()))
            {
                failToWrite(entry.path(), std::strerror(errno));
            }
            if (!endsAsItShould(entry.path(), content))
            {
                failToWrite(entry.path(), "it is cut short, is the disk full?");
            }
            stringList file(3);
            file[0] = name;
            file[1] = std::to_string(content.size());
            file[2] = SHA1(content).digest().str();
            files.push_back(file);
        }
    }
    std::sort
    (
        files.begin(),
        files.end(),
        [](const stringList& a, const stringList& b) { return a[0] < b[0]; }
    );

    List<stringList> list(label(files.size()));
    std::copy(files.begin(), files.end(), list.begin());
    return list;
}


Foam::string Foam::checkpointFiles::fault
(
    const fileName& folder,
    const List<stringList>& files
)
{
    for (const stringList& file : files)
    {
        const std::string content(contentOf(fs::path((folder/file[0]).c_str())));
        if (std::to_string(content.size()) != file[1])
        {
            return file[0] + " is absent or cut short";
        }
        if (SHA1(content).digest().str() != file[2])
        {
            return file[0] + " is damaged (its checksum is another)";
        }
    }
    return string();
}


void Foam::checkpointFiles::writeWhole(const fileName& file, const string& text)
{
    const fs::path path(file.c_str()), part(path.string() + ".part");
    {
        std::ofstream os(part, std::ios::binary);
        os << text;
        os.close();
        if (!os)
        {
            failToWrite(path, std::strerror(errno));
        }
    }
    if (!sync(part) || std::rename(part.c_str(), path.c_str()) != 0)
    {
        failToWrite(path, std::strerror(errno));
    }
    sync(path.parent_path());
}


// ************************************************************************* //
