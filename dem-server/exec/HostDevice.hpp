// SPDX-License-Identifier: BSD-3-Clause
/// Marks a function that kernels call: compiled for the host, and for the device where nvcc reads it.
#pragma once

#ifdef __CUDACC__
#define GIMDEM_HD __host__ __device__
#else
#define GIMDEM_HD
#endif
