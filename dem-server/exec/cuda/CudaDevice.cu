// SPDX-License-Identifier: BSD-3-Clause
#include "exec/cuda/CudaDevice.hpp"

#include <string>

#include "core/Error.hpp"

namespace gimdem::exec
{

using detail::check;

void detail::check(cudaError_t status, char const* what)
{
    if (status == cudaSuccess) return;
    throw UserError(std::string("the GPU failed at ") + what + " (" + cudaGetErrorString(status) +
                    "); see what else uses it with nvidia-smi, or run with --device cpu");
}

bool cuda_is_there()
{
    cudaStream_t stream = nullptr;
    if (cudaStreamCreate(&stream) != cudaSuccess) return false;
    cudaStreamDestroy(stream);
    return true;
}

CudaDevice::CudaDevice(Sorting sorting) : sorting_(sorting)
{
    cudaError_t const status = cudaStreamCreate(&stream_);
    if (status != cudaSuccess)
        throw UserError(std::string("no GPU can be used (") + cudaGetErrorString(status) +
                        "); see that nvidia-smi lists one, or run with --device cpu");
    check(cudaStreamCreateWithFlags(&beside_, cudaStreamNonBlocking), "making a stream");
    for (cudaEvent_t* const event : {&mark_, &fork_, &join_})
        check(cudaEventCreateWithFlags(event, cudaEventDisableTiming), "making an event");
}

CudaDevice::~CudaDevice()
{
    // A failure was reported where it happened.
    cudaFree(scratch_);
    for (cudaEvent_t const event : {mark_, fork_, join_})
        cudaEventDestroy(event);
    cudaStreamDestroy(beside_);
    cudaStreamDestroy(stream_);
}

void* CudaDevice::allocate(std::size_t bytes)
{
    void* p = nullptr;
    check(cudaMalloc(&p, bytes), "asking for memory");
    return p;
}

void CudaDevice::free(void* p)
{
    cudaFree(p);
}

void* CudaDevice::allocate_pinned(std::size_t bytes)
{
    void* p = nullptr;
    check(cudaMallocHost(&p, bytes), "asking for pinned memory");
    return p;
}

void CudaDevice::free_pinned(void* p)
{
    cudaFreeHost(p);
}

void CudaDevice::copy_in(void* device, void const* host, std::size_t bytes)
{
    check(cudaMemcpyAsync(device, host, bytes, cudaMemcpyHostToDevice, stream_), "a copy to it");
}

void CudaDevice::copy_out(void* host, void const* device, std::size_t bytes)
{
    check(cudaMemcpyAsync(host, device, bytes, cudaMemcpyDeviceToHost, stream_), "a copy from it");
}

void CudaDevice::copy(void* to, void const* from, std::size_t bytes)
{
    check(cudaMemcpyAsync(to, from, bytes, cudaMemcpyDeviceToDevice, stream_), "a copy");
}

void CudaDevice::zero(void* device, std::size_t bytes)
{
    check(cudaMemsetAsync(device, 0, bytes, stream_), "clearing memory");
}

void CudaDevice::wait()
{
    check(cudaStreamSynchronize(stream_), "computing");
}

void CudaDevice::fork()
{
    check(cudaEventRecord(fork_, stream_), "recording an event");
    check(cudaStreamWaitEvent(beside_, fork_, 0), "waiting for an event");
}

void CudaDevice::join()
{
    check(cudaEventRecord(join_, beside_), "recording an event");
    check(cudaStreamWaitEvent(stream_, join_, 0), "waiting for an event");
}

void CudaDevice::mark()
{
    check(cudaEventRecord(mark_, stream_), "recording an event");
}

void CudaDevice::wait_for_mark()
{
    check(cudaEventSynchronize(mark_), "computing");
}

void CudaDevice::check_launch()
{
    check(cudaGetLastError(), "a launch");
}

void* CudaDevice::scratch(std::size_t bytes)
{
    if (bytes > scratch_bytes_)
    {
        cudaFree(scratch_);
        scratch_ = nullptr;
        scratch_bytes_ = 0;
        scratch_ = allocate(bytes + bytes / 2);
        scratch_bytes_ = bytes + bytes / 2;
    }
    return scratch_;
}

}  // namespace gimdem::exec
