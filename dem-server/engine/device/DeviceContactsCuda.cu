// SPDX-License-Identifier: BSD-3-Clause
#include "engine/device/DeviceContacts.t.hpp"
#include "exec/cuda/CudaDevice.hpp"

template class gimdem::DeviceContacts<gimdem::exec::CudaDevice>;
