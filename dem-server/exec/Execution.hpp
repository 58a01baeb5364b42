// SPDX-License-Identifier: BSD-3-Clause
/// Where kernels run.
#pragma once

#include <string>

namespace gimdem::exec
{

enum class Backend
{
    serial,   ///< plain loops: the readable oracle
    openmp,   ///< threads of this machine
    cuda,     ///< a GPU; what is left to the host runs on its threads
    guarded,  ///< for tests: a device made of the host that forgives nothing, see exec/guarded
};

/// Who scans and sorts on a device.
enum class Sorting
{
    plain,   ///< kernels of exec/device
    library  ///< the device's own library, where it has one
};

/// A backend and how much of the machine it may use.
struct Execution
{
    Backend backend = Backend::serial;
    int threads = 1;
    Sorting sorting = Sorting::library;
    unsigned seed = 1;  ///< guarded: of the order in which kernels run
};

/// Backend by its name in the case file; throws UserError for an unknown or absent one. threads 0: all cores. sorting:
/// library or plain.
Execution make_execution(std::string const& backend, int threads, std::string const& sorting = "library");

/// Whether there is a GPU that this build has code for.
bool cuda_is_there();

/// Number of processors this process may run on.
int processor_count();

}  // namespace gimdem::exec
