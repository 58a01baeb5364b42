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

#ifndef GIMDEM_HAS_CUDA
bool cuda_is_there()
{
    return false;
}
#endif

Execution make_execution(std::string const& backend, int threads, std::string const& sorting)
{
    if (backend == "serial") return {Backend::serial, 1};
#ifdef _OPENMP
    if (backend == "openmp") return {Backend::openmp, threads > 0 ? threads : processor_count()};
#else
    if (backend == "openmp")
        throw UserError("backend \"openmp\" is not in this build (compiled without OpenMP); use backend \"serial\"");
#endif
    if (backend == "cuda" && !cuda_is_there())
        throw UserError(
            "backend \"cuda\": no GPU can be used (there is none that works, or this build has no CUDA: see "
            "docs/gpu.md); run with --device cpu");
    if (backend == "cuda")
        return {Backend::cuda, threads > 0 ? threads : processor_count(),
                sorting == "plain" ? Sorting::plain : Sorting::library};
    throw UserError("unknown backend \"" + backend +
                    "\" (it decides where the particles are computed); use \"serial\", \"openmp\" or \"cuda\"");
}

}  // namespace gimdem::exec
