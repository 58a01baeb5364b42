// SPDX-License-Identifier: BSD-3-Clause
#include "engine/device/DeviceWalls.t.hpp"
#include "exec/cuda/CudaDevice.hpp"

template class gimdem::DeviceWallGeometry<gimdem::exec::CudaDevice>;
template class gimdem::DeviceWalls<gimdem::exec::CudaDevice>;
