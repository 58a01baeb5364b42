// SPDX-License-Identifier: BSD-3-Clause
/// Where kernels run.
#pragma once

#include <string>

namespace gimdem::exec
{

enum class Backend
{
    serial,  ///< plain loops: the readable oracle
    openmp   ///< threads of this machine
};

/// A backend and how much of the machine it may use.
struct Execution
{
    Backend backend = Backend::serial;
    int threads = 1;
};

/// Backend by its name in the case file; throws UserError for an unknown or absent one. threads 0: all cores.
Execution make_execution(std::string const& backend, int threads);

/// Number of processors this process may run on.
int processor_count();

}  // namespace gimdem::exec
