// SPDX-License-Identifier: BSD-3-Clause
// The particles on a GPU. The stages that have a kernel for every choice of laws are compiled in files of their own.
#include "engine/device/DeviceDem.hpp"
#include "engine/device/DeviceDemOn.hpp"
#include "engine/device/DeviceFluid.t.hpp"
#include "exec/cuda/CudaDevice.hpp"

namespace gimdem
{

std::unique_ptr<DeviceDem> make_cuda_dem(exec::Execution const& execution, DemScene const& scene)
{
    return std::make_unique<DeviceDemOn<exec::CudaDevice>>(scene, execution.sorting);
}

}  // namespace gimdem
