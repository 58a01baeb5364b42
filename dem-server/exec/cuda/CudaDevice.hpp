// SPDX-License-Identifier: BSD-3-Clause
/// A GPU by way of CUDA: a stream in which kernels and copies follow each other, and one for what goes beside them. For
/// files that nvcc compiles.
///
/// Of the runtime it uses memory, copies, streams, events and launches, and nothing else.
#pragma once

#include <cuda_runtime.h>

#include "exec/device/DeviceArray.hpp"

namespace gimdem::exec
{

namespace detail
{

/// Throws UserError with CUDA's reason unless the call succeeded. what: "a copy", "a sort".
void check(cudaError_t status, char const* what);

inline constexpr unsigned launch_width = 128;  ///< threads of a block

template <class Kernel>
__global__ void __launch_bounds__(launch_width) launch(Index count, Kernel kernel)
{
    Index const i = static_cast<Index>(blockIdx.x) * launch_width + threadIdx.x;
    if (i < count) kernel(i);
}

}  // namespace detail

class CudaDevice
{
public:
    /// Throws UserError where there is no GPU that this build has code for.
    explicit CudaDevice(Sorting sorting = Sorting::library);
    ~CudaDevice();
    CudaDevice(CudaDevice const&) = delete;
    CudaDevice& operator=(CudaDevice const&) = delete;

    // See exec/device/DeviceArray.hpp. What fails throws UserError with CUDA's reason.
    void* allocate(std::size_t bytes);
    void free(void* p);
    void* allocate_pinned(std::size_t bytes);
    void free_pinned(void* p);
    void copy_in(void* device, void const* host, std::size_t bytes);
    void copy_out(void* host, void const* device, std::size_t bytes);
    void copy(void* to, void const* from, std::size_t bytes);
    void zero(void* device, std::size_t bytes);
    void wait();
    void mark();
    void wait_for_mark();

    void fork();
    void join();
    template <class Kernel>
    void for_each(Index count, Kernel const& kernel)
    {
        launch(count, kernel, stream_);
    }
    template <class Kernel>
    void for_each_beside(Index count, Kernel const& kernel)
    {
        launch(count, kernel, beside_);
    }

    // By CUB, unless plain kernels were asked for.
    bool scan_by_library(View<std::int32_t> values);
    bool sort_by_library(View<std::int32_t const> keys, std::int32_t const* members, int bits,
                         std::int32_t* sorted_keys, std::int32_t* sorted_members);

private:
    template <class Kernel>
    void launch(Index count, Kernel const& kernel, cudaStream_t stream)
    {
        static_assert(std::is_trivially_copyable_v<Kernel>, "a kernel must be a trivially copyable functor over views");
        static_assert(sizeof(Kernel) <= 4000, "a kernel's arguments must fit into 4 KiB");
        if (count == 0) return;
        auto const blocks = static_cast<unsigned>((count + detail::launch_width - 1) / detail::launch_width);
        detail::launch<<<blocks, detail::launch_width, 0, stream>>>(count, kernel);
        check_launch();
    }
    void check_launch();
    void* scratch(std::size_t bytes);

    Sorting sorting_;
    cudaStream_t stream_ = nullptr;
    cudaStream_t beside_ = nullptr;
    cudaEvent_t mark_ = nullptr, fork_ = nullptr, join_ = nullptr;
    void* scratch_ = nullptr;
    std::size_t scratch_bytes_ = 0;
};

}  // namespace gimdem::exec
