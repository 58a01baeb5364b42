// SPDX-License-Identifier: GPL-3.0-or-later
/*---------------------------------------------------------------------------*\
    gimdem, client-server CFD-DEM co-simulation

    This program is free software: you can redistribute it and/or modify it
    under the terms of the GNU General Public License as published by the Free
    Software Foundation, either version 3 of the License, or (at your option)
    any later version. It comes without any warranty; LICENSES/ has the text.

Description
    Lets gimdemFoam start where no OpenFOAM environment is set.

    OpenFOAM's libraries read etc/controlDict of WM_PROJECT_DIR as they load,
    before main(), and give up where the variable is missing. Functions of
    .preinit_array run before that, but the C library forgets what they change
    of the environment: so start again, with the variable set.

\*---------------------------------------------------------------------------*/

#include <climits>
#include <cstring>
#include <unistd.h>
#include <vector>

static void setProjectDirectory(int, char* argv[], char* environment[])
{
    static char variable[] = "WM_PROJECT_DIR=" GIMDEM_OPENFOAM_PROJECT_DIR;

    std::vector<char*> with(1, variable);

    for (char** e = environment; *e; ++e)
    {
        if (!std::strncmp(*e, variable, std::strlen("WM_PROJECT_DIR=")))
        {
            return;
        }
        with.push_back(*e);
    }
    with.push_back(nullptr);

    // Where that fails OpenFOAM tells what it misses
    static char self[PATH_MAX + 1];
    if (readlink("/proc/self/exe", self, PATH_MAX) > 0)
    {
        execve(self, argv, with.data());
    }
}

__attribute__((section(".preinit_array"), used))
static void (*const setProjectDirectoryFirst)(int, char*[], char*[])
    = setProjectDirectory;


// ************************************************************************* //
