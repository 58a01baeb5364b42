# SPDX-License-Identifier: BSD-3-Clause
# What nvcc is told, as target gimdem_cuda_options.
#
# -fmad=false: as on the host, no multiply-add is fused behind our back (GimdemCompileOptions), so that the same kernel
# gives the same bits on a device and on the host but for exp, log and erfc.
set(GIMDEM_CUDA_ARCHITECTURES "90-real" CACHE STRING
  "GPUs to compile for, as in CMAKE_CUDA_ARCHITECTURES: 90-real for sm_90, 75-virtual for PTX of compute_75 alone")
option(GIMDEM_CUDA_SHARED_RUNTIME "Link the CUDA runtime as a shared library, so that another can take its place" OFF)
option(GIMDEM_CUDA_REPORT "Have ptxas tell each kernel's registers and memory, for docs/gpu.md" OFF)

add_library(gimdem_cuda_options INTERFACE)
if(GIMDEM_CUDA)
  set(CMAKE_CUDA_ARCHITECTURES ${GIMDEM_CUDA_ARCHITECTURES})
  if(GIMDEM_CUDA_SHARED_RUNTIME)
    set(CMAKE_CUDA_RUNTIME_LIBRARY Shared)
    target_link_libraries(gimdem_cuda_options INTERFACE $<LINK_ONLY:CUDA::cudart>)
  else()
    target_link_libraries(gimdem_cuda_options INTERFACE $<LINK_ONLY:CUDA::cudart_static>)
  endif()
  enable_language(CUDA)
  # Said with -isystem, what g++ looks through anyway would hide its headers from each other.
  list(APPEND CMAKE_CUDA_IMPLICIT_INCLUDE_DIRECTORIES ${CMAKE_CXX_IMPLICIT_INCLUDE_DIRECTORIES})
  find_package(CUDAToolkit REQUIRED)
  # 20012 comes from Eigen, 1675 from pragmas of g++ in headers for the host. -std in words: CMake before 3.26 does not know that nvcc 13 has C++20.
  target_compile_options(gimdem_cuda_options INTERFACE
    "$<$<COMPILE_LANGUAGE:CUDA>:-std=c++20;--expt-relaxed-constexpr;-fmad=false;-Werror=all-warnings;-diag-suppress=20012,1675>"
    "$<$<COMPILE_LANGUAGE:CUDA>:-Xcompiler=-ffp-contract=off,-fno-math-errno>")
  if(GIMDEM_CUDA_REPORT)
    target_compile_options(gimdem_cuda_options INTERFACE "$<$<COMPILE_LANGUAGE:CUDA>:-Xptxas=-v>")
  endif()
endif()
