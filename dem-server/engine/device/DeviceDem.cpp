// SPDX-License-Identifier: BSD-3-Clause
// The devices to choose from, and the one for tests.
#include "engine/device/DeviceDem.hpp"

#include "core/Error.hpp"
#include "engine/device/DeviceContacts.t.hpp"
#include "engine/device/DeviceDemOn.hpp"
#include "engine/device/DeviceFluid.t.hpp"
#include "engine/device/DeviceWalls.t.hpp"
#include "exec/guarded/GuardedDevice.hpp"

namespace gimdem
{

std::unique_ptr<DeviceDem> make_device_dem(exec::Execution const& execution, DemScene const& scene)
{
    if (execution.backend == exec::Backend::guarded)
        return std::make_unique<DeviceDemOn<exec::GuardedDevice>>(scene, execution.seed, execution.threads);
    if (execution.backend == exec::Backend::cuda) return make_cuda_dem(execution, scene);
    return nullptr;
}

#ifndef GIMDEM_HAS_CUDA
std::unique_ptr<DeviceDem> make_cuda_dem(exec::Execution const&, DemScene const&)
{
    throw UserError(
        "backend \"cuda\" is not in this build (compiled without CUDA); build with cmake --preset cuda, or run with "
        "--device cpu");
}
#endif

}  // namespace gimdem
