// SPDX-License-Identifier: BSD-3-Clause
#include "exec/Execution.hpp"

#include <thread>

#include "core/Error.hpp"

#ifdef _OPENMP
#include <omp.h>
#endif

namespace gimdem::exec
{

int processor_count()
{
#ifdef _OPENMP
    return omp_get_num_procs();
#else
    return static_cast<int>(std::thread::hardware_concurrency());
#endif
}

Execution make_execution(std::string const& backend, int threads)
{
    if (backend == "serial") return {Backend::serial, 1};
#ifdef _OPENMP
    if (backend == "openmp") return {Backend::openmp, threads > 0 ? threads : processor_count()};
#else
    if (backend == "openmp")
        throw UserError("backend \"openmp\" is not in this build (compiled without OpenMP); use backend \"serial\"");
#endif
    throw UserError("unknown backend \"" + backend +
                    "\" (it decides where the particles are computed); use \"serial\" or \"openmp\"");
}

}  // namespace gimdem::exec
